// SPDX-License-Identifier: GPL-3.0-or-later
#include "original.h"

#include "../base/check.h"
#include "../base/stopwatch.h"
#include "../base/text.h"
#include "../geometry/solid.h"
#include "../method/methods.h"
#include "../payload/code.h"
#include "detect.h"

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

std::string percent(double part)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.0f %%", 100 * part);
    return buffer;
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

} // namespace

DetectReport detect_with_original(const Surface& surface, const Surface& original, const Key& key,
                                  const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    Stopwatch watch;
    report(progress, 0, "Registering");
    const Welded welded = checked_weld(surface);
    const Welded unmarked = checked_weld(original, "original");
    refuse_marked(original, key, options);
    const FootSearch feet(sewn_surface(solid_topology(unmarked.surface), unmarked.surface.points));
    const Registrar registrar(feet);
    const Copy copy{unmarked.surface, welded.surface, registrar, registrar(welded.surface, within(progress, 5, 50))};
    const double registering = watch.lap();

    DetectReport result;
    if (copy.registration.found) {
        std::map<Method, MarkFrame> frames;
        const LayerReader read = [&](const MethodRow& method, const Plan& plan) {
            if (frames.find(method.method) == frames.end())
                frames.emplace(method.method, find_copy(method, copy, plan));
            return read_copy(method, copy, plan, frames.at(method.method));
        };
        result = detect_by(read, welded.site_of_vertex, key, options, within(progress, 50, 100));
    } else {
        result.method = options.carriers.method;
        result.statistic = options.carriers.statistic;
        result.verdict = no_copy(copy.registration);
        if (!options.expected.empty()) {
            result.p_value = 1;
            result.present = false;
        }
    }
    result.registration = told(copy.registration);
    result.seconds["registration"] = registering;
    result.seconds["detection"] = watch.lap();
    return result;
}

} // namespace vcg_ext
