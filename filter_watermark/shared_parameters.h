#pragma once
#include "host.h"

#include <vcg_ext/watermark.h>

/// What Embed and Detect have in common: Method, Statistic, Key, Bits, Trim.
void add_carrier_parameters(RichParameterList& list, const QString& bits_tip);
void read_carrier_parameters(const RichParameterList& values, vcg_ext::CarrierOptions& options);

/// \throw vcg_ext::Error where it is empty, or names no file or variable
vcg_ext::Key read_key(const RichParameterList& values);

void add_report_parameter(RichParameterList& list);

/// A number as the user typed it. MeshLab 2020.09 keeps it in float, 2025.07 in double; six digits are the same in
/// both, so that both draw the same carriers.
double read_number(const RichParameterList& values, const QString& name);
