# SPDX-License-Identifier: GPL-3.0-or-later
"""What MeshLab reads: its readers give the triangles; the positions are written by the formats that we know."""

from pathlib import Path

import numpy as np

from .. import host
from ..errors import FormatError
from .body import Body, Faces, Points, Skin


def geometry(path: Path) -> tuple[Points, Faces]:
    """All layers of a file together, each where its matrix puts it."""
    with host.own_meshes() as meshes:
        host.read(meshes, path)
        points, faces, count = [], [], 0
        for mesh in meshes:
            points.append(mesh.transformed_vertex_matrix().copy())
            faces.append(mesh.face_matrix().copy() + count)
            count += len(points[-1])
    return np.concatenate(points), np.concatenate(faces).astype(np.int32)


def read(path: Path) -> Body:
    """A file to be read only."""

    def write(out: Path, moved: Points, skin: Skin) -> None:
        raise FormatError(
            f"'{out.name}': this format can be read, but not written with all that is in it. "
            "Save the model as STL, PLY, OBJ, OFF, GLB or 3MF first."
        )

    return Body(*geometry(path), "mm", write)
