# SPDX-License-Identifier: GPL-3.0-or-later
"""Embedding through pymeshlab against MeshLab's own load of the same file, in the same run.

bunny00 subdivided by Loop's scheme (twice: 603,266 vertices), saved as a binary PLY; each is timed several times,
in turn, and the medians and their ratio are printed.
"""

import argparse
import statistics
import tempfile
import time
from pathlib import Path

import pymeshlab

ROOT = Path(__file__).resolve().parents[2]


def subdivided(mesh: Path, rounds: int, folder: Path) -> Path:
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    if rounds:
        meshes.meshing_surface_subdivision_loop(iterations=rounds, threshold=pymeshlab.PercentageValue(0))
    print(f"{mesh.stem}, {rounds} x Loop: {meshes.current_mesh().vertex_number()} vertices")
    path = folder / f"{mesh.stem}-{rounds}.ply"
    meshes.save_current_mesh(str(path))
    return path


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", type=Path, default=ROOT / "build/data/meshes/bunny00.off")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument("--subdivisions", type=int, default=2)
    parser.add_argument("--methods", nargs="+", default=["L-M", "QSP", "Cho"])
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    pymeshlab.load_plugin(str(arguments.plugin))

    with tempfile.TemporaryDirectory() as folder:
        path = subdivided(arguments.mesh, arguments.subdivisions, Path(folder))
        for method in arguments.methods:
            load, embed = [], []
            for _ in range(arguments.runs):
                meshes = pymeshlab.MeshSet()
                start = time.perf_counter()
                meshes.load_new_mesh(str(path))
                loaded = time.perf_counter()
                report = meshes.apply_filter("apply_coord_watermark", method=method, key="speed", message="museum")
                load.append(loaded - start)
                embed.append(time.perf_counter() - loaded)
            ratio = statistics.median(embed) / statistics.median(load)
            print(
                f"{method:9} load {statistics.median(load):.2f} s  embed {statistics.median(embed):.2f} s  "
                f"ratio {ratio:.2f}  rounds {report['rounds']}"
            )


if __name__ == "__main__":
    main()
