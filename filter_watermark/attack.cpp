// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer.h"
#include "report.h"
#include "shared_parameters.h"

#include <vcg_ext/attack/attack.h>
#include <vcg_ext/base/progress.h>

namespace {

QString info()
{
    QStringList amounts;
    for (const vcg_ext::Attack attack : vcg_ext::all_attacks()) {
        const vcg_ext::AttackRange& range = vcg_ext::range(attack);
        if (range.amount_is)
            amounts += QString("<i>%1</i>: %2 (%3)").arg(name(attack), range.amount_is).arg(range.amount);
    }
    return "Does to the mesh what a user, a file format or an adversary might, to try out what a watermark survives: "
           "noise, smoothing, simplification, quantization, remeshing, cropping and others.<br>"
           "It works in place, and nothing takes it back: duplicate the layer first to keep the original. The "
           "same seed gives the same result. A selection is ignored. Attacks that rebuild the mesh drop what it carried "
           "beside its shape (colours, texture coordinates).<br>"
           "<b>Amount</b>, with its usual value: " +
           amounts.join("; ") + ".";
}

RichParameterList parameters(const MeshDocument&)
{
    QStringList names;
    for (const vcg_ext::Attack attack : vcg_ext::all_attacks())
        names += name(attack);
    RichParameterList list;
    list.addParam(RichEnum("Attack", 0, names, "Attack",
                           "What to do to the mesh, which changes in place: duplicate the layer first."));
    list.addParam(RichFloat("Amount", -1, "Amount",
                            "How much, in the unit that the help names for each attack; -1 takes the usual amount."));
    list.addParam(RichInt("Iterations", -1, "Iterations",
                          "How often, for Smooth, Remesh, Subdivide, Taubin, Loop and Sqrt3; -1: as usual."));
    list.addParam(RichInt("Seed", 0, "Seed", "Of all random draws, 0 or more."));
    return list;
}

Json run(const RichParameterList& values, MeshDocument& document, const vcg_ext::Progress& progress)
{
    MeshModel& layer = current_layer_or_error(document);
    vcg_ext::AttackOptions options;
    options.attack = read_choice(values, "Attack", vcg_ext::all_attacks());
    options.amount = read_number(values, "Amount");
    options.iterations = values.getInt("Iterations");
    options.seed = read_seed(values);

    const bool stretched = is_stretched(layer);
    vcg_ext::Surface surface = read_surface(layer);
    const vcg_ext::AttackReport report = apply_attack(surface, options, progress);
    if (report.positions_only) {
        NormalShares shares(layer.cm.vert.size());
        write_positions(layer, surface.points, shares);
    } else {
        write_surface(layer, surface);
    }
    Json results = to_json(report);
    if (stretched)
        results["warnings"] = {stretched_as_written};
    return results;
}

} // namespace

const Filter attack_filter = {"Watermark: Attack",
                              "apply_watermark_attack",
                              HostInterface::Remeshing,
                              HostInterface::SINGLE_MESH,
                              int(MeshModel::MM_ALL),
                              info,
                              parameters,
                              run};
