# SPDX-License-Identifier: GPL-3.0-or-later
"""GLB (binary glTF 2.0): positions, the first texture coordinates and colours are changed in the file's own buffer; all
else stays byte for byte.

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
from .body import Body, Corners, Faces, Points, Skin, write_whole
from .corners import of_vertices

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
    document, binary = _open(path)
    parts: list[_Part] = []
    points: list[Points] = []
    faces: list[Faces] = []
    shown: dict[str, list[_Shown]] = {_TEXTURE: [], _COLOR: []}
    for primitive, matrix in _primitives(document):
        number = primitive["attributes"]["POSITION"]
        part = next((p for p in parts if p.accessor == number and p.matrix is matrix), None)
        if part is None:
            own = _view(document, binary, number).astype(float)
            part = _Part(number, matrix, sum(map(len, points)), len(own))
            parts.append(part)
            points.append(own @ matrix[:3, :3].T + matrix[:3, 3])
        local = _triangles(document, binary, primitive, part.count)
        for name, places in shown.items():
            if name in primitive["attributes"]:
                places.append(_Shown(primitive["attributes"][name], sum(map(len, faces)), local))
        faces.append(local + part.begin)
    if not points:
        raise FormatError(f"'{path}' has no triangles.")

    def write(out: Path, moved: Points, skin: Skin) -> None:
        _write(path, out, parts, moved, [(shown[_TEXTURE], skin.texture), (shown[_COLOR], skin.colors)])

    count = sum(map(len, faces))
    skin = Skin(
        _corners(document, binary, shown[_TEXTURE], np.zeros((count, 3, 2))),
        _corners(document, binary, shown[_COLOR], np.ones((count, 3, 4))),
        _pictures(shown[_TEXTURE], count),
    )
    return Body(np.concatenate(points), np.concatenate(faces).astype(np.int32), "m", write, skin)


def _corners(document: Json, binary: bytearray, shown: list[_Shown], corners: Corners) -> Corners | None:
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


def _write(
    path: Path, out: Path, parts: list[_Part], moved: Points, skin: list[tuple[list[_Shown], Corners | None]]
) -> None:
    if len({part.accessor for part in parts}) < len(parts):
        raise FormatError(f"'{path}' shows one mesh in several places. Make the copies real ones first, or mark one.")
    document, binary = _open(path)
    for part in parts:
        placed = moved[part.begin : part.begin + part.count] - part.matrix[:3, 3]
        local = np.linalg.solve(part.matrix[:3, :3], placed.T).T.astype("<f4")
        _view(document, binary, part.accessor)[:] = local
        accessor = document["accessors"][part.accessor]
        accessor["min"], accessor["max"] = local.min(axis=0).tolist(), local.max(axis=0).tolist()
    for shown, corners in skin:
        for one in shown if corners is not None else []:
            _show(document, binary, one, corners[one.first : one.first + len(one.faces)])
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=False).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON) + text + struct.pack("<II", len(binary), _BIN) + bytes(binary)
    write_whole(out, struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def _show(document: Json, binary: bytearray, shown: _Shown, corners: Corners) -> None:
    values = _view(document, binary, shown.accessor)
    full = _full(values)
    new = of_vertices(shown.faces, corners[..., : values.shape[1]], values / full) * full
    values[:] = new if full == 1 else np.round(new)
    accessor = document["accessors"][shown.accessor]
    if "min" in accessor:
        accessor["min"], accessor["max"] = values.min(axis=0).tolist(), values.max(axis=0).tolist()


def _open(path: Path) -> tuple[Json, bytearray]:
    contents = path.read_bytes()
    if contents[:4] != b"glTF" or len(contents) < 20 or struct.unpack_from("<I", contents, 4)[0] != 2:
        raise FormatError(f"'{path}' is no GLB file of glTF 2.0.")
    document, binary, begin = None, bytearray(), 12
    while begin + 8 <= len(contents):
        length, kind = struct.unpack_from("<II", contents, begin)
        chunk = contents[begin + 8 : begin + 8 + length]
        if kind == _JSON:
            document = json.loads(chunk)
        elif kind == _BIN:
            binary = bytearray(chunk)
        begin += 8 + length
    if document is None:
        raise FormatError(f"'{path}' is not whole.")
    packed = [name for name in document.get("extensionsRequired", []) if name in _COMPRESSED]
    if packed:
        raise FormatError(f"'{path}' is packed ({packed[0]}). Unpack it first, mark it, and pack it again.")
    return document, binary


def _primitives(document: Json) -> Iterator[tuple[Json, np.ndarray]]:
    """Each primitive of triangles, and its node's matrix: one object for all primitives of the node."""
    nodes = document.get("nodes", [])
    scenes = document.get("scenes") or [{"nodes": list(range(len(nodes)))}]
    waiting = [(number, np.eye(4)) for number in reversed(scenes[document.get("scene", 0)].get("nodes", []))]
    while waiting:
        number, above = waiting.pop()
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


def _view(document: Json, binary: bytearray, number: int) -> np.ndarray:
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
    begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.ndarray((accessor["count"], width), kind, binary, begin, (stride, kind.itemsize))


def _triangles(document: Json, binary: bytearray, primitive: Json, count: int) -> Faces:
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
