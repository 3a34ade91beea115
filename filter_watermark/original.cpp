// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/base/progress.h>
#include <vcg_ext/carrier/statistic.h>

#include <QFile>

#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

namespace {

QString info()
{
    return "Reads the message in the current layer with the key and the unmarked original, and so from what "
           "<b>Watermark: Detect</b> cannot read any more: cut, stretched, mirrored, smoothed heavily. The mesh is laid on the "
           "original by shape alone first; the log and the report say where and how well it fits, and name a mesh that is no "
           "copy of this original.<br>"
           "<i>p_value</i> and <i>p_message</i> are true upper bounds, as those of Detect. Method, Statistic and Trim must be "
           "those of embedding. Waves and Layered survive the most. A <b>Certificate</b>, which Embed writes on demand, takes "
           "the original's place where nothing was smoothed; <b>Original</b> is then passed over. Layers are taken without their "
           "matrices, unless these stretch them; both stay as they are. Where a copy says nothing in the original's place, the key "
           "alone is tried too.<br>" +
           about_carrier_parameters();
}

RichParameterList parameters(const MeshDocument& document)
{
    RichParameterList list;
    add_carrier_parameters(list, "0 (usual) finds the number of carriers; or that of embedding, 1 to 1024.");
    list.addParam(layer_parameter("Original", document, "Original",
                                  "The layer with the mesh as it was before embedding; the current one is examined."));
    list.addParam(RichFileOpen("Certificate", "", {"*.wmc"}, "Certificate",
                               "The file that Embed wrote, to be taken instead of the layer; or empty."));
    add_expected_parameter(list);
    add_report_parameter(list);
    return list;
}

vcg_ext::Certificate read_certificate(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        throw vcg_ext::Error("The certificate cannot be read: '" + path.toStdString() +
                             "'. Name the file that Embed wrote, or leave Certificate empty and choose the original.");
    return vcg_ext::certificate_of(file.readAll().toStdString());
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    const QString certificate = values.getOpenFileName("Certificate");
    const MeshModel* original = certificate.isEmpty() ? &other_layer(values, "Original", document) : nullptr;
    vcg_ext::DetectOptions options;
    options.carriers = read_carrier_options(values);
    options.expected = read_expected(values);
    const vcg_ext::Key key = read_key(values);
    ReportFile file(values);

    const vcg_ext::Surface surface = read_surface(layer);
    Json results =
        to_json(original ? detect_with_original(surface, read_surface(*original), key, options, progress)
                         : detect_with_certificate(surface, read_certificate(certificate), key, options, progress));
    if (is_stretched(layer) || (original && is_stretched(*original)))
        results["warnings"].push_back(stretched_as_read);
    file.write(results);
    return results;
}

} // namespace

const Filter original_filter = {"Watermark: Detect with Original",
                                "get_watermark_with_original",
                                HostInterface::Measure,
                                HostInterface::FIXED,
                                MeshModel::MM_NONE,
                                info,
                                parameters,
                                run};
