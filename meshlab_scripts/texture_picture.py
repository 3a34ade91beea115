# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a checkerboard on a mesh: before it is watermarked, after, and as it were had the texture slid along."""

import argparse
from pathlib import Path

import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from picture import ROOT, rotation

PIXELS = 700
SAMPLES = 14  # an edge of a face


def atlas(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Texture coordinates per corner: each face seen along the axis that it looks to, in a field of its own."""
    normals = np.cross(points[faces[:, 1]] - points[faces[:, 0]], points[faces[:, 2]] - points[faces[:, 0]])
    for _ in range(30):  # smooth, or charts are speckled
        sums = np.zeros_like(points)
        for corner in range(3):
            np.add.at(sums, faces[:, corner], normals)
        normals = sums[faces].sum(axis=1)
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    axis = np.abs(normals).argmax(axis=1)
    across = np.array([[1, 2], [2, 0], [0, 1]])[axis][:, None, :]
    local = (points - points.min(axis=0)) / np.ptp(points, axis=0).max()
    seen = np.take_along_axis(local[faces], np.broadcast_to(across, (len(faces), 3, 2)), axis=2)
    side = normals[np.arange(len(faces)), axis] > 0
    return seen * 0.32 + np.stack([axis / 3, side * 0.5], axis=1)[:, None, :]


def render(points: np.ndarray, faces: np.ndarray, texture: np.ndarray, squares: int) -> np.ndarray:
    """The faces that look at us with a checkerboard, by samples of each; what is nearest is painted last."""
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    front = normals[:, 2] > 0
    i, j = np.triu_indices(SAMPLES)
    weights = np.stack([i + 1 / 3, j - i + 1 / 3, SAMPLES - 1 - j + 1 / 3], axis=1) / SAMPLES
    places = np.einsum("sk,fkd->fsd", weights, corners[front]).reshape(-1, 3)
    shown = np.einsum("sk,fkd->fsd", weights, texture[front]).reshape(-1, 2)
    light = 0.4 + 0.6 * np.clip(normals[front] @ np.array([-0.4, 0.5, 0.77]), 0, 1)
    board = 0.35 + 0.65 * (np.floor(shown * squares).sum(axis=1) % 2)
    color = board * np.repeat(light, len(weights))
    low = points[:, :2].min(axis=0)
    scale = (PIXELS - 1) / np.ptp(points[:, :2], axis=0).max()
    pixel = ((places[:, :2] - low) * scale).astype(int)
    order = np.argsort(places[:, 2], kind="stable")
    image = np.ones((PIXELS, PIXELS))
    image[PIXELS - 1 - pixel[order, 1], pixel[order, 0]] = color[order]
    return image


def main() -> None:
    """Writes the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", type=Path, default=ROOT / "build/data/meshes/bunny00.off")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument("--method", default="L-M")
    parser.add_argument("--squares", type=int, default=120, help="over the whole texture")
    parser.add_argument("output", type=Path)
    options = parser.parse_args()

    pymeshlab.load_plugin(str(options.plugin))
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(options.mesh))
    points, faces = meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()
    texture = atlas(points, faces)
    meshes.add_mesh(pymeshlab.Mesh(points, faces, w_tex_coords_matrix=texture.reshape(-1, 2)))
    meshes.apply_filter("apply_coord_watermark", message="(c) Jane", method=options.method, key="picture", bits=64)
    marked = meshes.current_mesh().vertex_matrix()
    carried = meshes.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)

    view = rotation(0, 0).T
    figure, axes = plt.subplots(1, 3, figsize=(15, 5.4), layout="constrained")
    pictures = [
        ("original", points, texture),
        (f"watermarked by {options.method}", marked, carried),
        ("had texture coordinates been left alone", marked, texture),
    ]
    for place, (title, where, shown) in zip(axes, pictures, strict=True):
        place.imshow(render(where @ view, faces, shown, options.squares), cmap="gray", vmin=0, vmax=1)
        place.set_title(title)
        place.axis("off")
    figure.savefig(options.output, dpi=80)


if __name__ == "__main__":
    main()
