// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../key/key.h"
#include "layer_reading.h"
#include "options.h"
#include "report.h"

namespace vcg_ext {

/// Reads and judges by whatever reader: numbers of carriers, layers, probabilities, the verdict.
/// \param site_of_vertex of the surface that is read, see Welded
/// \param share of all false alarms that may be this one's: probabilities are divided by it
[[nodiscard]] DetectReport detect_by(const LayerReader& read, const std::vector<int>& site_of_vertex, double share,
                                     const Key& key, const DetectOptions& options, const Progress& progress = {});

/// Reads a message with the key alone. Same input, same answer: at any number of threads, on any machine.
///
/// First the mesh as a whole; where that carries nothing and has several pieces, as a plate of copies or a model on a
/// pedestal, each piece by itself too (pieces.h).
///
/// \throw Error on input that cannot carry a mark: no faces, coordinates that are not finite, no range of values.
[[nodiscard]] DetectReport detect(Surface surface, const Key& key, const DetectOptions& options,
                                  const Progress& progress = {});

/// The same of the whole alone.
/// \param share see detect_by()
[[nodiscard]] DetectReport detect_whole(Surface surface, const Key& key, const DetectOptions& options, double share = 1,
                                        const Progress& progress = {});

/// The same of a body, see body_for().
[[nodiscard]] DetectReport detect_whole(const Body& body, const Key& key, const DetectOptions& options,
                                        double share = 1, const Progress& progress = {});

} // namespace vcg_ext
