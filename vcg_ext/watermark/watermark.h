// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// What a host calls: embed(), detect(), detect_with_original(), make_certificate(), detect_with_certificate(),
/// rehearse(), their options and reports.
#include "certified.h"
#include "detect.h"
#include "embed.h"
#include "original.h"
#include "rehearse.h"
