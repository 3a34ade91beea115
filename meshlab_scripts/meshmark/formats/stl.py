# SPDX-License-Identifier: GPL-3.0-or-later
"""STL, binary and ASCII. Header, attribute bytes (colours of some programs) and names of solids stay."""

import re
from pathlib import Path

import numpy as np

from ..errors import FormatError
from .body import Body, Points, Skin, weld, write_whole

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 84
_NUMBER = rb"[-+0-9.eE]+"
_ASCII = re.compile(
    rb"(facet\s+normal\s+)(\S+\s+\S+\s+\S+)(\s+outer\s+loop\s+)"
    + rb"(\s+)".join([rb"vertex\s+(%b)\s+(%b)\s+(%b)" % (_NUMBER, _NUMBER, _NUMBER)] * 3),
    re.IGNORECASE,
)


def read(path: Path) -> Body:
    """Corners at one position are one vertex."""
    contents = path.read_bytes()
    count = int.from_bytes(contents[80:84], "little") if len(contents) >= _HEADER else -1
    if len(contents) >= _HEADER + count * _TRIANGLE.itemsize and count > 0:
        return _binary(contents, count)
    if contents.lstrip()[:5].lower() == b"solid":
        return _ascii(path, contents)
    raise FormatError(f"'{path}' is no STL file, or not whole.")


def _binary(contents: bytes, count: int) -> Body:
    triangles = np.frombuffer(contents, _TRIANGLE, count, _HEADER)
    points, number = weld(triangles["corners"].reshape(-1, 3).astype(float))

    def write(out: Path, moved: Points, skin: Skin) -> None:
        changed = triangles.copy()
        changed["corners"] = moved[number].reshape(-1, 3, 3)
        changed["normal"] = _normals(changed["corners"].astype(float), triangles["normal"])
        rest = contents[_HEADER + count * _TRIANGLE.itemsize :]
        write_whole(out, contents[:_HEADER] + changed.tobytes() + rest)

    return Body(points, number.reshape(-1, 3).astype(np.int32), "mm", write)


def _ascii(path: Path, contents: bytes) -> Body:
    found = list(_ASCII.finditer(contents))
    if not found:
        raise FormatError(f"'{path}' has no triangles.")
    corners = np.array([[match.group(k) for k in (4, 5, 6, 8, 9, 10, 12, 13, 14)] for match in found], dtype="S32")
    points, number = weld(corners.astype(float).reshape(-1, 3))

    def write(out: Path, moved: Points, skin: Skin) -> None:
        placed = moved[number].reshape(-1, 3, 3)
        old = np.array([match.group(2).split() for match in found], dtype="S32").astype(float)
        new = zip(_normals(placed, old), placed, strict=True)

        def line(match: re.Match[bytes]) -> bytes:
            normal, (a, b, c) = next(new)
            first, second = match.group(7), match.group(11)
            return b"".join(
                [match.group(1), _text(normal), match.group(3), b"vertex ", _text(a), first, b"vertex ", _text(b),
                 second, b"vertex ", _text(c)]
            )  # fmt: skip

        write_whole(out, _ASCII.sub(line, contents))

    return Body(points, number.reshape(-1, 3).astype(np.int32), "mm", write)


def _text(numbers: Points) -> bytes:
    return " ".join(f"{value:.9g}" for value in numbers).encode()


def _normals(corners: Points, old: Points) -> Points:
    """Of the triangles; that of the file where a triangle has none."""
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.where(length > 0, across / np.where(length > 0, length, 1), old)
