// SPDX-License-Identifier: GPL-3.0-or-later
// The library reads the marks that were made before: the format of a mark has not changed. tests/golden/make.py
#include "support/load.h"
#include "vcg_ext/method/methods.h"
#include "vcg_ext/watermark/watermark.h"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace vcg_ext;

namespace {

constexpr double tolerance = 1e-9;

template <class Enum>
Enum named(const std::string& text, const std::vector<Enum>& values)
{
    for (const Enum value : values)
        if (text == name(value))
            return value;
    throw std::runtime_error("golden.json names '" + text + "', which does not exist");
}

std::vector<Method> all_the_methods()
{
    std::vector<Method> methods;
    for (const MethodRow& row : all_methods())
        methods.push_back(row.method);
    return methods;
}

DetectOptions options_of(const nlohmann::json& mark)
{
    DetectOptions options;
    const nlohmann::json& settings = mark.at("settings");
    options.carriers.method = named(settings.at("Method"), all_the_methods());
    options.carriers.statistic = named(settings.at("Statistic"), std::vector{Statistic::Mean, Statistic::Variance});
    options.carriers.bits = settings.at("Bits");
    options.expected = {read_message(mark.at("message").get<std::string>())};
    return options;
}

void expect_close(double found, double wanted)
{
    EXPECT_NEAR(found, wanted, tolerance * std::abs(wanted));
}

} // namespace

TEST(Golden, AMarkReadsAsItDid)
{
    const auto marks = nlohmann::json::parse(std::ifstream(GOLDEN_DIR "/golden.json"));
    ASSERT_GE(marks.size(), 9u);
    std::map<std::string, Key> keys; // deriving one takes longer than reading
    for (const auto& mark : marks) {
        SCOPED_TRACE(mark.at("file"));
        const Surface surface = load_file(GOLDEN_DIR "/" + mark.at("file").get<std::string>());
        const DetectOptions options = options_of(mark);
        for (const auto& reading : mark.at("readings")) {
            const std::string secret = reading.at("key");
            SCOPED_TRACE(secret);
            const DetectReport found = detect(surface, keys.try_emplace(secret, secret).first->second, options);
            EXPECT_EQ(bit_string(found.bits), reading.at("bits"));
            const std::vector<double> soft = reading.at("soft");
            ASSERT_EQ(found.soft.size(), soft.size());
            for (std::size_t bit = 0; bit < soft.size(); ++bit)
                expect_close(found.soft[bit], soft[bit]);
            ASSERT_TRUE(found.p_value);
            expect_close(*found.p_value, reading.at("p_value"));
        }
    }
}
