// SPDX-License-Identifier: GPL-3.0-or-later
#include "text.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace vcg_ext {

std::string text(double number)
{
    std::stringstream stream;
    stream.imbue(std::locale::classic());
    for (int digits = 6;; ++digits) {
        stream.str({});
        stream.clear();
        stream.precision(digits);
        stream << number;
        double back = 0;
        if (digits == std::numeric_limits<double>::max_digits10 || !std::isfinite(number) ||
            (stream >> back && back == number))
            return stream.str();
    }
}

std::string chance(double log10_p)
{
    return "p 1e" + std::to_string(static_cast<int>(std::ceil(log10_p)));
}

std::string percent(double part)
{
    return std::to_string(std::lround(100 * part)) + " %";
}

bool starts_with(std::string_view text, std::string_view prefix)
{
    return text.substr(0, prefix.size()) == prefix;
}

} // namespace vcg_ext
