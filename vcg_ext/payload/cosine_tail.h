// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace vcg_ext {

/// Natural logarithm of an upper bound of P(cos a_1 + ... + cos a_n >= sum), the a_k uniform and independent:
/// Chernoff's, the least over k >= 0 of n log I_0(k) - k sum. 0 where `sum` is not positive.
[[nodiscard]] double log_tail_of_cosines(int n, double sum);

/// The same to within a few percent by one of a fixed set of k: a bound too, and cheap.
class CosineTail {
public:
    explicit CosineTail(int n);

    [[nodiscard]] double operator()(double sum) const
    {
        // The best k grows with the sum, so near neighbours in the table are enough.
        const int i = sum <= 0 ? 0 : static_cast<int>(sum * scale_);
        const Line& line = lines_[i < last_ ? i : last_];
        const double bound = line.offset - line.slope * sum;
        return bound < 0 ? bound : 0;
    }

private:
    struct Line {
        double slope = 0;
        double offset = 0;
    };
    std::vector<Line> lines_;
    double scale_ = 0;
    int last_ = 0;
};

/// The table for `n`, made once.
[[nodiscard]] const CosineTail& cosine_tail(int n);

} // namespace vcg_ext
