// SPDX-License-Identifier: GPL-3.0-or-later
#include "copies.h"

#include "../base/check.h"
#include "../base/stopwatch.h"
#include "../base/text.h"
#include "pieces.h"

#include <Eigen/SVD>
#include <cstdio>

namespace vcg_ext {

namespace {

RegistrationReport told(const Registration& registration)
{
    RegistrationReport result;
    result.found = registration.found;
    result.pose = registration.affine.matrix();
    result.scale = registration.scale();
    result.mirrored = registration.mirrored();
    const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::Matrix3d>(registration.affine.linear()).singularValues();
    result.stretch = sizes[0] / sizes[2] - 1;
    result.overlap = registration.overlap;
    result.residual = registration.residual;
    result.by = registration.by;
    return result;
}

/// Of the doubt; the rest is for a look with the key alone, whose carriers some attacks leave where the original's are
/// gone: those of a mesh that was resampled or simplified with its edges, and that is laid on well.
constexpr double share_of_copies = 0.8;

/// Looks with the key alone, and takes that where it says more.
void look_alone(const Surface& surface, const Key& key, const DetectOptions& options, DetectReport& result,
                const Progress& progress)
{
    DetectReport alone;
    try {
        alone = detect_whole(surface, key, options, 1 - share_of_copies, progress);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error&) {
        return; // it cannot be read alone
    }
    if (!says_more(alone, result))
        return;
    alone.registration = result.registration;
    alone.parts = std::move(result.parts);
    for (const auto& [phase, seconds] : result.seconds)
        alone.seconds[phase] += seconds;
    if (alone.finding != Verdict::NotFound)
        alone.verdict = "by the key alone: " + alone.verdict;
    result = std::move(alone);
}

std::string no_copy(const Registration& registration)
{
    char residual[32];
    std::snprintf(residual, sizeof residual, "%.1e", registration.residual);
    std::string text = "not a copy of this original: laid on it as well as can be, " + percent(registration.overlap) +
                       " of the mesh lies near it, at a mean distance of " + residual + " of its diagonal.";
    if (registration.overlap > 0.3)
        text += " Are the two swapped, or was something added to the mesh?";
    return text;
}

} // namespace

DetectReport detect_copies(const Surface& surface, const Registrar& registrar, const CopyReader& reader, const Key& key,
                           const DetectOptions& options, const Progress& progress)
{
    const Welded welded = checked_weld(surface);
    const auto examine = [&](const Surface& suspect, const std::vector<int>& site_of_vertex, double share,
                             const Progress& quietly) {
        Stopwatch watch;
        const Registration registration = registrar(suspect, within(quietly, 0, 50));
        const double registering = watch.lap();
        DetectReport result;
        if (registration.found) {
            result =
                detect_by(reader(suspect, registration), site_of_vertex, share, key, options, within(quietly, 50, 100));
        } else {
            result.method = options.carriers.method;
            result.statistic = options.carriers.statistic;
            result.verdict = no_copy(registration);
            if (!options.expected.empty()) {
                result.p_value = 1;
                result.present = false;
            }
        }
        result.registration = told(registration);
        result.seconds["registration"] = registering;
        result.seconds["detection"] = watch.lap();
        return result;
    };
    const std::vector<Part> pieces = pieces_to_look_at(welded.surface);
    DetectReport result = examine(welded.surface, welded.site_of_vertex, share_of_copies * share_of_whole(pieces),
                                  within(progress, 5, pieces.empty() ? 80 : 40));
    const PieceReader read = [&](const Surface& piece, double share, const Progress& quietly) {
        return examine(piece, {}, share_of_copies * share, quietly);
    };
    if (!pieces.empty() && result.finding != Verdict::Present)
        look_at_pieces(read, pieces, result, within(progress, 40, 80));
    if (result.registration->found && !result.verified && result.finding != Verdict::Present)
        look_alone(surface, key, options, result, within(progress, 80, 100));
    report(progress, 100, "Done");
    return result;
}

} // namespace vcg_ext
