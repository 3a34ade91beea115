#pragma once
#include "../carrier/strips.h"
#include "../placement/cover.h"
#include "../watermark/watermark.h"
#include "scalar.h"

namespace vcg_ext {

/// The method of geodesic distances (chapter 4): strips about a point that the key chose, and front placement.
///
/// \param cover  welded; must outlive the result
/// \param report  gets counts and warnings, the counts after each placement
[[nodiscard]] ScalarMethod geodesic_method(const Cover& cover, const Key& key, const EmbedOptions& options, double trim,
                                           EmbedReport& report);

/// What a user should know about the strips that were found.
[[nodiscard]] std::vector<std::string> strip_warnings(const Strips& strips);

} // namespace vcg_ext
