#include "fold_guard.h"

#include "../parallel.h"

namespace vcg_ext {

namespace {

std::vector<int> sorted_unique(std::vector<int> numbers)
{
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

std::vector<int> faces_around(const Cover& cover, const std::vector<int>& vertices)
{
    std::vector<int> faces;
    for (const int v : vertices)
        faces.insert(faces.end(), cover.around.begin(v), cover.around.end(v));
    return sorted_unique(std::move(faces));
}

bool is_folded(const Cover& cover, const Points& points, int face)
{
    return folded(cover, face, scaled_normal(points, cover.triangles[face]));
}

} // namespace

std::vector<int> folded_faces(const Cover& cover, const Points& points)
{
    const int faces = static_cast<int>(cover.triangles.size());
    std::vector<char> bad(faces);
    for_each_index(faces, [&](int f) { bad[f] = is_folded(cover, points, f); });
    std::vector<int> result;
    for (int f = 0; f < faces; ++f)
        if (bad[f])
            result.push_back(f);
    return result;
}

std::vector<int> guard_folds(const Cover& cover, Points& placed, int steps,
                             const std::function<Point(int, int)>& retreat)
{
    std::vector<int> step(placed.size(), 0);
    std::vector<int> bad = folded_faces(cover, placed);
    while (!bad.empty()) {
        std::vector<int> vertices;
        for (const int f : bad)
            vertices.insert(vertices.end(), cover.triangles[f].begin(), cover.triangles[f].end());
        vertices = sorted_unique(std::move(vertices));
        vertices.erase(std::remove_if(vertices.begin(), vertices.end(),
                                      [&](int v) { return step[v] == steps || placed[v] == cover.points[v]; }),
                       vertices.end());
        for (const int v : vertices)
            placed[v] = ++step[v] == steps ? cover.points[v] : retreat(v, step[v]);
        if (vertices.empty())
            break;
        bad = faces_around(cover, vertices);
        bad.erase(std::remove_if(bad.begin(), bad.end(), [&](int f) { return !is_folded(cover, placed, f); }),
                  bad.end());
    }
    return step;
}

} // namespace vcg_ext
