# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file says of the shape, and the same file with other positions and all else left as it is."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import FormatError

Points = NDArray[np.float64]  # a row a vertex
Faces = NDArray[np.int32]  # a row a triangle
Corners = NDArray[np.float64]  # of each triangle's three corners some numbers: faces x 3 x numbers
_PLACES, _TRIANGLES = 100_000, 50_000_000  # that a file may have


@dataclass(frozen=True)
class Skin:
    """What corners of triangles show. It stays where it is on the surface while vertices slide beneath it."""

    texture: Corners | None = None  # u and v
    colors: Corners | None = None  # red, green, blue and alpha, from 0 to 1
    picture: NDArray[np.int32] | None = None  # of each triangle; two pictures have nothing to do with each other


@dataclass(frozen=True)
class Body:
    """The shape of a file, in the coordinates of its scene."""

    points: Points
    faces: Faces
    unit: str  # of length.MILLIMETRES
    written: Callable[[Points, Skin], bytes]  # the same file with these positions, and this skin
    skin: Skin = field(default_factory=Skin)

    def welded(self) -> tuple[Points, Faces]:
        """The distinct points, and the triangles over these."""
        points, number = weld(self.points)
        return points, number[self.faces].astype(np.int32)


def triangles(corners: ArrayLike, count: int) -> Faces:
    """What triangles name, three numbers a row.

    :raises ValueError: where there are not as many
    """
    rows = np.asarray(corners, dtype=np.int64).reshape(-1, 3)
    if len(rows) and (rows.min() < 0 or rows.max() >= count):
        raise ValueError(f"a triangle names one that is not among the {count} that there are")
    return rows.astype(np.int32)


def check_places(places: int, shown: int = 0) -> None:
    """A small file can show one mesh in millions of places.

    :raises ValueError: where no memory would hold its triangles
    """
    if places > _PLACES or shown > _TRIANGLES:
        raise ValueError(f"it shows meshes in more than {_PLACES:,} places, or more than {_TRIANGLES:,} triangles")


def before_matrix(points: Points, linear: NDArray[np.float64]) -> Points:
    """The points that a file's matrix takes to these.

    :raises FormatError: where it takes others there, too
    """
    try:
        return np.linalg.solve(linear, points.T).T
    except np.linalg.LinAlgError as error:
        raise FormatError(
            "A matrix in the file flattens a part of it, and nothing can be written back through that. "
            "Take that part away, or give it its shape by its points and not by a matrix."
        ) from error


def weld(corners: Points) -> tuple[Points, NDArray[np.int64]]:
    """The distinct ones of these points, and the number of each corner's among them."""
    whole = np.ascontiguousarray(corners + 0.0)  # -0 is 0
    rows = whole.view(np.dtype((np.void, whole.dtype.itemsize * 3))).ravel()
    _, first, number = np.unique(rows, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")  # as they come in the file
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return whole[first[order]], place[number]
