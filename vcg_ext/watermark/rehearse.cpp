// SPDX-License-Identifier: GPL-3.0-or-later
#include "rehearse.h"

#include "../base/text.h"
#include "detect.h"

#include <cmath>

namespace vcg_ext {

std::vector<Rehearsal> rehearse(const Surface& marked, const Key& key, const CarrierOptions& carriers,
                                const Message& message, const Progress& progress)
{
    std::vector<Rehearsal> rehearsals = {{"noise .1 %", {Attack::Noise, 0.001}},
                                         {"simplification 50 %", {Attack::Simplify, 0.5}},
                                         {"smoothing .5 x 5", {Attack::Smooth, 0.5, 5}},
                                         {"quantization 9 bits", {Attack::Quantize, 9}}};
    for (std::size_t i = 0; i < rehearsals.size(); ++i) {
        const int percent = 100 * static_cast<int>(i) / static_cast<int>(rehearsals.size());
        report(progress, percent, "Rehearsing");
        const auto still = [&](int, const char*) { return !progress || progress(percent, "Rehearsing"); };
        Rehearsal& one = rehearsals[i];
        try {
            Surface copy = marked;
            apply_attack(copy, one.attack, still);
            const DetectReport found = detect(copy, key, {carriers, {message}}, still);
            one.p_value = *found.p_value;
            one.present = *found.present;
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) {
            // the mesh, or what is left of it, has no carriers: nothing is read
        }
    }
    return rehearsals;
}

std::string summary(const std::vector<Rehearsal>& rehearsals)
{
    std::string survived;
    std::string lost;
    for (const Rehearsal& one : rehearsals)
        if (one.present)
            survived +=
                (survived.empty() ? "" : ", ") + std::string(one.name) + " (" + chance(std::log10(one.p_value)) + ")";
        else
            lost += (lost.empty() ? "" : ", ") + std::string(one.name);
    std::string text = survived.empty() ? "" : "survives " + survived;
    if (!lost.empty())
        text += (text.empty() ? "is lost by " : "; is lost by ") + lost;
    return text + ".";
}

} // namespace vcg_ext
