#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a clean clone to a watermarked mesh: set-up, build, embed and detect through meshlabserver, the same in Python.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
meshlab_scripts/setup.sh
export CMAKE_GENERATOR=${CMAKE_GENERATOR:-Ninja} CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache}
cmake -B build >build/configure.log || { cat build/configure.log; exit 1; }
cmake --build build --parallel "$(nproc)" --target filter_watermark-2020.09 filter_watermark-2025.07

mkdir -p build/quickstart
cd build/quickstart
export WATERMARK_KEY=${WATERMARK_KEY:-correct horse battery staple}
meshlabserver() {
    xvfb-run -a "$root/build/stage/bin/meshlabserver" "$@" >meshlabserver.log 2>&1 || { cat meshlabserver.log; exit 1; }
}

echo
echo "== meshlabserver: embed '(c) Jane' into bunny00"
meshlabserver -i "$root/build/data/meshes/bunny00.off" -s "$root/meshlab_scripts/embed.mlx" -o "$PWD/marked.ply"
sed -nE 's/^LOG: 2 (mrms_relative): (.*)/MRMS over the diagonal: \2/p' meshlabserver.log

echo "== meshlabserver: detect from the file, with the key alone"
meshlabserver -i "$PWD/marked.ply" -s "$root/meshlab_scripts/detect.mlx"
sed -nE 's/^LOG: 2 ((message|p_value|verdict): )/\1/p' meshlabserver.log

echo
echo "== pymeshlab: the same in Python (meshlab_scripts/quickstart.py)"
"$root/build/venv/bin/python" "$root/meshlab_scripts/quickstart.py"

echo
echo "The files are in $PWD. To try it in MeshLab's window:"
echo "  $root/build/stage/bin/meshlab $PWD/marked.ply     (Ctrl+F, type: Watermark)"
