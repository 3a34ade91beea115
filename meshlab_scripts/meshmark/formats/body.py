# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file says of the shape, and how its positions are written back with all else left as it is."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]  # a row a vertex
Faces = NDArray[np.int32]  # a row a triangle
Corners = NDArray[np.float64]  # of each triangle's three corners some numbers: faces x 3 x numbers


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
    write: Callable[[Path, Points, Skin], None]  # the same file with these positions, and this skin
    skin: Skin = field(default_factory=Skin)


def weld(corners: Points) -> tuple[Points, NDArray[np.int64]]:
    """The distinct ones of these points, and the number of each corner's among them."""
    whole = np.ascontiguousarray(corners + 0.0)  # -0 is 0
    rows = whole.view(np.dtype((np.void, whole.dtype.itemsize * 3))).ravel()
    _, first, number = np.unique(rows, return_index=True, return_inverse=True)
    order = np.argsort(first, kind="stable")  # as they come in the file
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return whole[first[order]], place[number]


def write_whole(path: Path, contents: bytes) -> None:
    """The file is there whole, or as it was."""
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_bytes(contents)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
