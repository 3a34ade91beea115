# SPDX-License-Identifier: GPL-3.0-or-later
"""OFF: polygons and their colours stay; colours of vertices (COFF) are carried."""

import re
from itertools import islice, pairwise
from pathlib import Path

import numpy as np

from ..errors import FormatError
from .body import Body, Faces, Points, Skin, triangles
from .corners import of_vertices
from .lines import edits, numbers, patched

_COUNT = re.compile(rb"\A(?:\s|#[^\n]*\n)*((?:ST|C|N)*)OFF\b(?:\s|#[^\n]*\n)*(\d+)\s+(\d+)(?:[ \t]+\d+)?[^\n]*\n")
_LINE = re.compile(rb"^[ \t]*([^\s#]\S*[ \t]+\S+[ \t]+\S+)(?:[ \t]+([^\r\n#]*[^\s#]))?", re.MULTILINE)
_FACE = re.compile(rb"^[ \t]*([^\s#][^\r\n]*)", re.MULTILINE)


def read(path: Path) -> Body:
    """Of a vertex a line, and a face a line."""
    contents = path.read_bytes()
    head = _COUNT.match(contents)
    if not head:
        raise FormatError(
            f"'{path}' is no OFF file, or of a rare kind (binary, 4OFF, nOFF). Save it anew as plain OFF."
        )
    count = int(head[2])
    found = list(islice(_LINE.finditer(contents, head.end()), min(count, len(contents))))
    own = numbers(found, 1, 3)
    if len(own) < count:
        raise ValueError(f"it has {len(own)} of {count} vertices")
    faces = _fans(contents, found[-1].end() if found else head.end(), int(head[3]), count)
    colors = _colors(found) if head[1] == b"C" else None

    def written(moved: Points, skin: Skin) -> bytes:
        changes = edits(found, 1, own, moved)
        if colors is not None and skin.colors is not None:
            scale = _scale(colors)
            before = _rgba(colors / scale)
            shown = of_vertices(faces, skin.colors, before)
            new = (shown * scale if scale == 1 else np.round(shown * scale))[:, : colors.shape[1]]
            changes += edits(found, 2, colors, np.where((shown == before).all(axis=1)[:, None], colors, new))
        return patched(contents, changes)

    skin = Skin() if colors is None else Skin(colors=_rgba(colors / _scale(colors))[faces])
    return Body(own, faces, "mm", written, skin)


def _fans(contents: bytes, begin: int, faces: int, vertices: int) -> Faces:
    """The polygons as fans of triangles.

    MeshLab's reader is not asked: it misreads polygons of five corners, and reads foreign memory at blank lines, faces
    with the number of a colour, and what is not there.
    """
    found: list[tuple[int, int, int]] = []
    read = 0
    for line in islice(_FACE.finditer(contents, begin), min(faces, len(contents))):
        first, *rest = line[1].split()
        size = int(first)
        corners = [int(word) for word in rest[: max(size, 0)]]
        if len(corners) < size or size < 1:
            raise ValueError(f"its face {read} has {len(corners)} corners")
        found += [(corners[0], *pair) for pair in pairwise(corners[1:])]
        read += 1
    if read < faces:
        raise ValueError(f"it has {read} of {faces} faces")
    return triangles(found, vertices)


def _colors(found: list[re.Match[bytes]]) -> Points | None:
    """Three or four numbers of each vertex, as they stand there."""
    widths = {len((line.group(2) or b"").split()) for line in found}
    return numbers(found, 2, *widths) if widths in ({3}, {4}) else None


def _scale(colors: Points) -> float:
    return 255 if colors.max(initial=0) > 1 else 1


def _rgba(colors: Points) -> Points:
    """Opaque where there is no alpha."""
    return np.column_stack([colors, np.ones((len(colors), 4 - colors.shape[1]))])
