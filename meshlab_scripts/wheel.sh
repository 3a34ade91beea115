#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the wheel of meshmark with the plugin as built, into build/wheel, and tries it in a fresh venv that has nothing
# but the wheel and what that depends on. Usage: wheel.sh [--no-try]
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$PWD/build/wheel
rm -rf "$folder"
mkdir -p "$folder"
build/venv/bin/pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir "$folder" ./meshlab_scripts
wheel=$(echo "$folder"/meshmark-*.whl)
echo "$wheel"
[ "${1-}" != --no-try ] || exit 0

/usr/bin/python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check "$wheel"
cp build/data/meshes/fandisk.off "$folder"
cd "$folder" # where no checkout is in sight
export WATERMARK_KEY='correct horse battery staple'
venv/bin/meshmark --version
venv/bin/meshmark embed fandisk.off marked.off --message id:17 --method Waves
venv/bin/meshmark detect marked.off --expected id:17 --method Waves
