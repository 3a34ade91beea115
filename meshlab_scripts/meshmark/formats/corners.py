# SPDX-License-Identifier: GPL-3.0-or-later
"""What files say of the corners of faces, and the corners of the triangles that a reader makes of them."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from .body import Corners, Faces, Points

Numbers = NDArray[np.int64]


def corners_of(polygons: Iterable[Sequence[int]], triangles: Faces) -> Numbers:
    """Of each triangle the polygons' corners, counted through all of them.

    A reader cuts polygons in order, along whatever diagonals, and may leave out some.

    :raises ValueError: where the triangles are not those of the polygons
    """
    found = np.empty_like(triangles, dtype=np.int64)
    rows = iter(triangles.tolist())
    row, number, first = next(rows, None), 0, 0
    for polygon in polygons:
        place = {vertex: first + k for k, vertex in enumerate(polygon)}
        left = len(polygon) - 2
        while row is not None and left > 0 and all(vertex in place for vertex in row):
            found[number] = [place[vertex] for vertex in row]
            row, number, left = next(rows, None), number + 1, left - 1
        first += len(polygon)
    if row is not None:
        raise ValueError("its polygons are not what MeshLab reads")
    return found


def of_vertices(faces: Faces, shown: Corners, before: Points) -> Points:
    """What vertices show, from what their corners do; `before` where a vertex has none."""
    values = before.copy()
    values[faces.ravel()] = shown.reshape(-1, shown.shape[-1])
    return values


def shared(index: Numbers, table: Points, new: Points) -> tuple[Points, Numbers]:
    """A table of values, and each corner's place in it, when corners show what is new.

    A place that several corners share and would fill differently goes to one of them, rather to one that shows what it
    did; the others get places behind the table's end.
    """
    changed = (table[index] != new).any(axis=1)
    rows, row_of = np.unique(np.column_stack([index, changed, new]), axis=0, return_inverse=True)
    place = rows[:, 0].astype(np.int64)
    first = np.diff(place, prepend=-1) != 0
    values = np.concatenate([table, rows[~first, 2:]])
    values[place[first]] = rows[first, 2:]
    place[~first] = len(table) + np.arange(np.count_nonzero(~first))
    return values, place[row_of.ravel()]
