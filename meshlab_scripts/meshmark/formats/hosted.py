# SPDX-License-Identifier: GPL-3.0-or-later
"""What MeshLab reads: the triangles of OBJ and PLY, and all of formats that we cannot write."""

from pathlib import Path

import numpy as np

from .. import host
from ..errors import FormatError
from .body import Body, Faces, Points, Skin, triangles


def geometry(path: Path) -> tuple[Points, Faces]:
    """All layers of a file together, each where its matrix puts it."""
    with host.own_meshes() as meshes:
        host.read(meshes, path)
        points, faces, count = [], [], 0
        for mesh in meshes:
            points.append(mesh.transformed_vertex_matrix().copy())
            faces.append(triangles(mesh.face_matrix(), len(points[-1])) + count)
            count += len(points[-1])
    return np.concatenate(points), np.concatenate(faces).astype(np.int32)


def triangles_over(own: Points, path: Path) -> Faces:
    """The file's triangles over the points that we read there ourselves.

    :raises FormatError: where MeshLab reads other points
    """
    points, faces = geometry(path)
    if len(points) != len(own) or not np.allclose(points, own, rtol=1e-6, atol=0):
        raise FormatError(f"'{path}' is written in a way that meshmark does not know. Save it anew, and try again.")
    return faces


def read(path: Path) -> Body:
    """A file to be read only."""

    def written(moved: Points, skin: Skin) -> bytes:
        raise FormatError(
            f"'{path.suffix}' can be read, but not written with all that is in it. "
            "Save the model as STL, PLY, OBJ, OFF, GLB or 3MF first."
        )

    return Body(*geometry(path), "mm", written)
