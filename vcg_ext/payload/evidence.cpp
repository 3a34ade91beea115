// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"

#include "../base/error.h"
#include "soft.h"

#include <algorithm>
#include <cmath>

namespace vcg_ext {

namespace {

constexpr double ln_10 = 2.302585092994045684;
constexpr double rounding = 1e-12; // more than all sums of 1024 doubles lose, relative to the sum

} // namespace

SignTail::SignTail(const std::vector<double>& soft)
{
    for (const double l : soft)
        scale_ = std::max(scale_, std::abs(usable(l)));
    for (const double l : soft)
        if (const double weight = scale_ > 0 ? std::abs(usable(l)) / scale_ : 0; weight > 0)
            weight_.push_back(weight);
    for (const double w : weight_)
        sum_ += w;
    if (weight_.empty())
        return;

    const double count = static_cast<double>(weight_.size());
    cells_ = std::max(8192.0, 64 * count) / sum_;
    std::vector<std::size_t> rounded;
    for (const double w : weight_) {
        rounded.push_back(static_cast<std::size_t>(std::floor(w * cells_ + 0.5)));
        slack_ += std::max(0.0, static_cast<double>(rounded.back()) - w * cells_);
    }

    // Patterns by the weight of their wrong carriers. One counts 2^-100, since 2^1024 would be no double; of two layers
    // as little as it can: then what is no double is more than a quarter of all.
    const int one = count > 1024 ? 1022 : 100;
    std::vector<double> patterns(static_cast<std::size_t>(wrong_weight(0) * cells_ + slack_) + 1, 0.0);
    patterns[0] = std::ldexp(1.0, -one);
    std::size_t reached = 0;
    for (const std::size_t step : rounded) {
        reached = std::min(reached + step, patterns.size() - 1);
        for (std::size_t cell = reached; cell >= step && cell < patterns.size(); --cell)
            patterns[cell] += patterns[cell - step];
    }
    double sum = 0;
    for (const double p : patterns)
        tail_.push_back(std::min(0.0, std::log10(sum += p) + (one - count) * log10_2 + rounding));
}

double SignTail::wrong_weight(double total) const
{
    return std::max(0.0, sum_ - total / scale_) / 2 + rounding * sum_;
}

double SignTail::log10_count(double total) const
{
    if (tail_.empty() || !(total > 0))
        return 0;
    const double cell = std::floor(wrong_weight(total) * cells_ + slack_);
    return tail_[std::min(static_cast<std::size_t>(cell), tail_.size() - 1)];
}

double SignTail::log10_chernoff(double total) const
{
    if (weight_.empty() || !(total > 0))
        return 0;
    const double wrong = wrong_weight(total);
    // ln prod cosh(t w) exp(-t T), without the difference of large numbers: cosh x = e^x (1 + e^-2x) / 2.
    const auto exponent = [&](double t) {
        double sum = 2 * t * wrong;
        for (const double w : weight_)
            sum += std::log1p(std::exp(-2 * t * w));
        return sum - std::log(2.0) * static_cast<double>(weight_.size());
    };
    const auto falling = [&](double t) { // the exponent's derivative, over 2
        double sum = wrong;
        for (const double w : weight_)
            sum -= w / (1 + std::exp(2 * t * w));
        return sum < 0;
    };
    double low = 0;
    double high = 1 / sum_;
    while (falling(high) && high < 1e15)
        high *= 4;
    for (int step = 0; step < 30; ++step) {
        const double middle = (low + high) / 2;
        (falling(middle) ? low : high) = middle;
    }
    return std::min(0.0, exponent(high) / ln_10 + rounding);
}

double SignTail::log10_p(double total) const
{
    return std::min(log10_count(total), log10_chernoff(total));
}

double log_tail(const std::vector<double>& soft, double total)
{
    return SignTail(soft).log10_p(total);
}

double agreement(const std::vector<unsigned char>& coded, const std::vector<double>& soft)
{
    if (coded.size() != soft.size())
        throw Error("Coded bits and soft values must be equally many.");
    double sum = 0;
    for (std::size_t k = 0; k < soft.size(); ++k)
        sum += coded[k] ? usable(soft[k]) : -usable(soft[k]);
    return sum;
}

double log_any_message(double log10_p, int bits)
{
    return std::min(0.0, log10_p + bits * log10_2);
}

} // namespace vcg_ext
