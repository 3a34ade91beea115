// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../method/certificate.h"
#include "detect.h"

namespace vcg_ext {

/// A certificate of an original for the marks that embed() with the same options puts into it; method/certificate.h
/// turns it into bytes.
///
/// \throw Error on bad input; where the method needs the original itself
[[nodiscard]] Certificate make_certificate(const Surface& original, const Key& key, const EmbedOptions& options);

/// As detect_with_original(), by what a certificate has kept. Half of what the original would tell is lost, and smoothing
/// cannot be simulated.
///
/// \throw Error as detect(); where the certificate was made with another key, or for another number of carriers
[[nodiscard]] DetectReport detect_with_certificate(const Surface& surface, const Certificate& certificate,
                                                   const Key& key, const DetectOptions& options,
                                                   const Progress& progress = {});

} // namespace vcg_ext
