# SPDX-License-Identifier: GPL-3.0-or-later
"""Which model of the ledger a shape is, and whether it is that model whole and little changed."""

from dataclasses import dataclass

import numpy as np

from ..catalog.ledger import Model
from ..errors import FormatError
from ..shape.pieces import Piece
from ..shape.signature import difference, roughening

# Measured on marked copies of eight models (README): what a mark survives changes a shape by less than the first, and
# two models differ by more than the second. Between them a copy is damaged, and no mark says nothing.
SAME, ALIKE = 0.02, 0.1
COARSER = 0.25  # of the model's faces; what has fewer was simplified beyond what a mark is sure to outlive
ROUGHER, SMOOTHER = 0.02, -0.03  # of the area; noise and smoothing that erase marks change it by more
# A mark on a coarse model outlives little: only where that is as it was, but for place and size, would one be read.
FINE = 20_000  # faces
STILL = 1e-3  # of the moments
EVEN, SANDED = 1.8e-4, -5e-4  # of the area: noise of .1 % and 9 bits add more, and mostly a mark less


@dataclass(frozen=True)
class Likeness:
    """A piece, a model, and how far they are apart."""

    piece: str
    model: Model
    difference: float
    roughening: float
    faces: float  # as a part of the model's

    @property
    def alike(self) -> bool:
        """It may be a copy of the model, damaged perhaps."""
        return self.difference < ALIKE

    @property
    def intact(self) -> bool:
        """It is the model, and a mark in it would be read."""
        if self.model.faces < FINE:
            return self.difference < STILL and SANDED < self.roughening < EVEN and abs(self.faces - 1) < 1e-3
        return self.difference < SAME and SMOOTHER < self.roughening < ROUGHER and self.faces > COARSER


Likes = dict[str, list[Likeness]]  # of each piece, by its name: the models from the nearest on


def ranked(piece: Piece, models: list[Model]) -> list[Likeness]:
    """The models from the nearest on; in the ledger's order where the piece has no shape."""
    try:
        found = piece.signature()
    except FormatError:
        return [Likeness(piece.name, model, np.inf, 0, 1) for model in models]
    signatures = [np.array(model.signature) for model in models]
    likes = [
        Likeness(piece.name, model, difference(found, one), roughening(found, one), len(piece.faces) / model.faces)
        for model, one in zip(models, signatures, strict=True)
    ]
    return sorted(likes, key=lambda like: like.difference)


def of_one_shape(model: Model, other: Model) -> bool:
    """Whether a copy of either may be one of the other: two files of a shape, or two versions of a file."""
    return difference(np.array(model.signature), np.array(other.signature)) < SAME


def nearest(likes: list[Likeness]) -> Likeness | None:
    """The first of these, where the piece has a shape."""
    return likes[0] if likes and np.isfinite(likes[0].difference) else None
