# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints whether marks are still read where tools and formats did little things to single triangles.

All of it must be present.

Cells are log10 of p, in italics where the mark is lost.
"""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pymeshlab

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from doors import DETECT, EMBED, MESHES, METHODS, PyMeshLab, Refused

MESH_NAMES = ["bunny00", "armadillo", "refined_elephant", "fandisk", "homer", "bear", "lion-head", "mannequin-devil"]
LOOSE = 30

Mesh = tuple[np.ndarray, np.ndarray]


def layer(mesh: Mesh) -> pymeshlab.MeshSet:
    """A document with this mesh."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(*mesh))
    return meshes


def arrays(meshes: pymeshlab.MeshSet) -> Mesh:
    """Vertices and faces of the current layer."""
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix().copy(), mesh.face_matrix().copy()


def missing(mesh: Mesh) -> Mesh:
    """One triangle less."""
    return mesh[0], np.delete(mesh[1], len(mesh[1]) // 3, axis=0)


def turned(mesh: Mesh) -> Mesh:
    """One triangle turned round."""
    faces = mesh[1].copy()
    faces[len(faces) // 3] = faces[len(faces) // 3][::-1]
    return mesh[0], faces


def doubled(mesh: Mesh) -> Mesh:
    """One triangle twice."""
    return mesh[0], np.vstack([mesh[1], mesh[1][len(mesh[1]) // 3]])


def seam(gap: float) -> Callable[[Mesh], Mesh]:
    """The faces on one side of a plane moved off by `gap` of the diagonal."""

    def apply(mesh: Mesh) -> Mesh:
        points, faces = mesh
        step = gap * np.linalg.norm(np.ptp(points, axis=0)) * np.array([0.6, 0, 0.8])
        far = points[faces].mean(axis=1)[:, 0] > np.median(points[:, 0])
        return np.vstack([points, points + step]), np.vstack([faces[~far], faces[far] + len(points)])

    return apply


def with_loose(mesh: Mesh) -> Mesh:
    """Thirty small triangles about it."""
    points, faces = mesh
    draw = np.random.default_rng(1)
    size = np.linalg.norm(np.ptp(points, axis=0))
    middles = points.mean(axis=0) + size * draw.uniform(-0.7, 0.7, (LOOSE, 1, 3))
    corners = middles + 0.01 * size * draw.standard_normal((LOOSE, 3, 3))
    return np.vstack([points, corners.reshape(-1, 3)]), np.vstack(
        [faces, len(points) + np.arange(3 * LOOSE).reshape(-1, 3)]
    )


def without_loose(mesh: Mesh) -> Mesh:
    """The same taken away."""
    return mesh[0][: -3 * LOOSE], mesh[1][:-LOOSE]


def with_holes(mesh: Mesh) -> Mesh:
    """Without the faces around three places."""
    points, faces = mesh
    size = np.linalg.norm(np.ptp(points, axis=0))
    middles = points[faces].mean(axis=1)
    kept = np.ones(len(faces), bool)
    for place in np.random.default_rng(2).integers(len(faces), size=3):
        kept &= np.linalg.norm(middles - middles[place], axis=1) > 0.03 * size
    meshes = layer((points, faces[kept]))
    meshes.meshing_remove_unreferenced_vertices()
    return arrays(meshes)


def filled(mesh: Mesh) -> Mesh:
    """All holes closed by MeshLab."""
    meshes = layer(mesh)
    meshes.meshing_repair_non_manifold_edges()
    meshes.meshing_close_holes(maxholesize=1000, newfaceselected=False)
    return arrays(meshes)


def as_it_is(mesh: Mesh) -> Mesh:
    """Unchanged."""
    return mesh


# What is marked, and what is then done to it.
CASES: dict[str, tuple[Callable[[Mesh], Mesh], list[tuple[str, Callable[[Mesh], Mesh]]]]] = {
    "whole": (
        as_it_is,
        [
            ("plain", as_it_is),
            ("missing", missing),
            ("turned", turned),
            ("doubled", doubled),
            ("seam 1e-7", seam(1e-7)),
            ("seam 1e-5", seam(1e-5)),
            ("loose added", with_loose),
        ],
    ),
    "loose": (with_loose, [("loose removed", without_loose)]),
    "holes": (with_holes, [("with holes", as_it_is), ("holes filled", filled)]),
}


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--method", action="append", choices=METHODS)
    parser.add_argument("--mesh", action="append")
    options = parser.parse_args()
    door = PyMeshLab()
    names = [name for _, changes in CASES.values() for name, _ in changes]
    print("| mesh | method |", " | ".join(names), "|")
    print("|" + "---|" * (len(names) + 2))
    for mesh_name in options.mesh or MESH_NAMES:
        loaded = pymeshlab.MeshSet()
        loaded.load_new_mesh(str(MESHES / f"{mesh_name}.off"))
        for method in options.method or METHODS:
            cells = []
            for prepare, changes in CASES.values():
                meshes = layer(prepare(arrays(loaded)))
                values = {"Method": method, "Key": "frames", "Bits": 64}
                try:
                    door.apply(meshes, EMBED, Message="id:4711", **values)
                except Refused:
                    cells += ["refused"] * len(changes)
                    continue
                for _, change in changes:
                    try:
                        found = door.apply(layer(change(arrays(meshes))), DETECT, Expected="id:4711", **values)
                        p = f"{math.log10(float(str(found['p_value']))):.0f}"
                        cells.append(p if found["present"] else f"*{p}*")
                    except Refused:
                        cells.append("*refused*")
            print(f"| {mesh_name} | {method} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
