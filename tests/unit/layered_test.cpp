// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/load.h"
#include "support/shapes.h"
#include "vcg_ext/attack/attack.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace vcg_ext;

namespace {

const Key& test_key()
{
    static const Key key("layered_test");
    return key;
}

EmbedOptions options_for(Method method)
{
    EmbedOptions options;
    options.carriers.method = method;
    options.carriers.bits = 64;
    options.message = read_message("id:17");
    return options;
}

DetectReport read(const Surface& surface, Method method)
{
    const EmbedOptions options = options_for(method);
    return detect(surface, test_key(), {options.carriers, {options.message}});
}

TEST(Layered, EachLayerReadsByItself)
{
    Surface stego = load("fandisk.off");
    const EmbedReport report = embed(stego, test_key(), options_for(Method::Layered));
    ASSERT_EQ(report.layers.size(), 2u);
    EXPECT_EQ(report.layers[0], Method::Waves);
    for (const Method layer : report.layers)
        EXPECT_TRUE(*read(stego, layer).present) << name(layer);
    const DetectReport both = read(stego, Method::Layered);
    EXPECT_TRUE(*both.present);
    EXPECT_LT(both.p_message, read(stego, Method::Waves).p_message);
    EXPECT_FALSE(both.carrier_of_vertex.empty());
}

TEST(Layered, OneLayerIsEnoughToBeRead)
{
    Surface stego = load("fandisk.off");
    embed(stego, test_key(), options_for(Method::Layered));
    Surface noisy = stego; // Waves' part does not last here
    apply_attack(noisy, {Attack::Noise, 0.005, -1, 1});
    EXPECT_TRUE(*read(noisy, Method::Layered).present);
    Surface coarse = stego; // and the other's not here
    apply_attack(coarse, {Attack::Isosurface, 0.005, -1, 1});
    EXPECT_TRUE(*read(coarse, Method::Layered).present);
}

TEST(Layered, WavesStayAloneWhereNothingFitsOnTop)
{
    // So few vertices that some patches and shells are empty.
    Surface cover = shapes::sphere(3);
    for (Point& p : cover.points)
        p = Point((1.4 + 0.2 * p[1]) * p[0] + 0.15 * p[0] * p[0], p[1] + 0.1 * p[1] * p[1], 0.75 * p[2]);
    EmbedOptions options = options_for(Method::Layered);
    options.carriers.bits = 128;
    options.placement.strength = 5e-4;
    Surface stego = cover;
    const EmbedReport report = embed(stego, test_key(), options);
    EXPECT_EQ(report.layers, std::vector<Method>{Method::Waves});
    ASSERT_FALSE(report.warnings.empty());
    const bool says = std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning) {
        return warning.find("Only Waves fits on this mesh") != std::string::npos;
    });
    EXPECT_TRUE(says);
    EXPECT_EQ(report.detection_ratio, 1);
    EXPECT_TRUE(*detect(stego, test_key(), {options.carriers, {options.message}}).present);
}

} // namespace
