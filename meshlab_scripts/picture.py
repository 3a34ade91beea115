# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the README's picture: a mesh, the same watermarked, and where and how far its vertices moved."""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from matplotlib.collections import PolyCollection

ROOT = Path(__file__).resolve().parents[1]


def rotation(yaw: float, pitch: float) -> np.ndarray:
    """The view: turns about the vertical axis, then about the horizontal one; angles in degrees."""
    a, b = np.radians([yaw, pitch])
    about_y = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    return about_x @ about_y


def draw(axes: plt.Axes, points: np.ndarray, faces: np.ndarray, colors: np.ndarray) -> None:
    """Faces that look at us, from back to front, shaded by a lamp at the viewer's left."""
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    light = np.array([-0.4, 0.5, 0.77])
    shade = 0.35 + 0.65 * np.clip(normals @ light, 0, 1)
    front = normals[:, 2] > 0
    order = np.argsort(corners[front, :, 2].mean(axis=1))
    shaded = np.clip(colors[front] * shade[front, None], 0, 1)[order]
    triangles = corners[front][order, :, :2]
    axes.add_collection(PolyCollection(triangles, facecolors=shaded, edgecolors=shaded, linewidths=0.2))
    axes.set_xlim(points[:, 0].min(), points[:, 0].max())
    axes.set_ylim(points[:, 1].min(), points[:, 1].max())
    axes.set_aspect("equal")
    axes.axis("off")


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
