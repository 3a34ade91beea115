// SPDX-License-Identifier: GPL-3.0-or-later
#include "fold_guard.h"

#include "../base/parallel.h"
#include "../base/prefetch.h"

#include <algorithm>
#include <utility>

namespace vcg_ext {

namespace {

/// A set of numbers below `size`, listed in the order in which they first came.
class Distinct {
public:
    explicit Distinct(std::size_t size) : has_(size, 0) {}

    void add(int number)
    {
        if (!has_[number])
            list_.push_back(number);
        has_[number] = 1;
    }

    void clear()
    {
        for (const int number : list_)
            has_[number] = 0;
        list_.clear();
    }

    [[nodiscard]] const std::vector<int>& list() const { return list_; }

private:
    std::vector<char> has_;
    std::vector<int> list_;
};

/// Those for which `bad(number)` holds, asked in parallel.
template <class Bad>
std::vector<int> only(std::vector<int> numbers, const Bad& bad)
{
    std::vector<char> keep(numbers.size());
    for_each_index(static_cast<int>(numbers.size()), [&](int i) { keep[i] = bad(numbers[i]); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (keep[i])
            numbers[kept++] = numbers[i];
    numbers.resize(kept);
    return numbers;
}

Moves ascending(std::vector<std::pair<int, Point>> vertices)
{
    std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Moves moves;
    for (const auto& [vertex, before] : vertices) {
        moves.vertices.push_back(vertex);
        moves.before.push_back(before);
    }
    return moves;
}

bool is_folded(const Cover& cover, const Points& points, int face)
{
    return folded(cover, face, scaled_normal(points, cover.triangles[face]));
}

} // namespace

std::vector<int> folded_faces(const Cover& cover, const Points& points)
{
    return indices_where(static_cast<int>(cover.triangles.size()), [&](int f) {
        prefetch_corners(points, cover.triangles, f);
        return is_folded(cover, points, f);
    });
}

std::vector<int> folded_faces(const Cover& cover, const Points& points, const std::vector<int>& before,
                              const std::vector<int>& moved)
{
    if (8 * moved.size() > points.size())
        return folded_faces(cover, points);
    Distinct faces(cover.triangles.size());
    for (const int f : before)
        faces.add(f);
    for (const int v : moved)
        std::for_each(cover.around.begin(v), cover.around.end(v), [&](int f) { faces.add(f); });
    return only(faces.list(), [&](int f) { return is_folded(cover, points, f); });
}

Moves guard_folds(const Cover& cover, Points& placed, int steps, const std::function<Point(int, int)>& retreat)
{
    return guard_folds(cover, placed, folded_faces(cover, placed), steps, retreat);
}

Moves guard_folds(const Cover& cover, Points& placed, std::vector<int> bad, int steps,
                  const std::function<Point(int, int)>& retreat)
{
    std::vector<int> step(placed.size(), 0);
    std::vector<std::pair<int, Point>> back;
    Distinct vertices(placed.size());
    Distinct faces(cover.triangles.size());
    while (!bad.empty()) {
        vertices.clear();
        for (const int f : bad)
            for (const int v : cover.triangles[f])
                if (step[v] < steps && placed[v] != cover.points[v])
                    vertices.add(v);
        const std::vector<int>& list = vertices.list();
        for (const int v : list)
            if (step[v] == 0)
                back.emplace_back(v, placed[v]);
        for_each_index(static_cast<int>(list.size()), [&](int i) {
            const int v = list[i];
            placed[v] = ++step[v] == steps ? cover.points[v] : retreat(v, step[v]);
        });
        faces.clear();
        for (const int v : list)
            std::for_each(cover.around.begin(v), cover.around.end(v), [&](int f) { faces.add(f); });
        bad = only(faces.list(), [&](int f) { return is_folded(cover, placed, f); });
    }
    return ascending(std::move(back));
}

} // namespace vcg_ext
