// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/base/progress.h>
#include <vcg_ext/carrier/statistic.h>

#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

namespace {

QString info()
{
    return "Reads the message that <b>Watermark: Embed</b> hid in the mesh, with the key alone. The last line of the log is the "
           "verdict: the message that is there, another one than expected, a mark whose message does not come out, one of "
           "another key or setting, or none. "
           "<i>p_value</i> (with <b>Expected message</b>) and <i>p_message</i> (without) are true upper bounds of the "
           "probability that an unmarked mesh, or another key, reads as well by chance; below 1e-6 a mark counts as found.<br>"
           "Method, Statistic and Trim must be those of embedding; Bits too, unless it is 0. <b>Show carriers</b> makes a "
           "new layer, with each vertex' carrier as quality and colour. It shows what only the key should tell: do not "
           "publish it.<br>" +
           about_carrier_parameters();
}

RichParameterList parameters(const MeshDocument&)
{
    RichParameterList list;
    add_carrier_parameters(list, "0 (usual) finds the number of carriers; or that of embedding, 1 to 1024.");
    add_expected_parameter(list);
    list.addParam(RichBool("ShowCarriers", false, "Show carriers",
                           "A new layer, coloured by carrier; it is as secret as the key."));
    add_report_parameter(list);
    return list;
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    vcg_ext::DetectOptions options;
    options.carriers = read_carrier_options(values);
    options.expected = read_expected(values);
    const vcg_ext::Key key = read_key(values);
    ReportFile file(values);

    const vcg_ext::DetectReport report = detect(read_surface(layer), key, options, progress);
    Json results = to_json(report);
    if (is_stretched(layer))
        results["warnings"].push_back(stretched_as_read);
    if (const std::string others = about_other_layers(document, "was looked at"); !others.empty())
        results["warnings"].push_back(others);
    const bool shows = values.getBool("ShowCarriers");
    if (shows && report.carrier_of_vertex.empty())
        results["warnings"].push_back(
            "There are no carriers to show: those of this method are no sets of vertices, or a piece of the mesh was read.");
    file.write(results);
    if (shows && !report.carrier_of_vertex.empty())
        write_classes(add_copy(document, layer, "secret: carriers of " + layer.label()), report.carrier_of_vertex);
    return results;
}

} // namespace

const Filter detect_filter = {"Watermark: Detect",
                              "get_watermark",
                              HostInterface::Measure,
                              HostInterface::SINGLE_MESH,
                              MeshModel::MM_NONE,
                              info,
                              parameters,
                              run};
