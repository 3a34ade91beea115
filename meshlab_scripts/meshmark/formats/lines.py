# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts with a line a vertex: only the numbers of these lines change."""

import re
from collections.abc import Iterable

import numpy as np

from .body import Points

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
    return np.array([match.group(group).split() for match in found], dtype="S40").astype(float).reshape(-1, width)


def texts(values: Points) -> list[bytes]:
    """Each row as nine digits hold it."""
    return [" ".join(f"{value:.9g}" for value in row).encode() for row in values.tolist()]


def edits(found: list[re.Match[bytes]], group: int, old: Points, new: Points) -> list[Edit]:
    """New numbers in a group of these matches, where they differ from the old."""
    rows = np.flatnonzero((old != new).any(axis=1))
    spans = (found[row].span(group) for row in rows)
    return [(*span, text) for span, text in zip(spans, texts(new[rows]), strict=True)]
