// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// For a function whose loops are most of the time: compiled a second time for processors with AVX2, chosen when the
/// program starts, with all that it calls inlined. The same results to the bit: AVX2 alone has no fused operations, and
/// sums stay in the order in which they are written.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define VCG_EXT_VECTORIZED __attribute__((target_clones("avx2", "default"), flatten))
#else
#define VCG_EXT_VECTORIZED
#endif

namespace vcg_ext {

/// Doubles at a time, as the compiler's own vector: it does not always see by itself which loop to vectorise.
constexpr int lanes = 4;
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));

/// As they may stand in a std::vector: by themselves they are aligned as the build's processor asks, and the copies
/// for AVX2 expect more.
struct alignas(lanes * sizeof(double)) StoredLanes {
    Lanes value;
};

} // namespace vcg_ext
