#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Everything, from a clean clone: set-up, build, all tests. What is there already is not fetched or built again.
# Usage: tests/run.sh [arguments of ctest, such as -L unit]
set -euo pipefail
cd "$(dirname "$0")/.."
meshlab_scripts/setup.sh
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
cmake -B build -DWITH_HOSTS=ON
cmake --build build --parallel "$(nproc)" --target all filter_watermark-2025.07-float
ctest --test-dir build --output-on-failure --parallel "$(nproc)" "$@"
