// SPDX-License-Identifier: GPL-3.0-or-later
#include "methods.h"

#include "../base/text.h"
#include "../geometry/curve.h"
#include "../geometry/rings.h"
#include "geodesic.h"
#include "norms.h"
#include "spectral.h"
#include "waves.h"

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

MethodRow row_for(Method method, const char* name, const char* hint, const char* secret)
{
    return {method, name, hint, secret, {{method, 0}}};
}

MethodRow layered_row()
{
    MethodRow row = row_for(Method::Layered, "Layered", "Waves and another on top: survives the most", "");
    row.layers = {{Method::Waves, 0}, {Method::Spectral, 4}, {Method::LM, 0.1}};
    row.is_smooth = true;
    row.number = number_by_rings;
    row.strength = displacement;
    return row;
}

MethodRow waves_row()
{
    MethodRow row = row_for(Method::Waves, "Waves", "a smooth field: survives remeshing and smoothing", "waves");
    row.is_smooth = true;
    row.strength = displacement;
    row.plan = plan_waves;
    row.find_frame = find_waves;
    row.read = read_by_waves;
    row.find_copy = find_wave_copy;
    row.read_copy = read_wave_copy;
    row.certify = certify_waves;
    row.read_certified = read_certified_waves;
    row.embed = embed_by_waves;
    return row;
}

template <Radial way>
MethodRow norms_row(Method method, const char* name, const char* hint)
{
    MethodRow row = row_for(method, name, hint, "norms");
    row.has_statistic = true;
    row.unmarked_strength = 1.5;
    row.strength = alpha;
    row.plan = plan_norms;
    row.find_frame = find_norms;
    row.read = read_norms;
    row.read_copy = read_norms_copy;
    row.certify = certify_norms;
    row.read_certified = read_certified_norms;
    row.embed = embed_norms<way>;
    return row;
}

MethodRow geodesic_row()
{
    MethodRow row = row_for(Method::Geodesic, "Geodesic", "distances along the surface", "strips");
    row.has_statistic = true;
    row.number = number_by_curve;
    row.unmarked_strength = 1.5;
    row.strength = alpha;
    row.plan = plan_geodesic;
    row.find_frame = find_geodesic;
    row.read = read_geodesic;
    row.find_copy = find_geodesic_copy;
    row.read_copy = read_geodesic_copy;
    row.embed = embed_geodesic;
    return row;
}

MethodRow spectral_row()
{
    MethodRow row = row_for(Method::Spectral, "Spectral", "survives noise and smoothing", "patches");
    row.number = number_by_rings;
    row.strength = squash;
    row.plan = plan_spectral;
    row.find_frame = find_spectral;
    row.read = read_spectral;
    row.find_copy = find_spectral_copy;
    row.read_copy = read_spectral_copy;
    row.embed = embed_spectral;
    return row;
}

} // namespace

const std::vector<MethodRow>& all_methods()
{
    static const std::vector<MethodRow> methods = {
        layered_row(),
        waves_row(),
        norms_row<Radial::Sphere>(Method::LM, "L-M", "vertex norms, the least visible"),
        norms_row<Radial::Selective>(Method::QSP, "QSP", "vertex norms, to compare"),
        norms_row<Radial::Straight>(Method::Cho, "Cho", "vertex norms, the fastest, more visible"),
        geodesic_row(),
        spectral_row(),
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
