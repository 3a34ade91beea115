// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/base/error.h>

#include "filter_watermark.h"

#include "report.h"

FilterWatermark::FilterWatermark()
{
    for (int id = 0; id < int(all_filters.size()); ++id) {
        typeList.push_back(id);
        actionList.push_back(new QAction(filterName(id), this));
    }
}

HostResult FilterWatermark::run(int id, const RichParameterList& values, MeshDocument& document, vcg::CallBackPos* cb)
{
    const auto progress = [cb](int percent, const char* phase) { return !cb || cb(percent, phase); };
    HostResult result;
    try {
        const Json answer = all_filters.at(id)->run(values, document, progress);
        result.values = to_values(answer);
        result.log = to_lines(answer);
        for (const Json& warning : answer.value("warnings", Json::array()))
            result.warnings += QString::fromStdString(warning);
    } catch (const vcg_ext::Error& error) {
        result.error = error.what();
    } catch (const std::bad_alloc&) {
        result.error = "Not enough memory for this mesh; it is unchanged. Close other layers, or simplify the mesh.";
    } catch (const std::exception& error) {
        result.error = QString("Internal error, please report it: %1. The mesh is unchanged.").arg(error.what());
    }
    return result;
}
