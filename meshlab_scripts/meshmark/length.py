# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths with a unit, such as 0.05mm, and the units that files are in."""

import math
import re
from contextlib import suppress
from dataclasses import dataclass

from .errors import MeshmarkError

MILLIMETRES = {
    "micron": 1e-3,
    "um": 1e-3,
    "mm": 1.0,
    "millimeter": 1.0,
    "cm": 10.0,
    "centimeter": 10.0,
    "m": 1000.0,
    "meter": 1000.0,
    "in": 25.4,
    "inch": 25.4,
    "ft": 304.8,
    "foot": 304.8,
}
_TEXT = re.compile(r"\s*([0-9.]+(?:[eE][+-]?[0-9]+)?)\s*([a-z]*)\s*")


@dataclass(frozen=True)
class Length:
    """A length; without a unit it is in the mesh's own."""

    amount: float
    unit: str = ""

    def within(self, file_unit: str) -> float:
        """In the unit of a file."""
        return self.amount * MILLIMETRES[self.unit] / MILLIMETRES[file_unit] if self.unit else self.amount

    def __str__(self) -> str:
        return f"{self.amount:g}{f' {self.unit}' if self.unit else ''}"


def read_length(text: "str | float | Length") -> Length:
    """`0.05mm`, `2um`, `0.001in`, or a number in the mesh's own unit."""
    if isinstance(text, Length):
        return text
    match = _TEXT.fullmatch(str(text))
    if match and (match[2] == "" or match[2] in MILLIMETRES):
        with suppress(ValueError):
            amount = float(match[1])
            if 0 < amount < math.inf:
                return Length(amount, match[2])
    raise MeshmarkError(f"'{text}' is no length. Write a number above 0 and a unit: 0.05mm, 50um, 0.002in.")
