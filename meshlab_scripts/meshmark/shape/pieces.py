# SPDX-License-Identifier: GPL-3.0-or-later
"""A body as a whole, and its connected pieces: a plate of copies, a model with a pedestal or floaters."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..formats import Body
from .signature import signature

MOST = 16  # pieces that are looked at, the largest
LEAST = 0.01  # part of the area that a piece must have


@dataclass(frozen=True)
class Piece:
    """A mesh by itself."""

    name: str  # "the whole file", "piece 2 of 4"
    points: NDArray[np.float64]
    faces: NDArray[np.int32]

    def signature(self) -> NDArray[np.float64]:
        """Of this piece; raises FormatError where it has no surface."""
        return signature(self.points, self.faces)


def pieces(body: Body) -> list[Piece]:
    """The whole first, then what it consists of where that is more than one piece."""
    from scipy.sparse import coo_array  # takes longer to load than most commands need
    from scipy.sparse.csgraph import connected_components

    points, faces = body.welded()
    whole = Piece("the whole file", points, faces)
    ends = faces[:, [0, 1, 1, 2]].reshape(-1, 2).T
    graph = coo_array((np.ones(ends.shape[1], dtype=np.int8), ends), shape=(len(points), len(points)))
    _, of_point = connected_components(graph, directed=False)
    of_face = of_point[faces[:, 0]]
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.bincount(of_face, np.linalg.norm(normals, axis=1))
    count = int(np.count_nonzero(np.bincount(of_face)))
    if count < 2:
        return [whole]
    large = [one for one in np.argsort(-area, kind="stable")[:MOST] if area[one] > LEAST * area.sum()]
    return [whole, *(_piece(points, faces[of_face == one], f"piece {n} of {count}") for n, one in enumerate(large, 1))]


def _piece(points: NDArray[np.float64], faces: NDArray[np.int32], name: str) -> Piece:
    used, number = np.unique(faces, return_inverse=True)
    return Piece(name, points[used], number.reshape(-1, 3).astype(np.int32))
