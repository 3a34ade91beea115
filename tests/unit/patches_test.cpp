// SPDX-License-Identifier: GPL-3.0-or-later
#include "vcg_ext/base/error.h"
#include "vcg_ext/base/weld.h"
#include "vcg_ext/carrier/thesis_patches.h"

#include "support/load.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace {

using namespace vcg_ext;

Patches cut(const Surface& surface, double trim)
{
    return equal_area_patches(surface.points, solid_topology(surface), edge_graph(surface), principal_frame(surface), 2,
                              35, trim);
}

/// Area by patch; each face counts a third at each vertex.
std::vector<double> areas(const Surface& surface, const Patches& patches)
{
    std::vector<double> area(patches.count(), 0);
    for (const Triangle& t : surface.triangles)
        for (const int v : t)
            if (patches.label[v] >= 0)
                area[patches.label[v]] += scaled_normal(surface.points, t).norm() / 6;
    return area;
}

double total_area(const Surface& surface)
{
    double sum = 0;
    for (const Triangle& t : surface.triangles)
        sum += scaled_normal(surface.points, t).norm() / 2;
    return sum;
}

/// Area of the faces whose centroid lies between two parts of the range along axis 1.
double area_between(const Surface& surface, double from, double to)
{
    const Frame frame = principal_frame(surface);
    const auto along = [&](const Point& p) { return frame.axes.col(0).dot(p); };
    std::vector<double> x;
    for (const Point& p : surface.points)
        x.push_back(along(p));
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    double sum = 0;
    for (const Triangle& t : surface.triangles) {
        const double place = ((x[t[0]] + x[t[1]] + x[t[2]]) / 3 - *low) / (*high - *low);
        if (place >= from && place < to)
            sum += scaled_normal(surface.points, t).norm() / 2;
    }
    return sum;
}

TEST(Patches, ThereAreSpareOnes)
{
    EXPECT_EQ(patch_count(64, 2), 70); // thesis 3.6.1
    EXPECT_EQ(patch_count(256, 2), 282);
    EXPECT_EQ(patch_count(1, 2), 8);
}

TEST(Patches, HaveEqualAreas)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    const double trim = 0.1;
    const std::vector<double> area = areas(bunny, cut(bunny, trim));
    const double equal = total_area(bunny) * (1 - 2 * trim) / 70;
    for (const double a : area)
        EXPECT_NEAR(a / equal, 1, 0.1); // cut on a smoothed copy, and vertices are whole
    EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0) / (70 * equal), 1, 0.005);
}

TEST(Patches, FollowTheBody)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    Surface moved = bunny;
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Point(1, 2, 3).normalized()).toRotationMatrix();
    for (Point& p : moved.points)
        p = 3 * rotation * p + Point(7, -5, 11);
    const std::vector<int> here = cut(bunny, 0.05).label;
    const std::vector<int> there = cut(moved, 0.05).label;
    int changed = 0;
    for (std::size_t v = 0; v < here.size(); ++v)
        changed += here[v] != there[v];
    EXPECT_LE(changed, 2); // vertices that lie on a border but for rounding
}

TEST(Patches, OfATurnedFrameAreTheFlippedOnes)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    const EdgeGraph graph = edge_graph(bunny);
    const Frame frame = principal_frame(bunny);
    const Patches patches = equal_area_patches(bunny.points, solid_topology(bunny), graph, frame, 2, 35, 0.1);
    for (const AxisFlips flips : {AxisFlips{true, false}, AxisFlips{false, true}, AxisFlips{true, true}}) {
        Frame turned = frame;
        if (flips.first)
            turned.axes.col(0) *= -1;
        if (flips.second)
            turned.axes.col(1) *= -1;
        const Patches other = equal_area_patches(bunny.points, solid_topology(bunny), graph, turned, 2, 35, 0.1);
        int changed = 0;
        for (std::size_t v = 0; v < patches.label.size(); ++v)
            changed += (patches.label[v] < 0) != (other.label[v] < 0) ||
                       (patches.label[v] >= 0 && patches.flipped(patches.label[v], flips) != other.label[v]);
        EXPECT_LE(changed, 2);
        for (int k = 0; k < patches.count(); ++k)
            EXPECT_EQ(patches.flipped(patches.flipped(k, flips), flips), k);
    }
}

TEST(Patches, OfTheThesisHaveEqualAreasToo)
{
    const Surface bunny = weld(load("bunny00.off")).surface;
    const Patches patches = thesis_patches(bunny.points, solid_topology(bunny), principal_frame(bunny), 2, 70, 0.1);
    EXPECT_GE(patches.count(), 67); // a leftover at the end of each of the two layers
    EXPECT_LE(patches.count(), 70);
    std::vector<double> area = areas(bunny, patches);
    std::sort(area.begin(), area.end());
    EXPECT_NEAR(area[area.size() / 2] / (area_between(bunny, 0.1, 0.9) / 70), 1, 0.05); // (3.11)
    const double median = area[area.size() / 2];
    for (const double a : area)
        EXPECT_NEAR(a / median, 1, 0.25); // a face at a border counts to one patch, here by thirds to both
}

TEST(Patches, RefuseASurfaceWithoutArea)
{
    const Surface line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 2, 3}}};
    const Frame frame = principal_frame(line);
    EXPECT_THROW((void)equal_area_patches(line.points, solid_topology(line), edge_graph(line), frame, 2, 4, 0.1),
                 Error);
    EXPECT_THROW((void)thesis_patches(line.points, solid_topology(line), frame, 2, 8, 0.1), Error);
}

} // namespace
