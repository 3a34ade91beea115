// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

namespace vcg_ext {

/// What soft values prove. All of it rests on one thing: on a mesh without this mark, or under another key, the sign of
/// each soft value is a fair coin, whatever the magnitudes are, since a secret mask is xored on the coded bits.
///
/// Every probability is an upper bound and comes as its log10, at most 0, since 1e-308 is soon passed: 0 proves
/// nothing, -6 is one chance in a million. Soft values may have any scale; 0 is an erasure, and so is what is not a
/// number; a magnitude above 1e300 counts as 1e300.

/// Upper bounds of P(sum of s_k |l_k| >= total), s_k = +-1 fair coins, for any number of totals at the same l.
///
/// An exact count of the sign patterns whose wrong carriers weigh at most (sum of |l_k| - total) / 2, by dynamic
/// programming over weights rounded to max(8192, 64 K) cells. What the rounding may have taken off is added to the
/// limit, so that the bound stays one. Some 0.3 ms at K = 64 and 10 ms at K = 1024.
class SignTail {
public:
    explicit SignTail(const std::vector<double>& soft);

    /// The smaller of chernoff() and the count. \param total in the unit of the soft values
    [[nodiscard]] double log10_p(double total) const;

    /// The count alone: for a list of totals.
    [[nodiscard]] double log10_count(double total) const;

    /// log10 of the least of prod cosh(t l_k) exp(-t total) over t >= 0: any t is a bound, as E exp(t sum s_k l_k) is
    /// the product. Some 0.05 ms at K = 64; the better one where few carriers outweigh all others.
    [[nodiscard]] double log10_chernoff(double total) const;

private:
    [[nodiscard]] double wrong_weight(double total) const;

    std::vector<double> weight_; ///< |l_k| over the largest; zeros left out
    double scale_ = 0;           ///< the largest |l_k|
    double sum_ = 0;             ///< of weight_
    double cells_ = 0;           ///< per unit of weight
    double slack_ = 0;           ///< cells that rounding up can add to a sum
    std::vector<double> tail_;   ///< log10 P(rounded weight of the wrong carriers <= cell), up to a total of 0
};

/// log10 of an upper bound of P(sum of s_k |l_k| >= total): SignTail for one total.
[[nodiscard]] double log_tail(const std::vector<double>& soft, double total);

/// Sum of c_k l_k with c_k = +1 for a coded bit 1 and -1 for 0. \throw Error where the lengths differ
[[nodiscard]] double agreement(const std::vector<unsigned char>& coded, const std::vector<double>& soft);

/// That any of the 2^bits messages agrees so well: log10 min(1, 2^bits p).
[[nodiscard]] double log_any_message(double log10_p, int bits);

} // namespace vcg_ext
