// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace vcg_ext {

/// Times and who comes then, the earliest first, of equal ones the lowest number. For a front: who comes in is never
/// earlier than who went out last.
///
/// A calendar: times are put into narrow buckets, and only that of the present is kept in order (Brown 1988). So the
/// order is that of a heap of all, and the costs are those of a heap of few.
class FrontQueue {
public:
    using Entry = std::pair<double, int>;

    /// \param width of a bucket, above 0: such that a bucket holds some ten
    explicit FrontQueue(double width) : buckets_(count), scale_(1 / width) {}

    void push(double time, int number)
    {
        const std::int64_t bucket = bucket_of(time);
        if (bucket <= now_) {
            present_.emplace_back(time, number);
            std::push_heap(present_.begin(), present_.end(), std::greater<>());
        } else if (bucket < now_ + count) {
            buckets_[bucket % count].emplace_back(time, number);
            ++soon_;
        } else {
            later_.emplace(time, number);
        }
    }

    /// \return whether there was one
    [[nodiscard]] bool pop(Entry& earliest)
    {
        while (present_.empty())
            if (!turn_page())
                return false;
        std::pop_heap(present_.begin(), present_.end(), std::greater<>());
        earliest = present_.back();
        present_.pop_back();
        return true;
    }

private:
    static constexpr std::int64_t count = 1024;

    [[nodiscard]] std::int64_t bucket_of(double time) const
    {
        return static_cast<std::int64_t>(std::min(time * scale_, 9e18));
    }

    /// Makes the next bucket the present. \return false where all are empty
    bool turn_page()
    {
        if (soon_ > 0)
            ++now_;
        else if (!later_.empty())
            now_ = bucket_of(later_.top().first);
        else
            return false;
        present_.swap(buckets_[now_ % count]);
        soon_ -= present_.size();
        for (; !later_.empty() && bucket_of(later_.top().first) <= now_; later_.pop())
            present_.push_back(later_.top());
        std::make_heap(present_.begin(), present_.end(), std::greater<>());
        return true;
    }

    std::vector<Entry> present_; ///< a heap
    std::vector<std::vector<Entry>> buckets_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> later_; ///< than all buckets
    std::int64_t now_ = 0;
    std::size_t soon_ = 0; ///< in buckets
    double scale_;
};

} // namespace vcg_ext
