# SPDX-License-Identifier: GPL-3.0-or-later
"""What a channel gets and gives."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
import trimesh
from meshmark.formats import read_body
from numpy.typing import NDArray


@dataclass(frozen=True)
class Shape:
    """Points, in any unit, and triangles."""

    points: NDArray[np.float64]
    faces: NDArray[np.int32]

    @classmethod
    def read(cls, path: Path) -> Self:
        """What meshmark, and so who looks for the mark, sees in a file."""
        body = read_body(path)
        return cls(body.points, body.faces)

    def write(self, path: Path) -> None:
        """By trimesh, which has all formats; binary and in single precision where the format has such."""
        trimesh.Trimesh(self.points, self.faces, process=False).export(path)

    def scaled(self, factor: float) -> Self:
        """The same in another unit."""
        return type(self)(self.points * factor, self.faces)

    def as_print(self) -> Self:
        """With a longest side of 100, as slicers and editors expect of millimetres."""
        return self.scaled(100 / float(np.ptp(self.points, axis=0).max()))

    @property
    def diagonal(self) -> float:
        """Of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


@dataclass(frozen=True)
class Passage:
    """How far, in the channel's own measure (-1 is none), how many steps, and the seed of what is random."""

    amount: float = -1
    iterations: int = -1
    seed: int = 0


Channel = Callable[[Shape, Passage], Shape]
