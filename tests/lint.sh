#!/bin/bash
# Style of C++, Python and shell, by tools alone. Usage: lint.sh BUILD_FOLDER (of CMake, with compile_commands.json)
set -euo pipefail
build=$(realpath "$1")
cd "$(dirname "$0")/.."
git ls-files -co --exclude-standard '*.h' '*.cpp' | xargs clang-format --dry-run -Werror
"$build/venv/bin/ruff" check --no-cache meshlab_scripts tests
"$build/venv/bin/ruff" format --check --no-cache meshlab_scripts tests
git ls-files -co --exclude-standard '*.sh' .ci/run | while read -r script; do bash -n "$script"; done
run-clang-tidy -quiet -p "$build" "$PWD/(vcg_ext|filter_watermark)/.*\.cpp" 2>&1 | grep -E "warning:|error:" && exit 1
exit 0
