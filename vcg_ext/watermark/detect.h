// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../key/key.h"
#include "options.h"
#include "report.h"

namespace vcg_ext {

/// Reads a message with the key alone. Same input, same answer: at any number of threads, on any machine.
///
/// \throw Error on input that cannot carry a mark: no faces, coordinates that are not finite, no range of values.
[[nodiscard]] DetectReport detect(const Surface& surface, const Key& key, const DetectOptions& options,
                                  const Progress& progress = {});

} // namespace vcg_ext
