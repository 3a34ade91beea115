#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Style of C++, Python and shell, by tools alone. Usage: lint.sh [tidy [FOLDER...]]
# `tidy` adds clang-tidy over all our files, some minutes at first; needs build/compile_commands.json.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-files -co --exclude-standard '*.h' '*.cpp' | xargs clang-format --dry-run -Werror
build/venv/bin/ruff check --no-cache meshlab_scripts tests
build/venv/bin/ruff format --check --no-cache meshlab_scripts tests
git ls-files -co --exclude-standard '*.sh' .ci/run | while read -r script; do bash -n "$script"; done
build/venv/bin/mypy --config-file .mypy.ini -p meshmark -p evaluation
build/venv/bin/python -m pytest -q -p no:cacheprovider tests/lint

[ "${1-}" = tidy ] || exit 0
shift
build/venv/bin/python tests/lint/tidy.py "$@"
