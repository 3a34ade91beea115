# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ: materials, groups and polygons stay; texture coordinates and colours of vertices are carried."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import hosted
from .body import Body, Faces, Points, Skin
from .corners import Numbers, corners_of, of_vertices, shared
from .lines import Edit, edits, numbers, patched, text

_THREE = rb"(\S+[ \t]+\S+[ \t]+\S+)"
_VERTEX = re.compile(rb"^[ \t]*v[ \t]++" + _THREE + rb"(?:[ \t]+" + _THREE + rb")?", re.MULTILINE)
_TEXTURE = re.compile(rb"^[ \t]*vt[ \t]+(\S+[ \t]+\S+)[^\n]*\n?", re.MULTILINE)
_FACE = re.compile(
    rb"^[ \t]*(?:f[ \t]++((?:\\\r?\n|[^\n])*+)|usemtl[ \t]+([^\n]*)|(vt?)[ \t])", re.MULTILINE
)  # a line may go on behind a backslash
_CORNER = re.compile(rb"[^\s\\]+")


def read(path: Path) -> Body:
    """What has no texture is quicker."""
    contents = path.read_bytes()
    found = list(_VERTEX.finditer(contents))
    own = numbers(found, 1, 3)
    _check_faces(contents)
    faces = hosted.triangles_over(own, path)
    colors = numbers(found, 2, 3) if all(match.group(2) for match in found) else None
    cloth = _Cloth.read(contents, faces)

    def written(moved: Points, skin: Skin) -> bytes:
        changes = edits(found, 1, own, moved)
        if colors is not None and skin.colors is not None:
            changes += edits(found, 2, colors, of_vertices(faces, skin.colors[..., :3], colors))
        if cloth and skin.texture is not None:
            changes += cloth.edits(skin.texture)
        return patched(contents, changes)

    skin = Skin(
        cloth.texture if cloth else None,
        None if colors is None else np.column_stack([colors, np.ones(len(colors))])[faces],
        cloth.picture if cloth else None,
    )
    return Body(own, faces, "mm", written, skin)


def _check_faces(contents: bytes) -> None:
    """MeshLab looks for what is not there in foreign memory; of what a file has none of, it does not look at all."""
    kinds = (b"v", b"vt", b"vn")  # as a corner names them
    counts = [len(re.findall(rb"(?m)^[ \t]*%b[ \t]" % kind, contents)) for kind in kinds]
    for match in _FACE.finditer(contents):
        for corner in _CORNER.findall(match[1] or b""):
            for number, kind, count in zip(corner.split(b"/"), kinds, counts, strict=False):
                if number and (count or kind == b"v") and not 0 < abs(int(number)) <= count:
                    raise ValueError(f"a face names {kind.decode()} {int(number)}, which is not there")


@dataclass(frozen=True)
class _Cloth:
    """Texture coordinates: a table of them, and of each corner in the file its place there, or -1."""

    lines: list[re.Match[bytes]]
    table: Points
    words: list[tuple[int, bytes]]  # of each corner where it stands, and what
    place: Numbers
    corner: Numbers  # of each corner of the triangles that in the file
    picture: Numbers  # of each triangle

    @classmethod
    def read(cls, contents: bytes, faces: Faces) -> "_Cloth | None":
        lines = list(_TEXTURE.finditer(contents))
        if not lines:
            return None
        words: list[tuple[int, bytes]] = []
        polygons: list[list[int]] = []
        places: list[int] = []
        pictures: list[int] = []
        names: dict[bytes, int] = {}
        material, vertices, coordinates = 0, 0, 0
        for match in _FACE.finditer(contents):
            if match.group(1) is not None:
                here = list(_CORNER.finditer(match.group(1)))
                words += [(match.start(1) + word.start(), word.group()) for word in here]
                parts = [word.group().split(b"/") for word in here]
                polygons.append([_counted(part[0], vertices) for part in parts])
                places += [_counted(part[1], coordinates) if len(part) > 1 and part[1] else -1 for part in parts]
                pictures += [material] * len(here)
            elif match.group(3) is None:
                material = names.setdefault(match.group(2).strip(), len(names))
            elif match.group(3) == b"v":
                vertices += 1
            else:
                coordinates += 1
        corner = corners_of(polygons, faces)
        picture = np.array(pictures)[corner[:, 0]]
        return cls(lines, numbers(lines, 1, 2), words, np.array(places), corner, picture)

    @property
    def texture(self) -> Points:
        """Of the triangles' corners; 0 where there is none."""
        return np.where(self.place >= 0, self.table[self.place].T, 0).T[self.corner]

    def edits(self, texture: Points) -> list[Edit]:
        """In place; where corners that shared a line no longer show the same, all lines stand together."""
        new = np.where(self.place >= 0, self.table[self.place].T, 0).T
        new[self.corner] = texture
        has = self.place >= 0
        table, place = shared(self.place[has], self.table, new[has])
        if len(table) == len(self.table):
            return edits(self.lines, 1, self.table, table)
        kept, added = table[: len(self.lines)], table[len(self.lines) :]
        changed = (kept != self.table).any(axis=1)
        rows = zip(self.lines, kept.tolist(), changed, strict=True)
        lines = [_line(line, text(*row) if moved else line.group(1)) for line, row, moved in rows]
        lines += [b"vt %b\n" % text(*row) for row in added.tolist()]
        first, *others = self.lines
        changes = [(*first.span(), b"".join(lines)), *((*line.span(), b"") for line in others)]
        for (begin, word), number in zip(np.array(self.words, dtype=object)[has], place, strict=True):
            vertex, _, *rest = word.split(b"/")
            changes.append((begin, begin + len(word), b"/".join([vertex, str(number + 1).encode(), *rest])))
        return changes


def _line(line: re.Match[bytes], text: bytes) -> bytes:
    """The same line with this in place of its first two numbers."""
    (begin, end), at, whole = line.span(1), line.start(), line.group()
    return (whole[: begin - at] + text + whole[end - at :]).rstrip(b"\n") + b"\n"


def _counted(number: bytes, before: int) -> int:
    """From 0; a negative number counts back from here."""
    value = int(number)
    return value - 1 if value > 0 else before + value
