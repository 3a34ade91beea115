// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/base/progress.h>
#include <vcg_ext/carrier/statistic.h>

#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

namespace {

constexpr const char* info =
    "Reads the message that <b>Watermark: Embed</b> hid in the mesh, with the key alone. Every mesh gives some bits: "
    "whether they "
    "are a mark is told by <b>Expected</b>. With the message that should be there, <i>p_value</i> is the exact "
    "probability that an "
    "unmarked mesh, or another key, matches at least as well by chance; the mark counts as present below 1e-6.<br>"
    "Method, Statistic, Bits and Trim must be those of embedding. The mesh stays as it is; <b>ShowCarriers</b> gives "
    "its vertices "
    "the number of the bit that they carry as quality, and a colour for each.";

RichParameterList parameters(const MeshDocument&)
{
    RichParameterList list;
    add_carrier_parameters(list, "Number of carriers that the mark was embedded with, 1 to 1024.");
    list.addParam(RichString(
        "Expected", "", "Expected message",
        "The message to look for: plain text, <i>hex:C0FFEE</i> or <i>bits:0110</i>; or empty, to only read."));
    list.addParam(RichBool("ShowCarriers", false, "Show carriers", "Colours the vertices by the bit that they carry."));
    add_report_parameter(list);
    return list;
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    vcg_ext::DetectOptions options;
    options.carriers = read_carrier_options(values);
    const std::string expected = values.getString("Expected").toStdString();
    if (!expected.empty())
        options.expected = vcg_ext::parse_message(expected);
    const vcg_ext::Key key = read_key(values);
    ReportFile file(values.getSaveFileName("Report"));

    const vcg_ext::DetectReport report = detect(read_surface(layer.cm), key, options, progress);
    const Json results = to_json(report);
    file.write(results);
    if (values.getBool("ShowCarriers"))
        write_classes(layer, report.carrier_of_vertex);
    return results;
}

} // namespace

const Filter detect_filter = {"Watermark: Detect",
                              "get_watermark",
                              HostInterface::Measure,
                              HostInterface::SINGLE_MESH,
                              MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR,
                              info,
                              parameters,
                              run};
