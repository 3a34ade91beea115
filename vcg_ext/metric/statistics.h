#pragma once
#include "../key/message.h"

#include <vector>

namespace vcg_ext {

/// Probability that at least `k` of `n` fair coins show heads: what `k` matching bits are worth as evidence.
///
/// The message is masked with the key, so on a mesh without this mark the number of matches is Binomial(n, 1/2)
/// exactly. Relative error below 1e-12 for n up to 1024, also where the probability is tiny.
///
/// \throw Error where `n` is negative
[[nodiscard]] double binomial_tail(int n, int k);

/// How many bits are the same in both. \throw Error where the lengths differ
[[nodiscard]] int matching_bits(const Bits& expected, const Bits& found);

/// Matching bits over all bits; 1 where there are none. (The thesis calls this BER.)
/// \throw Error where the lengths differ
[[nodiscard]] double detection_ratio(const Bits& expected, const Bits& found);

/// What one threshold does: a mesh with a score of at least `threshold` is said to be marked.
struct RocPoint {
    double threshold = 0;
    double false_positive = 0; ///< part of the unmarked that are said to be marked
    double true_positive = 0;  ///< part of the marked that are said to be marked
};

/// The receiver operating characteristic of a score: one point for every score that occurs, the highest threshold
/// first, after a point (0, 0) whose threshold is infinite. The last point is (1, 1).
///
/// \param marked    scores under the right keys, \param unmarked under wrong ones or of unmarked meshes
/// \throw Error where either is empty or a score is not a number
[[nodiscard]] std::vector<RocPoint> roc(const std::vector<double>& marked, const std::vector<double>& unmarked);

/// The rate at which false positives and false negatives are equal, on the straight lines between the curve's points.
[[nodiscard]] double equal_error_rate(const std::vector<RocPoint>& curve);

} // namespace vcg_ext
