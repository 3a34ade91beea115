# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the thesis' Figures 4.1 and 4.8: distances from the key's point, their strips, and where vertices moved."""

import argparse
import subprocess
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from picture import ROOT, draw, rotation

KEY = "correct horse battery staple"
MARK = {"method": "Geodesic", "key": KEY, "trim": 0.1}


def scaled(values: np.ndarray, most: float, colors: str) -> mpl.cm.ScalarMappable:
    """A scale of colors from 0 to `most` that `values` can be looked up in."""
    scale = mpl.cm.ScalarMappable(mpl.colors.Normalize(0, most), colors)
    scale.set_array(values)
    return scale


def main() -> None:
    """Writes one picture of four panels."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", default="bunny00.off", help="one of the test meshes")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument("--distances", type=Path, default=ROOT / "build/tests/geodesic_distances")
    parser.add_argument("--yaw", type=float, default=0)
    parser.add_argument("--pitch", type=float, default=0)
    parser.add_argument("output", type=Path)
    options = parser.parse_args()

    pymeshlab.load_plugin(str(options.plugin))
    cover = ROOT / "build/data/meshes" / options.mesh
    program = subprocess.run(
        [options.distances, options.mesh, "key", KEY], capture_output=True, text=True, check=True, timeout=60
    )
    distances = np.array(program.stdout.split(), float)

    def opened() -> pymeshlab.MeshSet:
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(cover))
        return meshes

    meshes = opened()
    original, faces = meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()
    meshes.apply_filter("get_watermark", showcarriers=True, **MARK)
    strips = meshes.mesh(1).vertex_color_matrix()[:, :3]
    view = rotation(options.yaw, options.pitch).T

    figure, axes = plt.subplots(1, 4, figsize=(16, 4.2), layout="constrained")
    reached = np.where(np.isfinite(distances), distances, 0) / np.ptp(original, axis=0).max()
    scale = scaled(reached, reached.max(), "turbo")
    draw(axes[0], original @ view, faces, scale.to_rgba(reached[faces].mean(axis=1))[:, :3])
    axes[0].set_title("4.1 (a): distance from the key's point")
    figure.colorbar(scale, ax=axes[0], label="largest extent", shrink=0.8)
    draw(axes[1], original @ view, faces, strips[faces].mean(axis=1))
    axes[1].set_title("4.1 (b): strips, one bit each")
    for panel, statistic, name in ((axes[2], "Mean", "ProMean"), (axes[3], "Variance", "ProVar")):
        meshes = opened()
        report = meshes.apply_filter("apply_coord_watermark", message="(c) Jane", statistic=statistic, **MARK)
        marked = meshes.current_mesh().vertex_matrix()
        moved = 1e4 * np.linalg.norm(marked - original, axis=1) / np.linalg.norm(np.ptp(original, axis=0))
        scale = scaled(moved, float(np.quantile(moved, 0.99)), "viridis")
        draw(panel, marked @ view, faces, scale.to_rgba(moved[faces].mean(axis=1))[:, :3] * 1.25)
        panel.set_title(f"4.8: displacement, {name}, MRMS {report['mrms_relative']:.1e}")
        figure.colorbar(scale, ax=panel, label="1/10,000 of the diagonal", shrink=0.8)
    figure.savefig(options.output, dpi=80)


if __name__ == "__main__":
    main()
