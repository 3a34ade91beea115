// SPDX-License-Identifier: GPL-3.0-or-later
#include "original.h"

#include "../base/check.h"
#include "../base/stopwatch.h"
#include "../base/text.h"
#include "../geometry/body.h"
#include "../method/methods.h"
#include "../payload/code.h"
#include "detect.h"
#include "pieces.h"

#include <Eigen/SVD>
#include <cmath>
#include <cstdio>
#include <map>

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

/// A mark on the original would be found on anything that looks like it.
void refuse_marked(const Surface& original, const Key& key, DetectOptions options)
{
    if (options.carriers.bits == 0)
        options.carriers.bits =
            options.expected.empty() ? recommended_numbers().front() : recommended_carriers(options.expected.front());
    options.carriers.quick = true;
    DetectReport found;
    try {
        found = detect(original, key, options);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error&) {
        return; // what cannot be read has no mark
    }
    constexpr double sure = 1e-6;
    if (found.verified || found.present.value_or(false) || found.presence.value_or(1) < sure)
        throw Error("The original carries a mark of this key itself, so whatever looks like it would seem marked. Give "
                    "the mesh as it was before embedding. (Are the two meshes swapped?)");
}

/// An original, and how to look at surfaces with it.
class Examination {
public:
    /// \param original as body_of() mends it; must outlive it, like all else
    Examination(const Surface& original, const Key& key, const DetectOptions& options)
        : original_(original), key_(key), options_(options), feet_(original), registrar_(feet_)
    {
    }

    /// \param surface welded  \param share see detect_by()
    DetectReport operator()(const Surface& surface, const std::vector<int>& site_of_vertex, double share,
                            const Progress& progress)
    {
        Stopwatch watch;
        const Copy copy{original_, surface, registrar_, registrar_(surface, within(progress, 0, 50))};
        const double registering = watch.lap();
        DetectReport result;
        if (copy.registration.found) {
            std::map<Method, MarkFrame> frames;
            const LayerReader read = [&](const MethodRow& method, const Plan& plan) {
                if (frames.find(method.method) == frames.end())
                    frames.emplace(method.method, find_copy(method, copy, plan));
                return method.read_copy(copy, plan, frames.at(method.method));
            };
            result = detect_by(read, site_of_vertex, share, key_, options_, within(progress, 50, 100));
        } else {
            result.method = options_.carriers.method;
            result.statistic = options_.carriers.statistic;
            result.verdict = no_copy(copy.registration);
            if (!options_.expected.empty()) {
                result.p_value = 1;
                result.present = false;
            }
        }
        result.registration = told(copy.registration);
        result.seconds["registration"] = registering;
        result.seconds["detection"] = watch.lap();
        return result;
    }

private:
    const Surface& original_;
    const Key& key_;
    const DetectOptions& options_;
    FootSearch feet_;
    Registrar registrar_;
};

} // namespace

DetectReport detect_with_original(const Surface& surface, const Surface& original, const Key& key,
                                  const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    report(progress, 0, "Registering");
    const Welded welded = checked_weld(surface);
    const Body unmarked = body_of(original, "original");
    refuse_marked(original, key, options);
    Examination examine(unmarked.surface, key, options);
    const std::vector<Part> pieces = pieces_to_look_at(welded.surface);
    DetectReport result = examine(welded.surface, welded.site_of_vertex, share_of_whole(pieces),
                                  within(progress, 5, pieces.empty() ? 100 : 40));
    const PieceReader read = [&](const Surface& piece, double share, const Progress& quietly) {
        return examine(piece, {}, share, quietly);
    };
    if (!pieces.empty() && result.finding != Verdict::Present)
        look_at_pieces(read, pieces, result, within(progress, 40, 100));
    report(progress, 100, "Done");
    return result;
}

} // namespace vcg_ext
