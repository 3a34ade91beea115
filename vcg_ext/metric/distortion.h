// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../base/error.h"
#include "../base/progress.h"
#include "../base/surface.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vcg_ext {

struct DistortionOptions {
    int samples = 0;        ///< points per direction; 0 is ten per vertex of the larger mesh
    std::uint64_t seed = 0; ///< of the sampling
};

struct DistortionReport {
    double mrms = 0;               ///< the larger of the two RMS distances (thesis, 2.16)
    double hausdorff = 0;          ///< largest distance of any sample or vertex to the other surface, both directions
    double mean = 0;               ///< the larger of the two mean distances
    double diagonal = 0;           ///< of the reference's bounding box
    double mrms_relative = 0;      ///< over the diagonal
    double hausdorff_relative = 0; ///< likewise
    double mean_relative = 0;      ///< likewise
    std::optional<double> snr_db;  ///< signal to noise of the vertices; empty where nothing moved (it is infinite)
    std::optional<double> msdm;    ///< perceptual distance (MSDM): 0 for equal meshes, at most 1.34
    std::optional<double> volume_change; ///< of the enclosed volume, relative; empty where a mesh encloses none
    double area_change = 0;              ///< relative
    int samples = 0;                     ///< per direction, as used
    std::vector<double> distance;        ///< per vertex of the measured mesh: to the reference's surface
    std::vector<std::string> warnings;   ///< what a user should know
};

/// Compares `measured` with `reference`. Same input, same answer: on any machine, at any number of threads.
///
/// Distances as Metro takes them: points spread over one surface in proportion to area, to the nearest point of the
/// other surface, in both directions. Vertices at one position count once.
///
/// SNR is 10 log10 of sum |v - o|^2 over sum |v' - v|^2, o the mean of the reference's vertices. v' is the vertex of
/// the same number where both meshes have the same faces; otherwise v' are the measured mesh's vertices and v the
/// nearest points.
///
/// \throw Error      where a mesh has no face with an area, or a coordinate is not finite
/// \throw Cancelled  where `progress` returned false; it is asked some twenty times a phase, by the calling thread
[[nodiscard]] DistortionReport measure(const Surface& reference, const Surface& measured,
                                       const DistortionOptions& options = {}, const Progress& progress = {});

} // namespace vcg_ext
