// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../method/marking.h"
#include "../payload/message.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

/// Lengths are in the mesh's unit.
struct EmbedReport {
    Method method{};                  ///< as asked for
    Statistic statistic{};            ///< as asked for
    std::string message;              ///< as a detector shows it
    Bits bits;                        ///< what the carriers hold, the mask lifted: the coded message
    double strength = 0;              ///< as used
    double trim = 0;                  ///< as used
    int carriers = 0;                 ///< how many there are
    std::vector<Method> layers;       ///< methods that were put on top of each other
    int samples_min = 0;              ///< vertices in the poorest carrier; 0 where carriers are no sets of vertices
    int capacity = 0;                 ///< carriers that this mesh has vertices for, up to 1024
    double detection_ratio = 0;       ///< of the blind self-check: 1, or embedding fails
    int pieces = 1;                   ///< connected parts of the mesh
    int loose_pieces = 0;             ///< of them passed over
    int rounds = 0;                   ///< of correction, till every carrier had its margin
    int moved_vertices = 0;           ///< how many have another position
    int guarded_vertices = 0;         ///< not put where best, so that no face folds
    double max_displacement = 0;      ///< of any vertex, as stored
    double mrms = 0;                  ///< RMS distance between the surfaces, as stored
    double mrms_relative = 0;         ///< over the bounding box's diagonal
    double diagonal = 0;              ///< of the cover's bounding box
    std::optional<double> plane_bend; ///< Waves, Layered: degrees by which flat parts bend at most
    std::map<std::string, double> seconds; ///< by phase
    std::optional<SolverSummary> solver;   ///< L-M: its iterations a vertex
    std::optional<MoveCounts> moves;       ///< Geodesic: vertices by moves to their targets
    std::vector<std::string> warnings;     ///< what a user should know
    std::string recipe;                    ///< what a reader must set
};

/// What a detection comes to.
enum class Verdict {
    NotFound,       ///< no mark of this key that is certain: unmarked, or destroyed
    Present,        ///< the expected message; without one, a message that is verified
    AnotherMessage, ///< a verified message, but not the expected one
    AnotherKey,     ///< the carriers are far stronger than an unmarked mesh's, but no message of this key is certain
    NoMessage       ///< a mark of this key, but its message does not come out
};

[[nodiscard]] const char* name(Verdict verdict);

/// What one layer said by itself.
struct LayerReport {
    Method method{};                ///< of the layer
    std::optional<double> p_value;  ///< with an expected message
    double p_message = 1;           ///< with the key alone
    std::optional<double> presence; ///< Waves only
};

/// How a copy lies in its original.
struct RegistrationReport {
    bool found = false;                                 ///< whether it is a copy at all
    Eigen::Matrix4d pose = Eigen::Matrix4d::Identity(); ///< takes it to the original
    double scale = 1;                                   ///< its size over the original's
    bool mirrored = false;                              ///< whether it is a mirror image
    double stretch = 0;                                 ///< largest over least scale along any direction, less 1
    double overlap = 0;                                 ///< part of its area that lies on the original
    double residual = 0; ///< mean distance from there, the farthest twentieth left out, over the original's diagonal
    std::string by;      ///< what found it
};

/// A connected piece of the mesh that was looked at by itself.
struct PartReport {
    int vertices = 0;                               ///< of the part
    double area_share = 0;                          ///< of the mesh's area
    std::optional<RegistrationReport> registration; ///< with the original at hand
    std::optional<double> p_value; ///< with an expected message; its share of the doubt is taken off, as of p_message
    double p_message = 1;          ///< with the key alone
    std::string verdict;           ///< of the part
};

struct DetectReport {
    Method method{};       ///< as asked for
    Statistic statistic{}; ///< as asked for
    double trim = 0;       ///< as used
    int carriers = 0;      ///< as given, or as found
    Bits bits;             ///< what the carriers say, the mask lifted
    std::string message;   ///< that was read, where it is verified; else empty
    /// Per carrier how strongly it says 1 (positive) or 0: in standard errors; Waves: log-likelihood ratios; Layered:
    /// log-likelihood ratios of both layers.
    std::vector<double> soft;
    std::vector<int> samples; ///< per carrier: vertices in it; empty where carriers are no sets of those
    int pieces = 1;           ///< connected parts of the mesh
    int loose_pieces = 0;     ///< of them passed over
    /// Carriers that match those of the expected message, over all; one that the surface says nothing of counts a half.
    std::optional<double> detection_ratio;
    /// With an expected message: a true upper bound of the probability that a mesh without a mark of this key, or
    /// marked with another, matches as well by chance; of a list: that any of its messages does. Where the mesh has
    /// another message of this key, one that was drawn at random matches as well at most twice as often, and none of a
    /// list more often.
    std::optional<double> p_value;
    std::optional<double> p_binomial;  ///< the same by counting matches of what is read, as the literature does
    std::optional<bool> present;       ///< p_value below 1e-6, and no other message verified
    double p_message = 1;              ///< that such a mesh gives any message as well as the one that was read
    bool verified = false;             ///< p_message below 1e-6
    std::optional<double> presence;    ///< that such a mesh looks as marked, whatever the message; Waves and Layered
    std::optional<int> candidate;      ///< number of the best of a list of expected messages, from 0
    std::optional<double> runner_up_p; ///< p_value of the next best of the list
    /// 0 not found, 1 present, 2 another message, 3 another key or setting, 4 no message
    Verdict finding = Verdict::NotFound;
    std::string verdict;                            ///< the same in plain words, with figures
    std::vector<LayerReport> layers;                ///< what each layer said by itself
    std::optional<int> smoothing_rounds;            ///< Geodesic: of the surface before it was read
    std::map<std::string, double> seconds;          ///< by phase
    std::vector<std::string> warnings;              ///< what a user should know
    std::optional<RegistrationReport> registration; ///< with the original at hand
    std::vector<PartReport> parts;                  ///< where the mesh as a whole gave nothing and has several pieces
    /// Spectral: whether axis 1 and axis 2 were read along (+) or against (-) the body's third moments, as "++" or "-+".
    std::string orientation;
    /// Per vertex the number of the carrier that it is in, or -1; of the first layer whose carriers are sets of vertices,
    /// and empty where there is none, or where a piece of the mesh was read.
    std::vector<int> carrier_of_vertex;
};

/// Whether a reading says more than another: by what it found, and by its p where that is the same.
[[nodiscard]] bool says_more(const DetectReport& reading, const DetectReport& than);

} // namespace vcg_ext
