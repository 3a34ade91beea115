#!/bin/bash
# Style of C++, Python and shell, by tools alone. Usage: lint.sh [tidy]
# `tidy` adds clang-tidy (some minutes; needs build/compile_commands.json). The tests run it without.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$PWD/build
git ls-files -co --exclude-standard '*.h' '*.cpp' | xargs clang-format --dry-run -Werror
build/venv/bin/ruff check --no-cache meshlab_scripts tests
build/venv/bin/ruff format --check --no-cache meshlab_scripts tests
git ls-files -co --exclude-standard '*.sh' .ci/run | while read -r script; do bash -n "$script"; done
build/venv/bin/python -m pytest -q -p no:cacheprovider tests/lint

[ "${1-}" = tidy ] || exit 0
# The library, and the plugin once (for 2020.09), without GCC's precompiled header, which clang cannot read.
mkdir -p "$build/lint"
build/venv/bin/python - "$build" <<'PYTHON'
import json, re, sys
from pathlib import Path

build = Path(sys.argv[1])
commands = [
    {**entry, "command": re.sub(r" -Winvalid-pch -include \S+", "", entry["command"])}
    for entry in json.loads((build / "compile_commands.json").read_text())
    if "/vcg_ext.dir/" in entry["command"] or "/filter_watermark-2020.09.dir/" in entry["command"]
]
(build / "lint" / "compile_commands.json").write_text(json.dumps(commands))
PYTHON
run-clang-tidy -quiet -p "$build/lint" "$PWD/(vcg_ext|filter_watermark)/.*\.cpp$" >"$build/lint/log" 2>&1 || {
    grep -E -A3 "(warning|error):" "$build/lint/log" || cat "$build/lint/log"
    exit 1
}
