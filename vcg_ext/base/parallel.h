// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "progress.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace vcg_ext {

/// Sets how many threads for_chunks() uses; 0 (the default) is as many as OMP_NUM_THREADS says, or else one per core. For
/// tests: no result depends on it. Threads that are there already stay for later calls.
void set_threads(int count);

/// How many pieces of `chunk` elements [0, count) has; the last may be shorter.
/// \pre chunk > 0
[[nodiscard]] inline int chunk_count(int count, int chunk)
{
    return count / chunk + (count % chunk > 0);
}

/// Calls `work(begin, end)` on the fixed pieces of [0, count) of `chunk` elements each (the last may be shorter).
///
/// The pieces depend on `count` and `chunk` alone. So a result does not depend on the number of threads where each
/// element is written by itself, or where each piece makes one partial result (number begin / chunk) and these are
/// summed in order. `work` may call for_chunks() itself.
///
/// \throw what `work` threw, of several pieces the lowest's; the others are done nevertheless
void for_chunks(int count, int chunk, const std::function<void(int begin, int end)>& work);

/// The same in some 20 steps, more where pieces are many. The calling thread tells `progress`, from 0 percent on, before each of them.
///
/// \throw Cancelled where `progress` returned false: the pieces of later steps are not done
void for_chunks(int count, int chunk, const Progress& progress, const char* phase,
                const std::function<void(int begin, int end)>& work);

/// Both, at the same time where there are cores for it.
template <class First, class Second>
void side_by_side(const First& first, const Second& second)
{
    for_chunks(2, 1, [&](int begin, int /*end*/) { begin == 0 ? first() : second(); });
}

/// for_chunks() element by element.
template <class Work>
void for_each_index(int count, const Work& work)
{
    for_chunks(count, 4096, [&work](int begin, int end) {
        for (int i = begin; i < end; ++i)
            work(i);
    });
}

/// Takes up all i of [0, count) by `take(value, i)`, in an order that does not depend on the number of threads.
/// \param zero what a value starts as; also says its type
/// \param join `join(value, part)`: takes up what a part of the range came to
template <class Value, class Take, class Join>
Value ordered_fold(int count, const Value& zero, const Take& take, const Join& join)
{
    constexpr int chunk = 4096;
    std::vector<Value> partial(chunk_count(count, chunk), zero);
    for_chunks(count, chunk, [&](int begin, int end) {
        Value value = zero;
        for (int i = begin; i < end; ++i)
            take(value, i);
        partial[begin / chunk] = std::move(value);
    });
    Value total = zero;
    for (const Value& part : partial)
        join(total, part);
    return total;
}

/// The i of [0, count) for which `wanted(i)` holds, in ascending order.
template <class Wanted>
std::vector<int> indices_where(int count, const Wanted& wanted)
{
    return ordered_fold(
        count, std::vector<int>(),
        [&wanted](std::vector<int>& found, int i) {
            if (wanted(i))
                found.push_back(i);
        },
        [](std::vector<int>& found, const std::vector<int>& part) {
            found.insert(found.end(), part.begin(), part.end());
        });
}

/// Sum of `term(i)` over [0, count).
template <class Value, class Term>
Value ordered_sum(int count, const Value& zero, const Term& term)
{
    return ordered_fold(
        count, zero, [&term](Value& sum, int i) { sum += term(i); },
        [](Value& sum, const Value& part) { sum += part; });
}

/// The largest `term(i)` over [0, count), or `least` where none is larger.
template <class Value, class Term>
Value ordered_maximum(int count, const Value& least, const Term& term)
{
    const auto raise = [](Value& largest, const Value& other) { largest = std::max(largest, other); };
    return ordered_fold(
        count, least, [&](Value& largest, int i) { raise(largest, term(i)); }, raise);
}

struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};

/// The least and the largest `term(i)` over [0, count).
template <class Term>
Range range_of(int count, const Term& term)
{
    return ordered_fold(
        count, Range(),
        [&term](Range& range, int i) {
            const double here = term(i);
            range = {std::min(range.least, here), std::max(range.most, here)};
        },
        [](Range& range, const Range& part) {
            range = {std::min(range.least, part.least), std::max(range.most, part.most)};
        });
}

} // namespace vcg_ext
