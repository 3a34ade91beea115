// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace vcg_ext {

/// Disjoint sets of numbers.
class Sets {
public:
    explicit Sets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    int of(int i)
    {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// The lower number names the set, so the order of joining does not matter.
    void join(int a, int b)
    {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

} // namespace vcg_ext
