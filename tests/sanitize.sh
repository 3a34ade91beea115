#!/bin/bash
# The unit tests and a minute of fuzzing under sanitizers, in a build folder of their own.
# Usage: sanitize.sh address,undefined|thread [TESTS]     TESTS: a filter of GoogleTest's; all where none is named
set -euo pipefail
cd "$(dirname "$0")/.."
sanitizers=$1
build=build/sanitized-${sanitizers%%,*}
cmake -B "$build" -DSANITIZE="$sanitizers"
cmake --build "$build" --parallel "$(nproc)" --target unit_tests fuzz
"$build/tests/unit_tests" --gtest_filter="${2-*}" --gtest_brief=1
"$build/tests/fuzz" --cases 2000
