// SPDX-License-Identifier: GPL-3.0-or-later
#include "histogram.h"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

namespace vcg_ext {

namespace {

/// |x| or |z| to the power beta; from their logarithms, which are taken once.
class Power {
public:
    Power(const std::vector<double>& values, const std::vector<double>& mobility, Statistic statistic, double guard)
        : mean_(statistic == Statistic::Mean), least_(mean_ ? guard : 0), most_(mean_ ? 1 - guard : 1 - 2 * guard),
          base_(Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size())))
    {
        if (!mean_)
            base_ = 2 * base_ - 1;
        log_ = base_.abs().max(1e-300).log();
        if (mobility.empty())
            return;
        const auto [least, most] = std::minmax_element(mobility.begin(), mobility.end());
        if (*least < *most)
            mobility_ = Eigen::Map<const Eigen::ArrayXd>(mobility.data(), base_.size()) / *most;
    }

    [[nodiscard]] Eigen::ArrayXd at(double log_beta) const
    {
        if (mobility_.size() == 0)
            return (std::exp(log_beta) * log_).exp().max(least_).min(most_);
        return ((log_beta * mobility_).exp() * log_).exp().max(least_).min(most_);
    }

    [[nodiscard]] double statistic(double log_beta) const
    {
        const Eigen::ArrayXd mapped = at(log_beta);
        return mean_ ? mapped.mean() : mapped.square().mean();
    }

    [[nodiscard]] std::vector<double> values(double log_beta) const
    {
        const Eigen::ArrayXd mapped = at(log_beta);
        std::vector<double> result(mapped.size());
        for (Eigen::Index i = 0; i < mapped.size(); ++i)
            result[i] = mean_ ? mapped[i] : (1 + std::copysign(mapped[i], base_[i])) / 2;
        return result;
    }

private:
    bool mean_;
    double least_;
    double most_;
    Eigen::ArrayXd base_;
    Eigen::ArrayXd log_;
    Eigen::ArrayXd mobility_; ///< empty where all are equal
};

} // namespace

std::vector<double> map_histogram(const std::vector<double>& values, Statistic statistic, double target, double guard,
                                  const std::vector<double>& mobility)
{
    if (values.empty())
        return {};
    const Power power(values, mobility, statistic, guard);
    const auto miss = [&](double log_beta) { return power.statistic(log_beta) - target; };

    // The statistic falls as beta grows. Real carriers are nearly uniform, and a narrow bracket holds what they need.
    for (const double widest : {0.7, 6.0}) { // beta from 1/2 to 2, from 1/400 to 400
        const double first = miss(-widest);
        const double last = miss(widest);
        if (first > 0 && last < 0) {
            std::uintmax_t steps = 100;
            const auto [low, high] = boost::math::tools::toms748_solve(
                miss, -widest, widest, first, last, boost::math::tools::eps_tolerance<double>(40), steps);
            return power.values((low + high) / 2);
        }
    }
    return power.values(miss(0) > 0 ? 6 : -6);
}

} // namespace vcg_ext
