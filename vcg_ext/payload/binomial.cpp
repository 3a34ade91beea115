// SPDX-License-Identifier: GPL-3.0-or-later
#include "binomial.h"

#include "../base/error.h"

#include <boost/math/distributions/binomial.hpp>

namespace vcg_ext {

double binomial_tail(int n, int k)
{
    if (n < 0)
        throw Error("A number of bits cannot be negative.");
    if (k <= 0)
        return 1;
    if (k > n)
        return 0;
    namespace policies = boost::math::policies;
    using InDouble = policies::policy<policies::promote_double<false>>; // `long double` differs between platforms
    const boost::math::binomial_distribution<double, InDouble> coins(n, 0.5);
    return cdf(complement(coins, k - 1));
}

int matching_bits(const Bits& expected, const Bits& found)
{
    if (expected.size() != found.size())
        throw Error("Messages of " + std::to_string(expected.size()) + " and " + std::to_string(found.size()) +
                    " bits cannot be compared. Pad the shorter one.");
    int matches = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        matches += expected[i] == found[i];
    return matches;
}

} // namespace vcg_ext
