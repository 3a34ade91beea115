// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "options.h"
#include "report.h"
#include "trial.h"

#include <vector>

namespace vcg_ext {

/// Says in figures and in words what a search for a mark came to: all of the report but the seconds and what is said of
/// pieces and of the original.
/// \param site_of_vertex of the surface that was read, see Welded
[[nodiscard]] DetectReport conclude(const DetectOptions& options, const Search& search,
                                    const std::vector<int>& site_of_vertex);

} // namespace vcg_ext
