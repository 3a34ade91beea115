// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../payload/message.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

/// One way of reading a surface: what its carriers say, by the number of the coded bit that they carry.
struct Reading {
    /// The share of all false alarms that this way may use. Those of all ways sum up to 1 at most, so the best of them,
    /// its probability divided by its weight, is still a true bound.
    double weight = 1;
    /// How far the carrier stands on the side of 1 (positive) or 0, in standard errors: proportional to the
    /// log-likelihood ratio; 0 where the surface has nothing to say of it, an erasure.
    std::vector<double> soft;
    std::vector<int> samples; ///< vertices in the carrier; empty where a carrier is no set of vertices
    std::vector<int> label;   ///< the carrier's number in Readings::label_of_vertex, or -1
    std::string orientation;  ///< how the body was held, where that is a choice; else empty
};

/// Everything that a method reads from a surface in one frame, before any secret mask is lifted.
struct Readings {
    std::vector<Reading> ways;        ///< at least one
    int blind = 0;                    ///< the way that the carriers themselves speak for: chosen without the mask
    std::vector<int> label_of_vertex; ///< -1: none; empty where a carrier is no set of vertices
    bool in_log_likelihoods = false;  ///< whether soft values are log-likelihood ratios; else they are standard errors
    /// log10 of a true bound of the probability that any mesh without a mark of this key looks like this, where the
    /// carriers can tell without their bits.
    std::optional<double> presence;
    /// log10 of a true bound for coded bits that are expected, where the method knows a better one than the ways' signs
    /// give; may be empty.
    std::function<double(const Bits& coded)> match;
    std::optional<int> smoothing_rounds;
    std::vector<std::string> warnings;
};

} // namespace vcg_ext
