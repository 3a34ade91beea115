# SPDX-License-Identifier: GPL-3.0-or-later
"""GLB (binary glTF 2.0): positions, the first texture coordinates and colours are changed in the file's own buffer, and
the bounds of these in its JSON; all else stays byte for byte.

The body is the scene with its nodes' matrices. Khronos: glTF 2.0 specification, sections 3.6 (accessors), 4 (GLB).
"""

import json
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import FormatError
from .body import Body, Corners, Faces, Points, Skin, before_matrix, check_places, triangles
from .corners import of_vertices
from .json_text import members
from .lines import Edit, patched

Json = dict[str, Any]
_JSON, _BIN = 0x4E4F534A, 0x004E4942
_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization")
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_TEXTURE, _COLOR = "TEXCOORD_0", "COLOR_0"


@dataclass(frozen=True)
class _Part:
    """The positions of an accessor as a node shows them."""

    accessor: int
    matrix: np.ndarray
    begin: int
    count: int


@dataclass(frozen=True)
class _Shown:
    """An accessor of what vertices show, and the triangles of a primitive that show it."""

    accessor: int
    first: int
    faces: Faces  # by their place in the accessor


def read(path: Path) -> Body:
    """All triangles of the scene."""
    file = _File.read(path)
    document, binary = file.document, file.binary
    parts: list[_Part] = []
    numbers: dict[tuple[int, int], int] = {}  # of the parts, by accessor and node
    points: list[Points] = []
    faces: list[Faces] = []
    shown: dict[str, list[_Shown]] = {_TEXTURE: [], _COLOR: []}
    vertices, count = 0, 0
    for primitive, matrix in _primitives(document):
        accessor = primitive["attributes"]["POSITION"]
        number = numbers.setdefault((accessor, id(matrix)), len(parts))
        if number == len(parts):
            own = _view(document, binary, accessor).astype(float)
            parts.append(_Part(accessor, matrix, vertices, len(own)))
            points.append(own @ matrix[:3, :3].T + matrix[:3, 3])
            vertices += len(own)
        part = parts[number]
        local = triangles(_corners_of(document, binary, primitive, part.count), part.count)
        for name, places in shown.items():
            if name in primitive["attributes"]:
                places.append(_Shown(primitive["attributes"][name], count, local))
        faces.append(local + part.begin)
        count += len(local)
        check_places(len(faces), count)
    if not points:
        raise FormatError(f"'{path}' has no triangles.")

    own = np.concatenate(points)

    def written(moved: Points, skin: Skin) -> bytes:
        if len({part.accessor for part in parts}) < len(parts):
            raise FormatError(
                f"'{path}' shows one mesh in several places. Make the copies real ones first, or mark one."
            )
        changed = bytearray(binary)
        for part in parts:
            _move(document, changed, part, own, moved)
        for places, corners in ((shown[_TEXTURE], skin.texture), (shown[_COLOR], skin.colors)):
            for one in places if corners is not None else []:
                _show(document, changed, one, corners[one.first : one.first + len(one.faces)])
        accessors = {part.accessor for part in parts} | {one.accessor for places in shown.values() for one in places}
        return file.with_binary(changed, sorted(accessors))

    skin = Skin(
        _corners(document, binary, shown[_TEXTURE], np.zeros((count, 3, 2))),
        _corners(document, binary, shown[_COLOR], np.ones((count, 3, 4))),
        _pictures(shown[_TEXTURE], count),
    )
    return Body(own, np.concatenate(faces).astype(np.int32), "m", written, skin)


def _corners(document: Json, binary: bytes, shown: list[_Shown], corners: Corners) -> Corners | None:
    """What the triangles show at their corners; None where none shows anything."""
    for one in shown:
        values = _view(document, binary, one.accessor)
        corners[one.first : one.first + len(one.faces), :, : values.shape[1]] = (values / _full(values))[one.faces]
    return corners if shown else None


def _pictures(shown: list[_Shown], count: int) -> np.ndarray | None:
    """Triangles of different accessors share no texture."""
    pictures = np.full(count, -1, dtype=np.int32)
    for one in shown:
        pictures[one.first : one.first + len(one.faces)] = one.accessor
    return pictures if len(np.unique(pictures)) > 1 else None


def _full(values: np.ndarray) -> float:
    """What stands for 1."""
    return float(np.iinfo(values.dtype).max) if values.dtype.kind in "iu" else 1


def _move(document: Json, binary: bytearray, part: _Part, own: Points, moved: Points) -> None:
    before, after = (points[part.begin : part.begin + part.count] for points in (own, moved))
    rows = (after != before).any(axis=1)
    if rows.any():
        local = before_matrix(after[rows] - part.matrix[:3, 3], part.matrix[:3, :3])
        _view(document, binary, part.accessor)[rows] = local


def _show(document: Json, binary: bytearray, shown: _Shown, corners: Corners) -> None:
    values = _view(document, binary, shown.accessor)
    full = _full(values)
    new = of_vertices(shown.faces, corners[..., : values.shape[1]], values / full) * full
    values[:] = new if full == 1 else np.round(new)


@dataclass(frozen=True)
class _File:
    """A header of 12 bytes, and chunks of which each has its length and its kind before it."""

    contents: bytes
    json: slice
    binary_place: slice
    document: Json

    @classmethod
    def read(cls, path: Path) -> "_File":
        contents = path.read_bytes()
        if contents[:4] != b"glTF" or len(contents) < 20 or struct.unpack_from("<I", contents, 4)[0] != 2:
            raise FormatError(f"'{path}' is no GLB file of glTF 2.0.")
        chunks: dict[int, slice] = {}
        begin = 12
        while begin + 8 <= len(contents):
            length, kind = struct.unpack_from("<II", contents, begin)
            chunks.setdefault(kind, slice(begin + 8, begin + 8 + length))
            begin += 8 + length
        if _JSON not in chunks or any(chunk.stop > len(contents) for chunk in chunks.values()):
            raise FormatError(f"'{path}' is not whole.")
        document = json.loads(contents[chunks[_JSON]])
        packed = [name for name in document.get("extensionsRequired", []) if name in _COMPRESSED]
        if packed:
            raise FormatError(f"'{path}' is packed ({packed[0]}). Unpack it first, mark it, and pack it again.")
        return cls(contents, chunks[_JSON], chunks.get(_BIN, slice(begin, begin)), document)

    @property
    def binary(self) -> bytes:
        """The file's own buffer."""
        return self.contents[self.binary_place]

    def with_binary(self, binary: bytes | bytearray, accessors: list[int]) -> bytes:
        """The same file with other contents of these accessors; in the JSON their bounds change, where they have."""
        changes = list(self._bounds(binary, accessors))
        longer = sum(len(new) - (end - begin) for begin, end, new in changes)
        padding = -longer % 4
        changes.append((self.json.stop, self.json.stop, b" " * padding))
        for place in (8, self.json.start - 8):  # where the lengths of the file and of the JSON stand
            length = struct.unpack_from("<I", self.contents, place)[0] + longer + padding
            changes.append((place, place + 4, struct.pack("<I", length)))
        changes.append((self.binary_place.start, self.binary_place.stop, bytes(binary)))
        return patched(self.contents, changes)

    def _bounds(self, binary: bytes | bytearray, accessors: list[int]) -> Iterator[Edit]:
        text = self.contents[self.json].decode("latin-1")  # a character a byte; what is not ASCII stands in texts only
        places = members(text, members(text)["accessors"][0])
        for number in accessors:
            old, new = (_view(self.document, buffer, number) for buffer in (self.binary, binary))
            own = members(text, places[number][0])
            for name, bound in (("min", np.min), ("max", np.max)):
                spans = members(text, own[name][0]) if name in own else {}
                before, after = bound(old, axis=0).tolist(), bound(new, axis=0).tolist()
                for axis, (begin, end) in spans.items():
                    if before[axis] != after[axis]:
                        yield self.json.start + begin, self.json.start + end, json.dumps(after[axis]).encode()


def _primitives(document: Json) -> Iterator[tuple[Json, np.ndarray]]:
    """Each primitive of triangles, and its node's matrix: one object for all primitives of the node."""
    nodes = document.get("nodes", [])
    scenes = document.get("scenes") or [{"nodes": list(range(len(nodes)))}]
    waiting = [(number, np.eye(4)) for number in reversed(scenes[document.get("scene", 0)].get("nodes", []))]
    seen = set()
    while waiting:
        number, above = waiting.pop()
        if number in seen:
            raise FormatError(
                f"Node {number} of the scene stands below itself, or below two. Give each a single parent."
            )
        seen.add(number)
        node = nodes[number]
        matrix = above @ _matrix(node)
        waiting += [(child, matrix) for child in reversed(node.get("children", []))]
        if "mesh" not in node:
            continue
        shown = np.eye(4) if "skin" in node else matrix  # joints place a skin, its node does not
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            if primitive.get("mode", _TRIANGLES) in (_TRIANGLES, _STRIP, _FAN):
                yield primitive, shown


def _matrix(node: Json) -> np.ndarray:
    if "matrix" in node:
        return np.array(node["matrix"], dtype=float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= node.get("scale", [1, 1, 1])
    matrix[:3, 3] = node.get("translation", [0, 0, 0])
    return matrix


def _view(document: Json, binary: bytes | bytearray, number: int) -> np.ndarray:
    """An accessor's numbers, a row an element, in the buffer itself."""
    accessor = document["accessors"][number]
    if "bufferView" not in accessor or "sparse" in accessor:
        raise FormatError("A sparse accessor of glTF is not read. Export the model without.")
    view = document["bufferViews"][accessor["bufferView"]]
    if view.get("buffer", 0) != 0 or "uri" in document["buffers"][0]:
        raise FormatError("A GLB with buffers outside of the file is not read. Export it as one file.")
    kind = np.dtype(_COMPONENTS[accessor["componentType"]])
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    stride = view.get("byteStride", width * kind.itemsize)
    if stride < width * kind.itemsize or accessor["count"] < 1:
        raise ValueError(f"accessor {number} has no elements, or they lie one upon the other")
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.ndarray((accessor["count"], width), kind, binary, begin, (stride, kind.itemsize))


def _corners_of(document: Json, binary: bytes, primitive: Json, count: int) -> np.ndarray:
    """Of the triangles of a primitive."""
    number = primitive.get("indices")
    corners = np.arange(count) if number is None else _view(document, binary, number).ravel().astype(np.int64)
    mode = primitive.get("mode", _TRIANGLES)
    if mode == _TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if mode == _FAN:
        return np.stack([np.full(len(corners) - 2, corners[0]), corners[1:-1], corners[2:]], axis=1)
    strip = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    strip[1::2, :2] = strip[1::2, 1::-1]
    return strip
