// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <iterator>

namespace vcg_ext {

namespace {

int rank(Verdict verdict)
{
    constexpr Verdict rising[] = {Verdict::NotFound, Verdict::AnotherKey, Verdict::NoMessage, Verdict::AnotherMessage,
                                  Verdict::Present};
    return static_cast<int>(std::find(std::begin(rising), std::end(rising), verdict) - std::begin(rising));
}

/// The smaller one of what it says of the expected message and of any.
double best_p(const DetectReport& report)
{
    return std::min(report.p_value.value_or(1), report.p_message);
}

} // namespace

const char* name(Verdict verdict)
{
    constexpr const char* names[] = {"not found", "present", "another message", "another key or setting", "no message"};
    return names[static_cast<int>(verdict)];
}

bool says_more(const DetectReport& reading, const DetectReport& than)
{
    if (reading.finding != than.finding)
        return rank(reading.finding) > rank(than.finding);
    return best_p(reading) < best_p(than);
}

} // namespace vcg_ext
