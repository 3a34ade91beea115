# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done to a model before it is printed: hollowed, and taken for another unit."""

import numpy as np
import pymeshlab
from meshmark import host

from .formats import round_trip
from .shape import Passage, Shape

CELLS = 128  # of the inner wall's grid, along the diagonal


def hollowed(shape: Shape, passage: Passage) -> Shape:
    """The model with an inner wall, this part of the diagonal below the surface.

    :raises ValueError: where the model is so thin that nothing is left inside
    """
    with host.own_meshes() as meshes:
        meshes.add_mesh(pymeshlab.Mesh(shape.points, shape.faces))
        host.apply(
            meshes,
            "generate_resampled_uniform_mesh",
            cellsize=pymeshlab.PureValue(shape.diagonal / CELLS),
            offset=pymeshlab.PureValue(-passage.amount * shape.diagonal),
            mergeclosevert=True,
        )
        inner = meshes.current_mesh()
        points, faces = inner.vertex_matrix().copy(), inner.face_matrix().copy()
    if not len(faces):
        raise ValueError(f"Nothing is left inside a wall of {passage.amount:g} of the diagonal.")
    return Shape(
        np.concatenate([shape.points, points]),
        np.concatenate([shape.faces, faces[:, ::-1] + len(shape.points)]).astype(np.int32),
    )


def in_units(shape: Shape, passage: Passage) -> Shape:
    """As a file in which a number means another length: 25.4 for inches taken for millimetres, .001 for metres."""
    return round_trip("STL")(shape.scaled(passage.amount), passage)
