#pragma once
#include "../placement/cover.h"
#include "../watermark/watermark.h"
#include "scalar.h"

namespace vcg_ext {

/// The methods of vertex norms (chapter 5 and Cho): shells of the distance to the centre, and the placement that
/// `options.method` names. What a placement counted is in `report` after each of its calls.
///
/// \param cover welded; must outlive the result
[[nodiscard]] ScalarMethod norm_method(const Cover& cover, const EmbedOptions& options, double trim,
                                       EmbedReport& report);

} // namespace vcg_ext
