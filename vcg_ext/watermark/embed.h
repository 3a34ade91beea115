// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/progress.h"
#include "../key/key.h"
#include "options.h"
#include "report.h"

namespace vcg_ext {

/// Hides a message in the positions of `surface`.
///
/// Ends with a blind detection on the coordinates as they will be stored; carriers that read wrong or weak get a
/// corrected target and another round.
///
/// \throw Error      on bad input: says what to do. `surface` is unchanged, as after the other two.
/// \throw DoesNotFit where the message could not be read back, or the method finds no carriers
/// \throw Cancelled  where `progress` returned false
EmbedReport embed(Surface& surface, const Key& key, const EmbedOptions& options, const Progress& progress = {});

/// A number of carriers, enough for the message, in which embed() finds a place for it; 0 where it finds none. Fewer than
/// `options` asks for, or the least recommended number where so few fit nowhere. For who got DoesNotFit: costs two
/// embeddings at most.
[[nodiscard]] int carriers_that_fit(const Surface& surface, const Key& key, const EmbedOptions& options,
                                    const DoesNotFit& cause, const Progress& progress = {});

} // namespace vcg_ext
