#pragma once
#include "scalar.h"
#include "watermark.h"

namespace vcg_ext {

/// The methods of vertex norms (chapter 5 and Cho): shells of the distance to the centre, and the placement that
/// `options.method` names. What a placement counted is in `report` after each of its calls.
///
/// \param surface welded; must outlive the result
[[nodiscard]] ScalarMethod norm_method(const Surface& surface, const EmbedOptions& options, double trim,
                                       EmbedReport& report);

} // namespace vcg_ext
