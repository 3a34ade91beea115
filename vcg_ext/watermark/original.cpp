// SPDX-License-Identifier: GPL-3.0-or-later
#include "original.h"

#include "../base/check.h"
#include "../geometry/body.h"
#include "../geometry/rings.h"
#include "../method/methods.h"
#include "../payload/code.h"
#include "copies.h"

#include <map>
#include <memory>

namespace vcg_ext {

namespace {

/// A mark on the original would be found on anything that looks like it.
void refuse_marked(const Surface& original, const Key& key, DetectOptions options)
{
    if (options.carriers.bits == 0 && row_of(options.carriers.method).is_smooth) // presence tells, whatever the number
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

/// Reads a copy in the original's frames, which are found once, whatever number of carriers is tried.
LayerReader read_by_original(const std::shared_ptr<const Copy>& copy)
{
    const auto frames = std::make_shared<std::map<Method, MarkFrame>>();
    return [copy, frames](const MethodRow& method, const Plan& plan) {
        if (frames->find(method.method) == frames->end())
            frames->emplace(method.method, find_copy(method, *copy, plan));
        return method.read_copy(*copy, plan, frames->at(method.method));
    };
}

} // namespace

DetectReport detect_with_original(const Surface& surface, const Surface& original, const Key& key,
                                  const DetectOptions& options, const Progress& progress)
{
    options.carriers.check();
    report(progress, 0, "Registering");
    check_surface(surface);
    Body unmarked = body_of(original, "original");
    number_by_rings(unmarked);
    refuse_marked(original, key, options);
    const FootSearch feet(unmarked.surface);
    const Registrar registrar(feet);
    const CopyReader reader = [&](const Surface& suspect, const Registration& registration) {
        return read_by_original(std::make_shared<const Copy>(unmarked.surface, suspect, registrar, registration));
    };
    return detect_copies(surface, registrar, reader, key, options, progress);
}

} // namespace vcg_ext
