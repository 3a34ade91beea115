# SPDX-License-Identifier: GPL-3.0-or-later
"""OFF: polygons and their colours stay; colours of vertices (COFF) are carried."""

import re
from pathlib import Path

import numpy as np

from ..errors import FormatError
from . import hosted
from .body import Body, Points, Skin, write_whole
from .corners import of_vertices
from .lines import edits, numbers, patched

_COUNT = re.compile(rb"\A(?:\s|#[^\n]*\n)*((?:ST|C|N)*)OFF\b(?:\s|#[^\n]*\n)*(\d+)\s+\d+(?:[ \t]+\d+)?[^\n]*\n")
_LINE = re.compile(rb"^[ \t]*([^\s#]\S*[ \t]+\S+[ \t]+\S+)(?:[ \t]+([^\r\n#]*[^\s#]))?", re.MULTILINE)


def read(path: Path) -> Body:
    """Of a rarer kind, or none, the host says what it is."""
    contents = path.read_bytes()
    head = _COUNT.match(contents)
    if not head:
        return hosted.read(path)
    lines = _LINE.finditer(contents, head.end())
    found = [line for line, _ in zip(lines, range(int(head[2])), strict=False)]
    own = numbers(found, 1, 3)
    points, faces = hosted.geometry(path)
    if len(own) != len(points) or not np.allclose(points, own, rtol=1e-6, atol=0):
        raise FormatError(f"'{path}' is written in a way that meshmark does not know. Save it anew, and try again.")
    colors = _colors(found) if head[1] == b"C" else None

    def write(out: Path, moved: Points, skin: Skin) -> None:
        changes = edits(found, 1, own, moved)
        if colors is not None and skin.colors is not None:
            scale = _scale(colors)
            shown = of_vertices(faces, skin.colors, _rgba(colors / scale))[:, : colors.shape[1]] * scale
            changes += edits(found, 2, colors, shown if scale == 1 else np.round(shown))
        write_whole(out, patched(contents, changes))

    skin = Skin() if colors is None else Skin(colors=_rgba(colors / _scale(colors))[faces])
    return Body(points, faces, "mm", write, skin)


def _colors(found: list[re.Match[bytes]]) -> Points | None:
    """Three or four numbers of each vertex, as they stand there."""
    widths = {len((line.group(2) or b"").split()) for line in found}
    return numbers(found, 2, *widths) if widths in ({3}, {4}) else None


def _scale(colors: Points) -> float:
    return 255 if colors.max(initial=0) > 1 else 1


def _rgba(colors: Points) -> Points:
    """Opaque where there is no alpha."""
    return np.column_stack([colors, np.ones((len(colors), 4 - colors.shape[1]))])
