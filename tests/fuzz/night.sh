#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fuzzes the library under ASan and UBSan. What it prints names the case.
# Usage: night.sh [SECONDS] [FIRST CASE]     ten minutes from a case that the date chooses, where none is named
exec "$(dirname "$0")/../sanitize.sh" address,undefined fuzz "${1:-600}" "${2:-$(date +%s)}"
