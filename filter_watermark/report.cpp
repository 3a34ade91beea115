// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <QDir>
#include <QFileInfo>
#include <vcg_ext/base/version.h>

#include <algorithm>

namespace {

Json names_of(const std::vector<vcg_ext::Method>& methods)
{
    Json names = Json::array();
    for (const vcg_ext::Method method : methods)
        names.push_back(name(method));
    return names;
}

Json to_json(const vcg_ext::LayerReport& layer)
{
    Json json = {{"method", name(layer.method)}, {"p_message", layer.p_message}};
    if (layer.p_value)
        json["p_value"] = *layer.p_value;
    if (layer.presence)
        json["presence"] = *layer.presence;
    return json;
}

Json to_json(const vcg_ext::RegistrationReport& registration)
{
    std::vector<double> pose; // row by row
    for (int i = 0; i < 16; ++i)
        pose.push_back(registration.pose(i / 4, i % 4));
    return {{"found", registration.found},
            {"scale", registration.scale},
            {"mirrored", registration.mirrored},
            {"stretch", registration.stretch},
            {"overlap", registration.overlap},
            {"residual", registration.residual},
            {"by", registration.by},
            {"pose", pose}};
}

Json to_json(const vcg_ext::PartReport& part)
{
    Json json = {{"vertices", part.vertices}, {"area_share", part.area_share}};
    if (part.p_value)
        json["p_value"] = *part.p_value;
    json["p_message"] = part.p_message;
    if (part.registration)
        json["registration"] = to_json(*part.registration);
    json["verdict"] = part.verdict;
    return json;
}

/// What the mark does to the surface, in the mesh's own unit.
std::string change(const vcg_ext::EmbedReport& report)
{
    return QString("the surface moves by %1 (RMS), its vertices by up to %2, on a body of %3 (diagonal), in the mesh's "
                   "unit.")
        .arg(report.mrms, 0, 'g', 3)
        .arg(report.max_displacement, 0, 'g', 3)
        .arg(report.diagonal, 0, 'g', 4)
        .toStdString();
}

} // namespace

Json to_json(const vcg_ext::EmbedReport& report, const std::vector<vcg_ext::Rehearsal>& rehearsals)
{
    Json json = {
        {"method", name(report.method)},
        {"statistic", name(report.statistic)},
        {"message", report.message},
        {"bits", vcg_ext::bit_string(report.bits)},
        {"strength", report.strength},
        {"trim", report.trim},
        {"carriers", report.carriers},
        {"layers", names_of(report.layers)},
        {"samples_min", report.samples_min},
        {"capacity", report.capacity},
        {"detection_ratio", report.detection_ratio},
        {"pieces", report.pieces},
        {"loose_pieces", report.loose_pieces},
        {"rounds", report.rounds},
        {"moved_vertices", report.moved_vertices},
        {"guarded_vertices", report.guarded_vertices},
        {"max_displacement", report.max_displacement},
        {"mrms", report.mrms},
        {"mrms_relative", report.mrms_relative},
        {"diagonal", report.diagonal},
        {"change", change(report)},
        {"seconds", report.seconds},
    };
    if (report.plane_bend)
        json["plane_bend"] = *report.plane_bend;
    if (report.solver) {
        json["solver"] = {{"mean_iterations", report.solver->mean_iterations},
                          {"max_iterations", report.solver->max_iterations},
                          {"not_converged", report.solver->not_converged}};
    }
    if (report.moves)
        json["moves"] = {{"one", report.moves->moves[0]},
                         {"two", report.moves->moves[1]},
                         {"three", report.moves->moves[2]},
                         {"more", report.moves->moves[3]},
                         {"unconverged", report.moves->unconverged}};
    for (const vcg_ext::Rehearsal& one : rehearsals)
        json["rehearsal"][QString(name(one.attack.attack)).toLower().toStdString()] = one.p_value;
    if (!rehearsals.empty())
        json["survival"] = summary(rehearsals);
    json["version"] = VCG_EXT_VERSION;
    json["warnings"] = report.warnings;
    json["recipe"] = report.recipe;
    return json;
}

Json to_json(const vcg_ext::DetectReport& report)
{
    Json json = {
        {"method", name(report.method)}, {"statistic", name(report.statistic)},
        {"carriers", report.carriers},   {"bits", vcg_ext::bit_string(report.bits)},
        {"message", report.message},     {"trim", report.trim},
        {"soft", report.soft},           {"samples", report.samples},
        {"pieces", report.pieces},       {"loose_pieces", report.loose_pieces},
    };
    const auto add = [&json](const char* field, const auto& value) {
        if (value)
            json[field] = *value;
    };
    add("detection_ratio", report.detection_ratio);
    add("p_value", report.p_value);
    add("p_binomial", report.p_binomial);
    add("present", report.present);
    json["p_message"] = report.p_message;
    json["verified"] = report.verified;
    add("presence", report.presence);
    add("candidate", report.candidate);
    add("runner_up_p", report.runner_up_p);
    add("smoothing_rounds", report.smoothing_rounds);
    if (!report.orientation.empty())
        json["orientation"] = report.orientation;
    if (report.registration)
        json["registration"] = to_json(*report.registration);
    for (const vcg_ext::PartReport& part : report.parts)
        json["parts"].push_back(to_json(part));
    json["layers"] = Json::array();
    for (const vcg_ext::LayerReport& layer : report.layers)
        json["layers"].push_back(to_json(layer));
    json["seconds"] = report.seconds;
    json["version"] = VCG_EXT_VERSION;
    json["warnings"] = report.warnings;
    json["finding"] = int(report.finding);
    json["verdict"] = report.verdict;
    return json;
}

Json to_json(const vcg_ext::AttackReport& report)
{
    return {{"attack", name(report.attack)}, {"amount", report.amount},     {"iterations", report.iterations},
            {"seed", report.seed},           {"vertices", report.vertices}, {"faces", report.faces},
            {"version", VCG_EXT_VERSION}};
}

Json to_json(const vcg_ext::DistortionReport& report)
{
    Json json = {{"mrms", report.mrms},           {"mrms_relative", report.mrms_relative},
                 {"hausdorff", report.hausdorff}, {"hausdorff_relative", report.hausdorff_relative},
                 {"mean", report.mean},           {"mean_relative", report.mean_relative}};
    if (report.snr_db)
        json["snr_db"] = *report.snr_db;
    if (report.msdm)
        json["msdm"] = *report.msdm;
    if (report.volume_change)
        json["volume_change"] = *report.volume_change;
    json["area_change"] = report.area_change;
    json["samples"] = report.samples;
    json["version"] = VCG_EXT_VERSION;
    json["warnings"] = report.warnings;
    return json;
}

namespace {

bool is_vector(const Json& value)
{
    return value.is_array() && !value.empty() &&
           std::all_of(value.begin(), value.end(), [](const Json& element) { return element.is_number(); });
}

QString to_line(const Json& value)
{
    if (value.is_string())
        return QString::fromStdString(value);
    if (value.is_number_float())
        return QString::number(value.get<double>(), 'g', 6);
    if (is_vector(value)) {
        const auto numbers = value.get<std::vector<double>>();
        const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
        return QString("%1 values, %2 to %3").arg(numbers.size()).arg(*least, 0, 'g', 4).arg(*most, 0, 'g', 4);
    }
    return QString::fromStdString(value.dump());
}

/// "Waves: p_message 1e-19, presence 1e-90", or the name alone.
QString layer_line(const Json& layer)
{
    if (layer.is_string())
        return to_line(layer);
    QStringList parts;
    for (const auto& [name, value] : layer.items())
        if (name != "method")
            parts += QString("%1 %2").arg(name.c_str(), to_line(value));
    return to_line(layer["method"]) + ": " + parts.join(", ");
}

} // namespace

std::map<std::string, HostValue> to_values(const Json& results)
{
    std::map<std::string, HostValue> values;
    const auto add = [&values](const std::string& name, const Json& value) {
        if (value.is_boolean())
            values[name] = value.get<bool>();
        else if (value.is_number_integer())
            values[name] = value.get<int>();
        else if (value.is_number())
            values[name] = value.get<double>();
        else if (is_vector(value))
            values[name] = value.get<std::vector<double>>();
    };
    for (const auto& [name, value] : results.items()) {
        if (value.is_object()) {
            for (const auto& [part, number] : value.items())
                add(std::string(name).append("_").append(part), number);
        } else if (name == "warnings") {
            values[name] = int(value.size());
        } else if (name == "finding") {
            values["verdict"] = value.get<int>();
        } else if (name == "bits") {
            std::vector<double> bits;
            for (const char digit : value.get_ref<const std::string&>())
                bits.push_back(digit - '0');
            values[name] = bits;
        } else {
            add(name, value);
        }
    }
    return values;
}

QStringList to_lines(const Json& results)
{
    QStringList lines;
    for (const auto& [name, value] : results.items()) {
        if (name == "warnings" || name == "finding")
            continue; // these are told otherwise
        if (value.is_object()) {
            for (const auto& [part, number] : value.items())
                lines += QString("%1 %2: %3").arg(name.c_str(), part.c_str(), to_line(number));
        } else if (name == "layers") {
            for (const Json& layer : value)
                lines += "layer " + layer_line(layer);
        } else if (name == "parts") {
            for (const Json& part : value)
                lines +=
                    QString("part of %1 vertices: %2").arg(part["vertices"].get<int>()).arg(to_line(part["verdict"]));
        } else {
            lines += QString("%1: %2").arg(name.c_str(), to_line(value));
        }
    }
    return lines;
}

namespace {

/// The parameter other than this one that names this file; empty where none does.
QString also_named_by(const RichParameterList& values, const QString& parameter, const QFileInfo& target)
{
    const auto plain = [](const QFileInfo& file) { return QDir::cleanPath(file.absoluteFilePath()); };
    const auto is_target = [&](const QString& path) {
        return !path.isEmpty() && plain(QFileInfo(path)) == plain(target);
    };
    for (const char* other : {"Report", "Certificate"})
        if (other != parameter && values.hasParameter(other) && is_target(values.getSaveFileName(other)))
            return other;
    for (const char* other : {"Key", "Expected"})
        if (values.hasParameter(other) && values.getString(other).startsWith("file:") &&
            is_target(values.getString(other).mid(5)))
            return other;
    return {};
}

} // namespace

OutputFile::OutputFile(const RichParameterList& values, const QString& parameter)
    : parameter_(parameter), file_(values.getSaveFileName(parameter))
{
    if (file_.fileName().isEmpty())
        return;
    const QFileInfo target(file_.fileName());
    if (target.exists() && !target.isFile())
        fail("it is no file"); // renaming would put a file in a device's place
    if (const QString other = also_named_by(values, parameter, target); !other.isEmpty())
        fail(other + " names the same file");
    if (!file_.open(QIODevice::WriteOnly))
        fail(file_.errorString());
}

void OutputFile::write(const std::string& bytes)
{
    if (!wanted())
        return;
    file_.write(bytes.data(), qint64(bytes.size()));
    if (!file_.flush() || !file_.commit()) // commit() alone overlooks a disk that fills up in between
        fail(file_.errorString());
}

void OutputFile::fail(const QString& reason) const
{
    throw vcg_ext::Error(
        QString("The %1 cannot be written to '%2': %3. Name a file in a folder that exists and that you "
                "may write to, or leave %4 empty. The mesh is unchanged.")
            .arg(parameter_.toLower(), file_.fileName(), reason, parameter_)
            .toStdString());
}
