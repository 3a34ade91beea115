# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY, binary and ASCII. Colours, texture coordinates, quality and properties that nobody knows stay."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import FormatError
from . import hosted
from .body import Body, Points, write_whole

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class _Header:
    kind: str
    end: int
    first: str  # name of the first element
    count: int
    properties: list[tuple[str, str]]  # of that element: name and numpy's type


def read(path: Path) -> Body:
    """Vertices must come first, as they do in all files that are known."""
    contents = path.read_bytes()
    header = _header(path, contents)
    own = _ascii(contents, header) if header.kind == "ascii" else _table(contents, header)
    positions = np.stack([np.asarray(own[axis], dtype=float) for axis in "xyz"], axis=1)
    points, faces = hosted.geometry(path)
    if len(points) != len(positions) or not np.allclose(points, positions, rtol=1e-6, atol=0):
        raise FormatError(f"'{path}' is written in a way that meshmark does not know. Save it anew, and try again.")

    def write(out: Path, moved: Points) -> None:
        rest = _written_ascii if header.kind == "ascii" else _written_table
        write_whole(out, contents[: header.end] + rest(contents, header, moved))

    return Body(points, faces, "mm", write)


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
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"] and elements:
            elements[-1][2].append((words[-1], _TYPES.get(words[1], "list")))
    name, count, properties = elements[0] if elements else ("", 0, [])
    if name != "vertex" or "list" in dict(properties).values() or not {"x", "y", "z"} <= dict(properties).keys():
        raise FormatError(f"'{path}' does not begin with plain vertices. Save it anew, and try again.")
    return _Header(kind, end, name, count, properties)


def _table(contents: bytes, header: _Header) -> np.ndarray:
    rows = np.dtype([(name, _ORDERS[header.kind] + kind) for name, kind in header.properties])
    return np.frombuffer(contents, rows, header.count, header.end)


def _written_table(contents: bytes, header: _Header, moved: Points) -> bytes:
    table = _table(contents, header).copy()
    for axis, name in enumerate("xyz"):
        table[name] = moved[:, axis]
    return table.tobytes() + contents[header.end + table.nbytes :]


def _ascii(contents: bytes, header: _Header) -> dict[str, list[bytes]]:
    lines = contents[header.end :].split(b"\n", header.count)[: header.count]
    columns = list(zip(*(line.split() for line in lines), strict=False))
    return {name: list(column) for (name, _), column in zip(header.properties, columns, strict=False)}


def _written_ascii(contents: bytes, header: _Header, moved: Points) -> bytes:
    *lines, rest = contents[header.end :].split(b"\n", header.count)
    columns = [[name for name, _ in header.properties].index(axis) for axis in "xyz"]
    for number, point in enumerate(moved):
        words = lines[number].split()
        for column, value in zip(columns, point, strict=True):
            words[column] = f"{value:.9g}".encode()
        lines[number] = b" ".join(words)
    return b"\n".join([*lines, rest])
