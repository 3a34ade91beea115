#pragma once
#include <functional>
#include <vector>

namespace vcg_ext {

/// Sets how many threads for_chunks() uses; 0 (the default) is one per core. For tests: no result depends on it.
void set_threads(int count);

/// Calls `work(begin, end)` on the fixed pieces of [0, count) of `chunk` elements each (the last may be shorter).
///
/// The pieces depend on `count` and `chunk` alone. So a result does not depend on the number of threads where each
/// element is written by itself, or where each piece makes one partial result (number begin / chunk) and these are
/// summed in order. The first exception of the lowest piece is thrown again.
void for_chunks(int count, int chunk, const std::function<void(int begin, int end)>& work);

/// for_chunks() element by element.
template <class Work>
void for_each_index(int count, const Work& work)
{
    for_chunks(count, 4096, [&work](int begin, int end) {
        for (int i = begin; i < end; ++i)
            work(i);
    });
}

/// Sum of `term(i)` over [0, count), in an order that does not depend on the number of threads.
/// \param zero the neutral element; also says which type to sum in
template <class Value, class Term>
Value ordered_sum(int count, const Value& zero, const Term& term)
{
    constexpr int chunk = 4096;
    std::vector<Value> partial((count + chunk - 1) / chunk, zero);
    for_chunks(count, chunk, [&](int begin, int end) {
        Value sum = zero;
        for (int i = begin; i < end; ++i)
            sum += term(i);
        partial[begin / chunk] = sum;
    });
    Value total = zero;
    for (const Value& part : partial)
        total += part;
    return total;
}

} // namespace vcg_ext
