// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "host.h"

#include <vcg_ext/watermark/watermark.h>

/// The names of all choices, for a RichEnum.
template <class Choice>
QStringList choice_names(const std::vector<Choice>& choices)
{
    QStringList list;
    for (const Choice choice : choices)
        list += name(choice);
    return list;
}

/// The place that a RichEnum names. \throw vcg_ext::Error where it is none of `count`
int read_place(const RichParameterList& values, const QString& name, int count);

template <class Choice>
Choice read_choice(const RichParameterList& values, const QString& name, const std::vector<Choice>& choices)
{
    return choices[read_place(values, name, int(choices.size()))];
}

/// \throw vcg_ext::Error where it is negative
std::uint64_t read_seed(const RichParameterList& values);

/// For a filter's info: what does not fit into the tooltips of these parameters.
QString about_carrier_parameters();

/// What Embed and Detect have in common: Method, Statistic, Key, Bits, Trim.
void add_carrier_parameters(RichParameterList& list, const QString& bits_tip);
vcg_ext::CarrierOptions read_carrier_options(const RichParameterList& values);

/// The text as UTF-8 in Unicode's composed form (NFC): one letter can be spelled in several ways.
std::string composed(const QString& text);
std::string read_text(const RichParameterList& values, const QString& name);

/// \throw vcg_ext::Error where it is empty, or names no file or variable
vcg_ext::Key read_key(const RichParameterList& values);

void add_expected_parameter(RichParameterList& list);

/// The messages of a file, one a line, or the one that the text says; none where it is empty.
std::vector<vcg_ext::Message> read_expected(const RichParameterList& values);

void add_report_parameter(RichParameterList& list);

/// A number as the user typed it. MeshLab 2020.09 keeps it in float, 2025.07 in double; six digits are the same in
/// both, so that both draw the same carriers.
double read_number(const RichParameterList& values, const QString& name);
