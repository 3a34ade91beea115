# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ and OFF: text with a line a vertex. Only the three numbers of these lines change."""

import re
from pathlib import Path

import numpy as np

from ..errors import FormatError
from . import hosted
from .body import Body, Points, write_whole

_NUMBERS = rb"(\S+[ \t]+\S+[ \t]+\S+)"
_OBJ = re.compile(rb"^([ \t]*v[ \t]+)" + _NUMBERS, re.MULTILINE)
_OFF_COUNT = re.compile(rb"\A\s*(?:ST|C|N)*OFF\b(?:\s|#[^\n]*\n)*(\d+)\s+\d+(?:[ \t]+\d+)?[^\n]*\n")
_OFF_LINE = re.compile(rb"^([ \t]*)" + _NUMBERS.replace(rb"(\S+", rb"([^\s#]\S*", 1), re.MULTILINE)


def read_obj(path: Path) -> Body:
    """Materials, texture coordinates, groups, polygons and vertex colours stay."""
    return _read(path, _OBJ, 0, None)


def read_off(path: Path) -> Body:
    """Polygons and colours stay."""
    count = _OFF_COUNT.match(path.read_bytes())
    if not count:
        return hosted.read(path)  # a rarer kind of OFF, or none: the host says
    return _read(path, _OFF_LINE, count.end(), int(count[1]))


def _read(path: Path, line: re.Pattern[bytes], begin: int, count: int | None) -> Body:
    contents = path.read_bytes()
    found = []
    for match in line.finditer(contents, begin):
        if len(found) == count:
            break
        found.append(match)
    own = np.array([match.group(2).split() for match in found], dtype="S40").astype(float).reshape(-1, 3)
    points, faces = hosted.geometry(path)
    if len(own) < len(points) or not np.allclose(points, own[: len(points)], rtol=1e-6, atol=0):
        raise FormatError(f"'{path}' is written in a way that meshmark does not know. Save it anew, and try again.")

    def write(out: Path, moved: Points) -> None:
        pieces, end = [], 0
        for match, point in zip(found, moved, strict=False):
            pieces += [contents[end : match.start(2)], " ".join(f"{value:.9g}" for value in point).encode()]
            end = match.end(2)
        write_whole(out, b"".join([*pieces, contents[end:]]))

    return Body(points, faces, "mm", write)
