// SPDX-License-Identifier: GPL-3.0-or-later
#include "methods.h"

#include "../base/text.h"
#include "../geometry/curve.h"
#include "../geometry/rings.h"
#include "geodesic.h"
#include "norms.h"
#include "spectral.h"
#include "waves.h"

#include <optional>
#include <utility>

namespace vcg_ext {

namespace {

StrengthRange alpha(Statistic statistic)
{
    return {0.1, 0, statistic == Statistic::Mean ? 0.45 : 0.3};
}

StrengthRange displacement(Statistic /*statistic*/)
{
    return {1e-4, 1e-5, 2e-3};
}

StrengthRange squash(Statistic /*statistic*/)
{
    return {15, 2, 1000};
}

} // namespace

const std::vector<MethodRow>& all_methods()
{
    static const std::vector<MethodRow> methods = {
        {Method::Layered,
         "Layered",
         "Waves and another on top: survives the most",
         "",
         {{Method::Waves, 0}, {Method::Spectral, 4}, {Method::LM, 0.1}},
         false,
         true,
         number_by_rings,
         0,
         displacement,
         nullptr,
         nullptr,
         nullptr,
         nullptr,
         nullptr,
         nullptr,
         nullptr,
         nullptr},
        {Method::Waves,
         "Waves",
         "a smooth field: survives remeshing and smoothing",
         "waves",
         {{Method::Waves, 0}},
         false,
         true,
         nullptr,
         0,
         displacement,
         plan_waves,
         find_waves,
         read_by_waves,
         find_wave_copy,
         read_wave_copy,
         certify_waves,
         read_certified_waves,
         embed_by_waves},
        {Method::LM,
         "L-M",
         "vertex norms, the least visible",
         "norms",
         {{Method::LM, 0}},
         true,
         false,
         nullptr,
         1.5,
         alpha,
         plan_norms,
         find_norms,
         read_norms,
         nullptr,
         read_norms_copy,
         certify_norms,
         read_certified_norms,
         embed_norms<Radial::Sphere>},
        {Method::QSP,
         "QSP",
         "vertex norms, to compare",
         "norms",
         {{Method::QSP, 0}},
         true,
         false,
         nullptr,
         1.5,
         alpha,
         plan_norms,
         find_norms,
         read_norms,
         nullptr,
         read_norms_copy,
         certify_norms,
         read_certified_norms,
         embed_norms<Radial::Selective>},
        {Method::Cho,
         "Cho",
         "vertex norms, the fastest, more visible",
         "norms",
         {{Method::Cho, 0}},
         true,
         false,
         nullptr,
         1.5,
         alpha,
         plan_norms,
         find_norms,
         read_norms,
         nullptr,
         read_norms_copy,
         certify_norms,
         read_certified_norms,
         embed_norms<Radial::Straight>},
        {Method::Geodesic,
         "Geodesic",
         "distances along the surface",
         "strips",
         {{Method::Geodesic, 0}},
         true,
         false,
         number_by_curve,
         1.5,
         alpha,
         plan_geodesic,
         find_geodesic,
         read_geodesic,
         find_geodesic_copy,
         read_geodesic_copy,
         nullptr,
         nullptr,
         embed_geodesic},
        {Method::Spectral,
         "Spectral",
         "survives noise and smoothing",
         "patches",
         {{Method::Spectral, 0}},
         false,
         false,
         number_by_rings,
         0,
         squash,
         plan_spectral,
         find_spectral,
         read_spectral,
         find_spectral_copy,
         read_spectral_copy,
         nullptr,
         nullptr,
         embed_spectral},
    };
    return methods;
}

const MethodRow& row_of(Method method)
{
    for (const MethodRow& row : all_methods())
        if (row.method == method)
            return row;
    throw Error("There is no such method. Choose one of the list.");
}

Body body_for(const MethodRow& method, Surface surface)
{
    Body body = body_of(std::move(surface));
    if (method.number)
        method.number(body);
    return body;
}

MarkFrame find_copy(const MethodRow& method, const Copy& copy, const Plan& plan)
{
    return method.find_copy ? method.find_copy(copy, plan) : method.find_frame(copy.original, plan);
}

Readings read_certified(const MethodRow& method, const CertifiedCopy& copy, const Plan& plan)
{
    if (!method.read_certified)
        throw Error(std::string(method.name) +
                    " needs the original itself: give its layer as Original, and leave Certificate empty.");
    return method.read_certified(copy, plan);
}

const char* name(Method method)
{
    return row_of(method).name;
}

double checked_strength(const CarrierOptions& carriers, double strength)
{
    const StrengthRange range = row_of(carriers.method).strength(carriers.statistic);
    const double used = strength == 0 ? range.usual : strength;
    if (!(used > range.above && used <= range.most))
        throw Error("Strength is " + text(used) + ", but for this method it must lie above " + text(range.above) +
                    " and up to " + text(range.most) + ", or be 0 for the default of " + text(range.usual) + ".");
    return used;
}

} // namespace vcg_ext
