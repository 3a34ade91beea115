# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY, binary and ASCII. Quality and properties that nobody knows stay; colours of vertices and texture coordinates, of
vertices or of faces' corners, are carried.
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import FormatError
from . import hosted
from .body import Body, Faces, Points, Skin
from .corners import corners_of, of_vertices
from .lines import WORD, Edit, patched, text

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_TEXTURES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
_COLORS = ("red", "green", "blue", "alpha")
_SHORT = {"texcoord": 32, "color": 32}  # lists that MeshLab has little room for


@dataclass(frozen=True)
class _Property:
    name: str
    kind: str  # numpy's
    count: str = ""  # of a list that of its length


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: list[_Property]


@dataclass(frozen=True)
class _Header:
    kind: str
    end: int
    vertices: _Element
    others: list[_Element]  # faces first, mostly


def read(path: Path) -> Body:
    """Vertices must come first, as they do in all files that are known."""
    contents = path.read_bytes()
    header = _header(path, contents)
    table = _ascii(contents, header) if header.kind == "ascii" else _table(contents, header)
    _check_lists(contents, header)
    own = _columns(table, tuple("xyz"))
    faces = hosted.triangles_over(own, path)
    names = [one.name for one in header.vertices.properties]
    uv = next((pair for pair in _TEXTURES if set(pair) <= set(names)), None)
    rgb = tuple(name for name in _COLORS if name in names)
    full = _full(header, "red") if set(_COLORS[:3]) <= set(rgb) else 0
    corners = None if uv else _Corners.read(contents, header, faces)

    def written(moved: Points, skin: Skin) -> bytes:
        columns = {"xyz"[axis]: moved[:, axis] for axis in range(3)}
        if uv and skin.texture is not None:
            columns |= zip(uv, of_vertices(faces, skin.texture, _columns(table, uv)).T, strict=True)
        if full and skin.colors is not None:
            shown = of_vertices(faces, skin.colors, _rgba(table, rgb, full)) * full
            columns |= zip(rgb, shown.T if full == 1 else np.round(shown).T, strict=False)
        edits = _ascii_edits if header.kind == "ascii" else _table_edits
        changes = list(edits(contents, header, table, columns))
        if corners and skin.texture is not None:
            changes += corners.edits(skin.texture)
        return patched(contents, changes)

    texture = _columns(table, uv)[faces] if uv else corners.texture if corners else None
    colors = _rgba(table, rgb, full)[faces] if full else None
    return Body(own, faces, "mm", written, Skin(texture, colors, corners.picture if corners else None))


def _header(path: Path, contents: bytes) -> _Header:
    end = contents.find(b"end_header")
    end = contents.find(b"\n", end) + 1
    if not contents.startswith(b"ply") or end <= 0:
        raise FormatError(f"'{path}' is no PLY file, or not whole.")
    kind, elements = "", []
    for words in (line.split() for line in contents[:end].decode("latin-1").splitlines()):
        if words[:1] == ["format"]:
            kind = words[1]
        elif words[:1] == ["element"]:
            elements.append(_Element(words[1], int(words[2]), []))
        elif words[:2] == ["property", "list"] and elements:
            elements[-1].properties.append(_Property(words[4], _TYPES[words[3]], _TYPES[words[2]]))
        elif words[:1] == ["property"] and elements:
            elements[-1].properties.append(_Property(words[2], _TYPES[words[1]]))
    if not all(0 <= one.count <= len(contents) for one in elements):
        raise ValueError("it promises more than it has")
    vertices, *others = elements or [_Element("", 0, [])]
    names = {one.name for one in vertices.properties}
    if vertices.name != "vertex" or any(one.count for one in vertices.properties) or not {"x", "y", "z"} <= names:
        raise FormatError(f"'{path}' does not begin with plain vertices. Save it anew, and try again.")
    return _Header(kind, end, vertices, others)


def _columns(table: np.ndarray, names: tuple[str, ...]) -> Points:
    return np.stack([np.asarray(table[name], dtype=float) for name in names], axis=1)


def _full(header: _Header, name: str) -> float:
    """What a colour's greatest value is."""
    kind = np.dtype(next(one.kind for one in header.vertices.properties if one.name == name))
    return float(np.iinfo(kind).max) if kind.kind in "iu" else 1


def _rgba(table: np.ndarray, names: tuple[str, ...], full: float) -> Points:
    """Opaque where there is no alpha."""
    colors = _columns(table, names) / full
    return np.column_stack([colors, np.ones((len(colors), 4 - len(names)))])


def _table(contents: bytes, header: _Header) -> np.ndarray:
    rows = np.dtype([(one.name, _ORDERS[header.kind] + one.kind) for one in header.vertices.properties])
    return np.frombuffer(contents, rows, header.vertices.count, header.end)


def _table_edits(contents: bytes, header: _Header, table: np.ndarray, columns: dict[str, np.ndarray]) -> Iterator[Edit]:
    new = table.copy()
    for name, values in columns.items():
        changed = table[name] != values
        new[name][changed] = values[changed]
    yield header.end, header.end + table.nbytes, new.tobytes()


def _ascii(contents: bytes, header: _Header) -> dict[str, np.ndarray]:
    lines = _vertex_lines(contents, header)
    rows = np.array([[float(word) for word in line.split()] for line in lines])
    columns = rows.reshape(header.vertices.count, len(header.vertices.properties)).T
    return {one.name: column for one, column in zip(header.vertices.properties, columns, strict=True)}


def _ascii_edits(
    contents: bytes, header: _Header, table: dict[str, np.ndarray], columns: dict[str, np.ndarray]
) -> Iterator[Edit]:
    lines = _vertex_lines(contents, header)
    begins = header.end + np.cumsum([0, *(len(line) + 1 for line in lines)])
    for at, name in enumerate(table):
        values = columns.get(name, table[name])
        for row in np.flatnonzero(table[name] != values):
            begin, end = next(itertools.islice(WORD.finditer(lines[row]), at, None)).span()
            yield begins[row] + begin, begins[row] + end, text(values[row])


def _vertex_lines(contents: bytes, header: _Header) -> list[bytes]:
    return contents[header.end :].split(b"\n", header.vertices.count)[: header.vertices.count]


def _begin_of_others(contents: bytes, header: _Header) -> int:
    if header.kind == "ascii":
        return header.end + sum(len(line) + 1 for line in _vertex_lines(contents, header))
    return header.end + _table(contents, header).nbytes


def _check_lists(contents: bytes, header: _Header) -> None:
    """MeshLab takes lists of any length into places of some; strips, it takes for granted that their vertices exist."""
    lists = [one for element in header.others for one in element.properties if one.count]
    if header.kind != "ascii" and all(one.count == "u1" and one.name not in _SHORT for one in lists):
        return  # as nearly all binary files are
    begin, order = _begin_of_others(contents, header), _ORDERS.get(header.kind, "")
    for element, row in _rows(contents, header.others, begin, order):
        for name, values in row.items():
            if element.name == "tristrips":
                if not all(-1 <= value < header.vertices.count for value, _ in values):
                    raise ValueError("a strip names a vertex that is not there")
            elif len(values) > _SHORT.get(name, 255):
                raise ValueError(f"a list '{name}' has {len(values)} values")


@dataclass(frozen=True)
class _Corners:
    """Texture coordinates in the element of faces: where in the file each corner's two numbers stand."""

    spans: list[list[tuple[int, int]]]  # of each corner in the file
    kind: str  # numpy's; empty for ASCII
    values: Points
    corner: np.ndarray  # of each corner of the triangles that in the file
    picture: np.ndarray | None

    @classmethod
    def read(cls, contents: bytes, header: _Header, faces: Faces) -> "_Corners | None":
        """None where faces have none."""
        element = next(iter(header.others), None)
        kinds = {one.name: one.kind for one in element.properties} if element else {}
        if not element or element.name != "face" or "texcoord" not in kinds:
            return None
        order = _ORDERS.get(header.kind, "")
        polygons, spans, values, pictures = [], [], [], []
        for _, row in _rows(contents, [element], _begin_of_others(contents, header), order):
            polygon = row.get("vertex_indices") or row["vertex_index"]
            polygons.append([int(value) for value, _ in polygon])
            texcoord = row["texcoord"]
            if len(texcoord) != 2 * len(polygon):
                raise ValueError("a face has not two texture coordinates a corner")
            for u, v in zip(texcoord[::2], texcoord[1::2], strict=True):
                values.append((u[0], v[0]))
                spans.append([u[1], v[1]])
            pictures += [row["texnumber"][0][0] if "texnumber" in row else 0] * len(polygon)
        corner = corners_of(polygons, faces)
        picture = np.array(pictures, dtype=np.int32)[corner[:, 0]] if "texnumber" in kinds else None
        kind = order + kinds["texcoord"] if order else ""
        return cls(spans, kind, np.array(values, dtype=float).reshape(-1, 2), corner, picture)

    @property
    def texture(self) -> Points:
        """Of the triangles' corners."""
        return self.values[self.corner]

    def edits(self, texture: Points) -> Iterator[Edit]:
        """Of the numbers that differ."""
        new = self.values.copy()
        new[self.corner] = texture
        for row, axis in zip(*np.nonzero(new != self.values), strict=True):
            value = new[row, axis]
            yield *self.spans[row][axis], np.array(value).astype(self.kind).tobytes() if self.kind else text(value)


_Values = list[tuple[float, tuple[int, int]]]  # and where they stand


def _rows(
    contents: bytes, elements: list[_Element], begin: int, order: str
) -> Iterator[tuple[_Element, dict[str, _Values]]]:
    """The rows of elements that follow each other, by the name of the property."""
    take = _binary if order else _words
    for element in elements:
        for _ in range(element.count):
            row = {}
            for one in element.properties:
                count = 1
                if one.count:
                    ((length, (_, begin)),) = take(contents, begin, order + one.count, 1)
                    count = int(length)
                row[one.name] = take(contents, begin, order + one.kind, count)
                begin = row[one.name][-1][1][1] if row[one.name] else begin
            yield element, row


def _binary(contents: bytes, begin: int, kind: str, count: int) -> _Values:
    if count < 0:
        raise ValueError(f"a list has {count} values")
    values = np.frombuffer(contents, kind, count, begin)
    starts = range(begin, begin + values.nbytes, values.itemsize)
    return [(value, (start, start + values.itemsize)) for value, start in zip(values.tolist(), starts, strict=True)]


def _words(contents: bytes, begin: int, kind: str, count: int) -> _Values:
    found = list(itertools.islice(WORD.finditer(contents, begin), count))
    if len(found) < count:
        raise ValueError("it ends too early")
    return [(float(word.group()), word.span()) for word in found]
