// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg_ext/carrier/statistic.h>

#include "shared_parameters.h"

#include <QFile>

#include <vcg_ext/method/methods.h>

using vcg_ext::Method;
using vcg_ext::Statistic;

namespace {

std::vector<Method> methods()
{
    std::vector<Method> list;
    for (const vcg_ext::MethodRow& row : vcg_ext::all_methods())
        list.push_back(row.method);
    return list;
}

const std::vector<Statistic> statistics = {Statistic::Mean, Statistic::Variance};

} // namespace

int read_place(const RichParameterList& values, const QString& name, int count)
{
    const int place = values.getEnum(name);
    if (place < 0 || place >= count)
        throw vcg_ext::Error(
            QString("%1 %2 does not exist; choose 0 to %3.").arg(name).arg(place).arg(count - 1).toStdString());
    return place;
}

std::uint64_t read_seed(const RichParameterList& values)
{
    const int seed = values.getInt("Seed");
    if (seed < 0)
        throw vcg_ext::Error(QString("Seed is %1; give 0 or more.").arg(seed).toStdString());
    return std::uint64_t(seed);
}

QString about_carrier_parameters()
{
    QStringList hints;
    QStringList with_statistic;
    for (const vcg_ext::MethodRow& row : vcg_ext::all_methods()) {
        hints += QString("<i>%1</i> (%2)").arg(row.name, row.hint);
        if (row.has_statistic)
            with_statistic += row.name;
    }
    return "<b>Method</b>: " + hints.join(", ") + ". <b>Statistic</b> matters to " + with_statistic.join(", ") +
           ". <b>Trim</b> is cut off the range of values at both ends. <b>Secret key</b>: <i>file:PATH</i> takes a "
           "file's bytes, less a line end at its end; <i>env:NAME</i> an environment variable.<br>";
}

void add_carrier_parameters(RichParameterList& list, const QString& bits_tip)
{
    list.addParam(RichEnum("Method", 0, choice_names(methods()), "Method",
                           "What carries the bits. Detection needs the same one; Layered survives the most."));
    list.addParam(RichEnum("Statistic", 0, choice_names(statistics), "Statistic",
                           "Mean is more robust, Variance less visible. Detection needs the same one."));
    list.addParam(RichString("Key", "", "Secret key",
                             "A passphrase; or file:PATH or env:NAME, which stay out of scripts and histories."));
    list.addParam(RichInt("Bits", 0, "Bits", bits_tip));
    list.addParam(RichFloat("Trim", -1, "Trim",
                            "-1 (usual) draws it from the key; or a part of the range, 0 to 0.45, as in embedding."));
}

vcg_ext::CarrierOptions read_carrier_options(const RichParameterList& values)
{
    vcg_ext::CarrierOptions options;
    options.method = read_choice(values, "Method", methods());
    options.statistic = read_choice(values, "Statistic", statistics);
    options.bits = values.getInt("Bits");
    options.trim = read_number(values, "Trim");
    return options;
}

std::string composed(const QString& text)
{
    return text.normalized(QString::NormalizationForm_C).toStdString();
}

std::string read_text(const RichParameterList& values, const QString& name)
{
    return composed(values.getString(name));
}

vcg_ext::Key read_key(const RichParameterList& values)
{
    struct Text {
        QByteArray bytes;
        ~Text() { bytes.fill('\0'); }
    } text{values.getString("Key").normalized(QString::NormalizationForm_C).toUtf8()};
    return vcg_ext::key_from_text({text.bytes.constData(), std::size_t(text.bytes.size())});
}

void add_expected_parameter(RichParameterList& list)
{
    list.addParam(
        RichString("Expected", "", "Expected message",
                   "The message to look for, or file:PATH with one on each line; empty to read what is there."));
}

std::vector<vcg_ext::Message> read_expected(const RichParameterList& values)
{
    const std::string text = read_text(values, "Expected");
    if (text.empty())
        return {};
    if (text.compare(0, 5, "file:") != 0)
        return {vcg_ext::read_message(text)};
    QFile file(values.getString("Expected").mid(5));
    if (!file.open(QIODevice::ReadOnly))
        throw vcg_ext::Error("The file of expected messages cannot be read: '" + file.fileName().toStdString() +
                             "'. Name one that exists, with a message on each line.");
    return vcg_ext::read_candidates(composed(QString::fromUtf8(file.readAll())));
}

void add_report_parameter(RichParameterList& list)
{
    list.addParam(RichFileSave("Report", "", "*.json", "Report",
                               "JSON file for the results, or empty. MeshLab 2020.09 takes it by the button only."));
}

double read_number(const RichParameterList& values, const QString& name)
{
    return QString::number(double(values.getFloat(name)), 'g', 6).toDouble();
}
