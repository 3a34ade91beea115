// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

#include <vcg_ext/base/progress.h>
#include <vcg_ext/metric/distortion.h>

namespace {

QString info()
{
    return "Compares the current layer with a reference: MRMS, Hausdorff and mean distance as Metro takes them (also relative "
           "to the "
           "reference's bounding-box diagonal), signal to noise, the perceptual distance MSDM, changes of volume and area.<br>"
           "The vertices get their distance to the reference as quality, and a colour from it, unless they have one: red is near, "
           "blue a thousandth of the diagonal or more. "
           "Layers are compared without their matrices, unless one of these stretches its layer.<br>"
           "See:<br><i>Paolo Cignoni, Claudio Rocchini, Roberto Scopigno</i><br><b>\"Metro: measuring error on simplified "
           "surfaces\"</b>"
           "<br>Computer Graphics Forum 17(2), 1998<br>"
           "<i>Guillaume Lavou&eacute; and others</i><br><b>\"Perceptually driven 3D distance metrics with application to "
           "watermarking\"</b><br>SPIE Applications of Digital Image Processing XXIX, 2006";
}

RichParameterList parameters(const MeshDocument& document)
{
    RichParameterList list;
    list.addParam(layer_parameter("Reference", document, "Reference", "The layer to compare the current one with."));
    list.addParam(RichInt("Samples", 0, "Samples", "Points per direction; 0 is ten per vertex of the larger mesh."));
    list.addParam(RichInt("Seed", 0, "Seed", "Of the sampling, 0 or more."));
    add_report_parameter(list);
    return list;
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    const MeshModel& reference = other_layer(values, "Reference", document);
    vcg_ext::DistortionOptions options;
    options.samples = values.getInt("Samples");
    options.seed = read_seed(values);
    ReportFile file(values);

    const std::array stretched = {is_stretched(reference), is_stretched(layer)};
    const bool with_matrices = stretched[0] || stretched[1];
    const vcg_ext::DistortionReport report =
        measure(read_surface(reference, with_matrices), read_surface(layer, with_matrices), options, progress);
    Json results = to_json(report);
    constexpr double plain = 1e-3; // of the diagonal: nobody would overlook that
    results["colors"] = QString("red is 0, blue is %1 (a thousandth of the diagonal) and more; colours that the layer "
                                "had are kept, and distances are its vertices' quality.")
                            .arg(plain * report.diagonal, 0, 'g', 3)
                            .toStdString();
    if (with_matrices)
        results["warnings"].push_back(stretched_as_read);
    file.write(results);
    write_distances(layer, report.distance, plain * report.diagonal);
    return results;
}

} // namespace

const Filter measure_filter = {"Watermark: Measure Distortion",
                               "get_watermark_distortion",
                               HostInterface::Measure,
                               HostInterface::FIXED,
                               MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR,
                               info,
                               parameters,
                               run};
