# SPDX-License-Identifier: GPL-3.0-or-later
"""STL, binary and ASCII. Header, attribute bytes (colours of some programs) and names of solids stay."""

import re
from pathlib import Path

import numpy as np

from ..errors import FormatError
from .body import Body, Points, Skin, weld
from .lines import edits, numbers, patched

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 84
_THREE = rb"\s+(\S+\s+\S+\s+\S+)"
_ASCII = re.compile(
    rb"facet\s+normal%b\s+outer\s+loop\s+" % _THREE + rb"\s+".join([rb"vertex%b" % _THREE] * 3), re.IGNORECASE
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
    facets = np.frombuffer(contents, _TRIANGLE, count, _HEADER)
    points, number = weld(facets["corners"].reshape(-1, 3).astype(float))
    faces = number.reshape(-1, 3)

    def written(moved: Points, skin: Skin) -> bytes:
        changed = facets.copy()
        corner = (moved != points).any(axis=1)[faces]
        changed["corners"][corner] = moved[faces[corner]]
        turned, normals = _normals(changed["corners"].astype(float), corner)
        changed["normal"][turned] = normals
        return contents[:_HEADER] + changed.tobytes() + contents[_HEADER + facets.nbytes :]

    return Body(points, faces.astype(np.int32), "mm", written)


def _ascii(path: Path, contents: bytes) -> Body:
    found = list(_ASCII.finditer(contents))
    if not found:
        raise FormatError(f"'{path}' has no triangles.")
    corners = np.stack([numbers(found, group, 3) for group in (2, 3, 4)], axis=1)
    points, number = weld(corners.reshape(-1, 3))
    faces = number.reshape(-1, 3)

    def written(moved: Points, skin: Skin) -> bytes:
        placed = moved[faces]
        turned, normals = _normals(placed, (placed != corners).any(axis=2))
        whatever = np.full_like(normals, np.nan)  # programs write words there that are no numbers
        changes = edits([found[row] for row in turned], 1, whatever, normals)
        for k in range(3):
            changes += edits(found, 2 + k, corners[:, k], placed[:, k])
        return patched(contents, changes)

    return Body(points, faces.astype(np.int32), "mm", written)


def _normals(corners: Points, moved: np.ndarray) -> tuple[np.ndarray, Points]:
    """The numbers of the facets with corners that have moved, and their normals; that of no area keeps the file's."""
    facets = np.flatnonzero(moved.any(axis=1))
    a, b, c = corners[facets].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    length = np.linalg.norm(across, axis=1)
    return facets[length > 0], across[length > 0] / length[length > 0, None]
