#!/bin/bash
# The unit tests and some fuzzing under sanitizers, built in a folder of their own.
# Usage: sanitize.sh address,undefined|thread [PROGRAM ARGUMENTS...]     another program of tests/ in their place
set -euo pipefail
cd "$(dirname "$0")/.."
sanitizers=$1
shift
build=build/sanitized-${sanitizers%%,*}
programs=(unit_tests fuzz)
[ $# = 0 ] || programs=("$1")
# Little optimization: it compiles in half the time, and the tests take little longer.
cmake -B "$build" -DSANITIZE="$sanitizers" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target "${programs[@]}"
if [ $# -gt 0 ]; then
    exec "$build/tests/$@"
fi
"$build/tests/unit_tests" --gtest_brief=1
"$build/tests/fuzz" --cases 2000
