// SPDX-License-Identifier: GPL-3.0-or-later
// Marks upon marks: the same again, and a second key's over the first.

#include "support/load.h"
#include "vcg_ext/watermark/watermark.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>

using namespace vcg_ext;

namespace {

class Layers : public testing::TestWithParam<Method> {
protected:
    EmbedOptions options_for(const char* message) const
    {
        EmbedOptions options;
        options.carriers.method = GetParam();
        options.message = read_message(message);
        return options;
    }
};

double ratio(const Surface& surface, const Key& key, const EmbedOptions& embedded)
{
    DetectOptions options;
    options.carriers = embedded.carriers;
    options.expected = {embedded.message};
    return *detect(surface, key, options).detection_ratio;
}

TEST_P(Layers, TheSameAgainMovesNextToNothing)
{
    Surface surface = load("fandisk.off");
    const Key key("layers");
    const EmbedOptions options = options_for("museum");
    const double first = embed(surface, key, options).mrms;
    EXPECT_LE(embed(surface, key, options).mrms, 0.05 * first);
    EXPECT_EQ(ratio(surface, key, options), 1);
}

// The last mark counts. What is left of the first is recorded: no method here promises that it stays.
TEST_P(Layers, ASecondKeyReadsWholeOverTheFirst)
{
    Surface surface = load("bunny00.off");
    const Key first("first");
    const Key second("second");
    const EmbedOptions museum = options_for("museum");
    const EmbedOptions buyer = options_for("buyer");
    embed(surface, first, museum);
    embed(surface, second, buyer);
    EXPECT_EQ(ratio(surface, second, buyer), 1);
    const std::string left = std::to_string(ratio(surface, first, museum));
    RecordProperty("first_mark", left);
    std::cout << "the first mark's ratio under the second: " << left << '\n';
}

INSTANTIATE_TEST_SUITE_P(Watermark, Layers,
                         testing::Values(Method::LM, Method::QSP, Method::Cho, Method::Geodesic, Method::Spectral),
                         [](const auto& info) {
                             std::string text = name(info.param);
                             text.erase(std::remove(text.begin(), text.end(), '-'), text.end());
                             return text;
                         });

} // namespace
