// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vcg_ext {

/// Rows of numbers, one behind the other: row `i` is `numbers[first[i]] .. numbers[first[i + 1] - 1]`.
struct CompressedRows {
    std::vector<int> first; ///< one more than there are rows
    std::vector<int> numbers;
};

/// \param usual  how long a row is, rather more than less
/// \param append `append(i, numbers)`: puts row i behind what stands there; on several threads
template <class Append>
[[nodiscard]] CompressedRows compressed_rows(int count, int usual, const Append& append)
{
    constexpr int chunk = 4096;
    constexpr int stretch = 32 * chunk; // at a time, so that they need little memory of their own
    CompressedRows rows;
    rows.first.assign(count + 1, 0);
    rows.numbers.reserve(static_cast<std::size_t>(usual) * count);
    std::vector<std::vector<int>> parts(stretch / chunk);
    for (int start = 0; start < count; start += std::min(stretch, count - start)) {
        for (std::vector<int>& part : parts)
            part.clear();
        for_chunks(std::min(stretch, count - start), chunk, [&](int begin, int end) {
            std::vector<int>& part = parts[begin / chunk];
            for (int i = start + begin; i < start + end; ++i) {
                const std::size_t before = part.size();
                append(i, part);
                rows.first[i + 1] = static_cast<int>(part.size() - before);
            }
        });
        for (const std::vector<int>& part : parts)
            rows.numbers.insert(rows.numbers.end(), part.begin(), part.end());
    }
    std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
    return rows;
}

} // namespace vcg_ext
