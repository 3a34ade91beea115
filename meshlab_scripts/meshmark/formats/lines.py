# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts with a line a vertex: only the numbers of these lines change."""

import re
from collections.abc import Iterable

import numpy as np

from .body import Points

WORD = re.compile(rb"\S+")
Edit = tuple[int, int, bytes]  # from, to, and what comes there


def patched(contents: bytes, edits: Iterable[Edit]) -> bytes:
    """The text after edits that do not overlap."""
    pieces, end = [], 0
    for begin, after, new in sorted(edits):
        pieces += [contents[end:begin], new]
        end = after
    return b"".join([*pieces, contents[end:]])


def numbers(found: list[re.Match[bytes]], group: int, width: int) -> Points:
    """What stands in a group of these matches, a row a match."""
    rows = [[float(word) for word in match.group(group).split()] for match in found]
    return np.array(rows, dtype=float).reshape(-1, width)


def text(*values: float) -> bytes:
    """Numbers as nine digits hold them."""
    return b" ".join(b"%.9g" % value for value in values)


def edits(found: list[re.Match[bytes]], group: int, old: Points, new: Points) -> list[Edit]:
    """New numbers in a group of these matches, where they differ from the old."""
    changed = old != new
    places = []
    for row in np.flatnonzero(changed.any(axis=1)):
        begin = found[row].start(group)
        for word, other, value in zip(WORD.finditer(found[row][group]), changed[row], new[row].tolist(), strict=True):
            if other:
                places.append((begin + word.start(), begin + word.end(), text(value)))
    return places
