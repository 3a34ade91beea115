// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// What a host calls: embed(), detect(), detect_with_original(), rehearse(), their options and reports.
#include "detect.h"
#include "embed.h"
#include "original.h"
#include "rehearse.h"
