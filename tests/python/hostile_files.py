# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that lead a reader astray: numbers of what is not there, circles, promises that no memory can keep."""

import io
import json
import struct
import zipfile
from collections.abc import Callable
from typing import Any

import trimesh

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
RELATIONS = f'<Relationships><Relationship Target="/a.model" Type="{MODEL}"/></Relationships>'
MANY = 10**12


def off(vertices: int = 4, faces: int = 4, first: str = "3 0 2 1") -> bytes:
    rows = [" ".join(map(str, row)) for row in POINTS] + [first, "3 0 1 3", "3 0 3 2", "3 1 2 3"]
    return "\n".join(["OFF", f"{vertices} {faces} 0", *rows, ""]).encode()


def obj(face: str) -> bytes:
    rows = ["v " + " ".join(map(str, row)) for row in POINTS] + ["vt 0 0", "vn 0 0 1", face, "f 1 2 4"]
    return "\n".join([*rows, ""]).encode()


def ply(
    vertices: int = 4,
    faces: int = 1,
    face: str = "3 0 2 1",
    lists: str = "uchar int vertex_indices",
    name: str = "face",
) -> bytes:
    """With the list of another element, too, where `lists` says so."""
    head = ["ply", "format ascii 1.0", f"element vertex {vertices}", *(f"property float {axis}" for axis in "xyz")]
    head += [f"element {name} {faces}", *(f"property list {one}" for one in lists.split(", ")), "end_header"]
    return "\n".join([*head, *(" ".join(map(str, row)) for row in POINTS), face, ""]).encode()


def binary_ply(length: int) -> bytes:
    """A face whose list says that it is so long."""
    text = ply(lists="int int vertex_indices").replace(b"ascii", b"binary_little_endian").partition(b"end_header\n")
    vertices = struct.pack("<12f", *(value for row in POINTS for value in row))
    return b"".join([*text[:2], vertices, struct.pack("<i3i", length, 0, 1, 2)])


def glb(change: Callable[[dict[str, Any]], object]) -> bytes:
    """With another document; what `change` returns, if anything, takes its place."""
    contents = trimesh.Scene(trimesh.Trimesh(POINTS, FACES)).export(file_type="glb")
    length = struct.unpack_from("<I", contents, 12)[0]
    document = json.loads(contents[20 : 20 + length])
    text = json.dumps(change(document) or document).encode()
    return glb_of(text, contents[20 + length :])


def glb_of(text: bytes, rest: bytes = b"") -> bytes:
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


def accessor_of(document: dict[str, Any], name: str) -> dict[str, Any]:
    primitive = document["meshes"][0]["primitives"][0]
    return document["accessors"][primitive["attributes"].get(name, primitive["indices"])]


def endless_view(document: dict[str, Any]) -> None:
    """All elements at one place: as many as one likes."""
    accessor = accessor_of(document, "POSITION")
    document["bufferViews"][accessor["bufferView"]]["byteStride"] = 0
    accessor["count"] = 2**36


def mesh_in_many_places(document: dict[str, Any]) -> None:
    document["meshes"][0]["primitives"] *= 1000
    document["nodes"] = [{"mesh": 0}] * 1000
    document["scenes"][0]["nodes"] = list(range(1000))


def threemf(face: str = "0 2 1", x: str = 'x="0"', more: str = "", item: str = "1", broken: str = "") -> bytes:
    a, b, c = face.split()
    model = (
        f'<model xmlns="{CORE}"><resources><object id="1"><mesh><vertices><vertex {x} y="0" z="0"/>'
        '<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles>'
        f'<triangle v1="{a}" v2="{b}" v3="{c}"/></triangles></mesh></object>{more}</resources>'
        f'<build><item objectid="{item}"/></build></model>{broken}'
    )
    return package({"_rels/.rels": RELATIONS, "a.model": model})


def package(parts: dict[str, str | bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, contents in parts.items():
            archive.writestr(name, contents)
    return buffer.getvalue()


def composed(number: int, *of: int) -> str:
    components = "".join(f'<component objectid="{one}"/>' for one in of)
    return f'<object id="{number}"><components>{components}</components></object>'


def damaged() -> bytes:
    """Its picture is not what its checksum says."""
    buffer = io.BytesIO(threemf())
    with zipfile.ZipFile(buffer, "a") as archive:
        archive.writestr("picture", b"a picture", zipfile.ZIP_STORED)
    return buffer.getvalue().replace(b"a picture", b"a mixture")


def ascii_stl(number: str) -> bytes:
    corners = "".join(f"vertex {x} {y} {z}\n" for x, y, z in ([number, 0, 0], [1, 0, 0], [0, 1, 0]))
    return f"solid a\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid a\n".encode()


def binary_stl(*numbers: float) -> bytes:
    return bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, *numbers, 0)


# By what is wrong: the file's ending, and what is in it.
HOSTILE: dict[str, tuple[str, Callable[[], bytes]]] = {
    "OFF: a vertex that is not there": ("off", lambda: off(first="3 0 2 9")),
    "OFF: a vertex before the first": ("off", lambda: off(first="3 0 2 -1")),
    "OFF: a face without end": ("off", lambda: off(first="999999999 0 2 1")),
    "OFF: a face that is too short": ("off", lambda: off(first="3 0 2")),
    "OFF: vertices without end": ("off", lambda: off(vertices=MANY)),
    "OFF: faces without end": ("off", lambda: off(faces=MANY)),
    "OFF: a face too many": ("off", lambda: off(faces=5)),
    "OFF: binary": ("off", lambda: off().replace(b"OFF", b"OFF BINARY")),
    "OBJ: a vertex that is not there": ("obj", lambda: obj("f 1 2 9")),
    "OBJ: a vertex behind the last": ("obj", lambda: obj("f 1 2 5")),
    "OBJ: vertex 0": ("obj", lambda: obj("f 0 2 3")),
    "OBJ: a vertex before the first": ("obj", lambda: obj("f 1 2 -9")),
    "OBJ: a polygon with a vertex that is not there": ("obj", lambda: obj("f 1 2 3 999999999")),
    "OBJ: a texture that is not there": ("obj", lambda: obj("f 1/1 2/1 3/1 4/999999999")),
    "OBJ: a normal that is not there": ("obj", lambda: obj("f 1//1 2//1 3//1 4//999999999")),
    "OBJ: words": ("obj", lambda: obj("f x y z")),
    "OBJ: a vertex that is not there, on a second line": ("obj", lambda: obj("f 1 2 \\\n 9 3")),
    "PLY: a vertex that is not there": ("ply", lambda: ply(face="3 0 2 9")),
    "PLY: a vertex before the first": ("ply", lambda: ply(face="3 0 2 -1")),
    "PLY: vertices without end": ("ply", lambda: ply(vertices=MANY)),
    "PLY: faces without end": ("ply", lambda: ply(faces=MANY)),
    "PLY: fewer than no faces": ("ply", lambda: ply(faces=-1)),
    "PLY: a list that is too long": ("ply", lambda: ply(face="3000 " + "0 1 2 " * 1000)),
    "PLY: a list without end": ("ply", lambda: binary_ply(2**31 - 1)),
    "PLY: a list of fewer than none": ("ply", lambda: binary_ply(-5)),
    "PLY: too many texture coordinates": (
        "ply",
        lambda: ply(face="3 0 2 1 255 " + "0 " * 255, lists="uchar int vertex_indices, uchar float texcoord"),
    ),
    "PLY: a strip over a vertex that is not there": (
        "ply",
        lambda: ply(face="4 0 1 2 999999", lists="int int vertex_indices", name="tristrips"),
    ),
    "GLB: a vertex that is not there": ("glb", lambda: glb(lambda d: accessor_of(d, "POSITION").update(count=3))),
    "GLB: vertices without end": ("glb", lambda: glb(lambda d: accessor_of(d, "POSITION").update(count=MANY))),
    "GLB: vertices all at one place": ("glb", lambda: glb(endless_view)),
    "GLB: a list": ("glb", lambda: glb(lambda d: [d])),
    "GLB: lists in lists": ("glb", lambda: glb_of(b"[" * 100_000)),
    "GLB: a node that is its own child": (
        "glb",
        lambda: glb(lambda d: d.update(nodes=[{"children": [0]}], scenes=[{"nodes": [0]}])),
    ),
    "GLB: nodes that multiply": (
        "glb",
        lambda: glb(lambda d: d.update(nodes=[{"children": [n + 1, n + 1]} for n in range(60)] + [{"mesh": 0}],
                                       scenes=[{"nodes": [0]}])),
    ),
    "GLB: one mesh in many places": ("glb", lambda: glb(mesh_in_many_places)),
    "GLB: no numbers": (
        "glb",
        lambda: glb(lambda d: d.update(nodes=[{"mesh": 0, "matrix": [float("nan")] * 16}], scenes=[{"nodes": [0]}])),
    ),
    "3MF: a vertex that is not there": ("3mf", lambda: threemf("0 2 9")),
    "3MF: a vertex before the first": ("3mf", lambda: threemf("0 2 -1")),
    "3MF: no XML": ("3mf", lambda: threemf(broken="<")),
    "3MF: no numbers": ("3mf", lambda: threemf(x='x="nan"')),
    "3MF: a number missing": ("3mf", lambda: threemf(x="")),
    "3MF: a component of itself": ("3mf", lambda: threemf(more=composed(2, 2), item="2")),
    "3MF: components of each other": ("3mf", lambda: threemf(more=composed(2, 3) + composed(3, 2), item="2")),
    "3MF: components that multiply": (
        "3mf",
        lambda: threemf(more="".join(composed(n, n - 1, n - 1) for n in range(2, 22)), item="21"),
    ),
    "3MF: a bomb": ("3mf", lambda: package({"_rels/.rels": RELATIONS, "a.model": bytes(40_000_000)})),
    "3MF: a damaged picture": ("3mf", damaged),
    "STL: no number": ("stl", lambda: binary_stl(float("nan"), 0, 0, 1, 0, 0, 0, 1, 0)),
    "STL: too large a number": ("stl", lambda: binary_stl(float("inf"), 0, 0, 1, 0, 0, 0, 1, 0)),
    "ASCII STL: no number": ("stl", lambda: ascii_stl("nan")),
    "ASCII STL: a word": ("stl", lambda: ascii_stl("x")),
}  # fmt: skip
