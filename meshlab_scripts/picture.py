# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the README's picture: a mesh, the same watermarked, and where and how far its vertices moved."""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from meshmark.evidence.drawing import draw, rotation

ROOT = Path(__file__).resolve().parents[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", type=Path, default=ROOT / "build/data/meshes/bunny00.off")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument("--yaw", type=float, default=0)
    parser.add_argument("--pitch", type=float, default=0)
    parser.add_argument("output", type=Path)
    options = parser.parse_args()

    pymeshlab.load_plugin(str(options.plugin))
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(options.mesh))
    original = meshes.current_mesh().vertex_matrix()
    faces = meshes.current_mesh().face_matrix()
    report = meshes.apply_filter(
        "apply_coord_watermark", message="(c) Jane", method="L-M", key="correct horse battery staple"
    )
    marked = meshes.current_mesh().vertex_matrix()
    moved = np.linalg.norm(marked - original, axis=1) / np.linalg.norm(np.ptp(original, axis=0))

    view = rotation(options.yaw, options.pitch).T
    grey = np.full((len(faces), 3), 0.82)
    most = np.quantile(moved, 0.99)
    scale = mpl.cm.ScalarMappable(mpl.colors.Normalize(0, most * 1e4), "viridis")
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.2), layout="constrained")
    draw(axes[0], original @ view, faces, grey)
    axes[0].set_title("original")
    draw(axes[1], marked @ view, faces, grey)
    axes[1].set_title(f"watermarked: 64 bits, MRMS {report['mrms_relative']:.1e} of the diagonal")
    draw(axes[2], marked @ view, faces, scale.to_rgba(moved[faces].mean(axis=1) * 1e4)[:, :3] * 1.25)
    axes[2].set_title("how far vertices moved")
    figure.colorbar(scale, ax=axes[2], label="1/10,000 of the diagonal", shrink=0.8)
    figure.savefig(options.output, dpi=80)


if __name__ == "__main__":
    main()
