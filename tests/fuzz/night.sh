#!/bin/bash
# Fuzzes the library under ASan and UBSan, in a build folder of its own. What it prints names the case.
# Usage: night.sh [SECONDS] [FIRST CASE]     ten minutes from a case that the date chooses, where none is named
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake -B build/sanitized -DCMAKE_BUILD_TYPE=Release -DSANITIZE=address,undefined >/dev/null
cmake --build build/sanitized --parallel "$(nproc)" --target fuzz >/dev/null
build/sanitized/tests/fuzz "${1:-600}" "${2:-$(date +%s)}"
