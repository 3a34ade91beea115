#include "shared_parameters.h"

using vcg_ext::Method;
using vcg_ext::Statistic;

namespace {

constexpr Method methods[] = {Method::LM, Method::QSP, Method::Cho, Method::Geodesic, Method::Spectral};
constexpr Statistic statistics[] = {Statistic::Mean, Statistic::Variance};

template <class Choices>
QStringList names(const Choices& choices)
{
    QStringList list;
    for (const auto& choice : choices)
        list += name(choice);
    return list;
}

template <class Choice, std::size_t count>
Choice choose(const Choice (&choices)[count], const RichParameterList& values, const QString& parameter)
{
    const int index = values.getEnum(parameter);
    if (index < 0 || index >= int(count))
        throw vcg_ext::Error(
            QString("%1 %2 does not exist; choose 0 to %3.").arg(parameter).arg(index).arg(count - 1).toStdString());
    return choices[index];
}

} // namespace

void add_carrier_parameters(RichParameterList& list, const QString& bits_tip)
{
    list.addParam(
        RichEnum("Method", 0, names(methods), "Method",
                 "L-M: vertex norms, the least visible; QSP and Cho: vertex norms, faster and more visible; Geodesic: "
                 "distances along the surface; Spectral: survives smoothing. Detection needs the same one."));
    list.addParam(
        RichEnum("Statistic", 0, names(statistics), "Statistic",
                 "What a carrier's values tell: their mean, or their variance (less visible, less robust). Detection "
                 "needs the same one. Spectral ignores it."));
    list.addParam(
        RichString("Key", "", "Secret key",
                   "A passphrase, or <i>file:PATH</i> for a file's bytes, or <i>env:NAME</i> for an environment "
                   "variable. The last two keep it out of scripts, histories and project files."));
    list.addParam(RichInt("Bits", 64, "Bits", bits_tip));
    list.addParam(RichFloat(
        "Trim", -1, "Trim",
        "Part of the values' range that is cut off at both ends, 0 to 0.45; -1 draws it from the key. Detection "
        "needs the same."));
}

void read_carrier_parameters(const RichParameterList& values, vcg_ext::CarrierOptions& options)
{
    options.method = choose(methods, values, "Method");
    options.statistic = choose(statistics, values, "Statistic");
    options.bits = values.getInt("Bits");
    options.trim = read_number(values, "Trim");
}

vcg_ext::Key read_key(const RichParameterList& values)
{
    return vcg_ext::key_from_text(values.getString("Key").toStdString());
}

void add_report_parameter(RichParameterList& list)
{
    list.addParam(
        RichFileSave("Report", "", "*.json", "Report", "Where to write the results as JSON; empty for nowhere."));
}

double read_number(const RichParameterList& values, const QString& name)
{
    return QString::number(double(values.getFloat(name)), 'g', 6).toDouble();
}
