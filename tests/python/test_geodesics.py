# SPDX-License-Identifier: GPL-3.0-or-later
"""Fast marching against a second implementation: exact geodesics on the polyhedron, by pygeodesic."""

import subprocess

import numpy as np
import pymeshlab
import pytest
from doors import BUILD, MESHES
from pygeodesic.geodesic import PyGeodesicAlgorithmExact

# Root mean square of the relative error where the distance is over a tenth of the farthest.
LIMITS = {"bunny00": 0.004, "fandisk": 0.006}


def marched(mesh: str, source: int) -> np.ndarray:
    program = BUILD / "tests" / "geodesic_distances"
    done = subprocess.run(
        [program, f"{mesh}.off", "vertex", str(source)], capture_output=True, text=True, check=True, timeout=60
    )
    return np.array(done.stdout.split(), float)


@pytest.mark.parametrize("mesh", LIMITS)
def test_distances_are_nearly_exact(mesh: str) -> None:
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(MESHES / f"{mesh}.off"))
    points, faces = meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()
    solver = PyGeodesicAlgorithmExact(points, faces)
    for part in (0.1, 0.5, 0.9):
        source = int(part * len(points))
        exact, _ = solver.geodesicDistances(np.array([source]), None)
        far = exact > 0.1 * exact.max()
        error = marched(mesh, source)[far] / exact[far] - 1
        assert np.sqrt(np.mean(error**2)) <= LIMITS[mesh]
