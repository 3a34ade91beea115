# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces whose texture is stretched or shrunk by more than 1.25: coordinates left alone, and as Embed leaves them."""

import sys
from pathlib import Path

import numpy as np
import pymeshlab
import typer

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "meshlab_scripts"))
from texture_picture import atlas  # noqa: E402

METHODS = ["L-M", "QSP", "Cho", "Geodesic", "Spectral", "Layered"]


def metric(points: np.ndarray, faces: np.ndarray, texture: np.ndarray) -> np.ndarray:
    """Per face what lengths in the texture are on the surface: |dx|^2 = du E du; NaN where one of them is flat."""
    corners = points[faces]
    edges = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=1)
    shown = np.stack([texture[:, 1] - texture[:, 0], texture[:, 2] - texture[:, 0]], axis=1)
    result = np.full((len(faces), 2, 2), np.nan)
    proper = np.abs(np.linalg.det(shown)) > 1e-14
    inverse = np.linalg.inv(shown[proper])
    result[proper] = inverse @ (edges @ edges.transpose(0, 2, 1))[proper] @ inverse.transpose(0, 2, 1)
    return result


def stretched(before: np.ndarray, after: np.ndarray) -> float:
    """Percent of the faces where the greatest factor of a length is above 1.25."""
    squares = np.abs(np.linalg.eigvals(np.linalg.solve(before, after)).real)
    largest = np.sqrt(np.maximum(squares.max(axis=1), 1 / np.maximum(squares.min(axis=1), 1e-18)))
    return 100 * float(np.nanmean(largest > 1.25))


def main(meshes: list[str] | None = None, plugin: Path = ROOT / "build/meshlab-2025.07/libfilter_watermark.so") -> None:
    """Prints a row a mesh and method."""
    pymeshlab.load_plugin(str(plugin))
    print("mesh | method | left alone | as marked")
    for name in meshes or ["bunny00.off", "armadillo.off", "homer.off"]:
        plain = pymeshlab.MeshSet()
        plain.load_new_mesh(str(ROOT / "build/data/meshes" / name))
        points, faces = plain.current_mesh().vertex_matrix(), plain.current_mesh().face_matrix()
        texture = atlas(points, faces)
        before = metric(points, faces, texture)
        for method in METHODS:
            copy = pymeshlab.MeshSet()
            copy.add_mesh(pymeshlab.Mesh(points, faces, w_tex_coords_matrix=texture.reshape(-1, 2)))
            copy.apply_filter("apply_coord_watermark", message="(c) Jane", method=method, key="picture", bits=64)
            moved = copy.current_mesh().vertex_matrix()
            carried = copy.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
            alone = stretched(before, metric(moved, faces, texture))
            print(
                f"{name} | {method} | {alone:.1f} | {stretched(before, metric(moved, faces, carried)):.1f}", flush=True
            )


if __name__ == "__main__":
    typer.run(main)
