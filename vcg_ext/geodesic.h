#pragma once
#include "placement/front.h"
#include "scalar.h"

namespace vcg_ext {

/// The method of geodesic distances (chapter 4): strips about a point that the key chose, and front placement.
///
/// \param surface welded; must outlive the result
/// \param report  gets counts and warnings, the counts after each placement
[[nodiscard]] ScalarMethod geodesic_method(const Surface& surface, const Key& key, const EmbedOptions& options, double trim,
                                           EmbedReport& report);

} // namespace vcg_ext
