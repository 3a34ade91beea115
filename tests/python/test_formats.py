# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of every kind: what is read is what another library reads, and writing changes positions and nothing else."""

import io
import json
import re
import struct
import zipfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import meshmark
import numpy as np
import pytest
import trimesh
from meshmark.formats import read_body, weld

Maker = Callable[[Path], None]
NUMBER = rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"


def body() -> tuple[np.ndarray, np.ndarray]:
    """A bumpy ball of 162 vertices, in numbers that a float holds."""
    ball = trimesh.creation.icosphere(2)
    points = ball.vertices * (1 + 0.2 * np.sin(3 * ball.vertices[:, [1, 2, 0]])) * [30, 20, 10]
    return np.round(points * 1024) / 1024, ball.faces


POINTS, FACES = body()


def make_stl(path: Path) -> None:
    rows = np.zeros(len(FACES), np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("colour", "<u2")]))
    rows["c"], rows["colour"] = POINTS[FACES], np.arange(len(FACES))
    path.write_bytes(b"made by hand".ljust(80, b".") + struct.pack("<I", len(rows)) + rows.tobytes())


def make_ascii_stl(path: Path) -> None:
    lines = ["solid a name"]
    for triangle in POINTS[FACES]:
        lines += ["  facet normal 0 0 1", "    outer loop"]
        lines += ["      vertex {:.6f} {:.6f} {:.6f}".format(*corner) for corner in triangle]
        lines += ["    endloop", "  endfacet"]
    path.write_text("\n".join([*lines, "endsolid a name", ""]))


def make_ply(path: Path, order: str = "<") -> None:
    kind = {"<": "little", ">": "big"}[order]
    header = (
        f"ply\nformat binary_{kind}_endian 1.0\ncomment kept\nelement vertex {len(POINTS)}\nproperty uchar red\n"
        "property double x\nproperty double y\nproperty double z\nproperty float odd_one\n"
        f"element face {len(FACES)}\nproperty list uchar int vertex_indices\nproperty uchar blue\nend_header\n"
    )
    vertices = np.zeros(len(POINTS), [("red", "u1"), ("xyz", f"{order}f8", 3), ("odd", f"{order}f4")])
    vertices["xyz"], vertices["red"], vertices["odd"] = POINTS, np.arange(len(POINTS)), np.arange(len(POINTS)) / 7
    faces = np.zeros(len(FACES), [("n", "u1"), ("abc", f"{order}i4", 3), ("blue", "u1")])
    faces["n"], faces["abc"], faces["blue"] = 3, FACES, np.arange(len(FACES)) % 200
    path.write_bytes(header.encode() + vertices.tobytes() + faces.tobytes())


def make_ascii_ply(path: Path) -> None:
    lines = [f"ply\nformat ascii 1.0\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y",
             f"property float z\nproperty uchar red\nelement face {len(FACES)}",
             "property list uchar int vertex_indices\nend_header"]  # fmt: skip
    lines += ["{:.7f} {:.7f} {:.7f} {}".format(*point, n) for n, point in enumerate(POINTS)]
    lines += ["3 {} {} {}".format(*face) for face in FACES]
    path.write_text("\n".join(lines) + "\n")


def make_obj(path: Path) -> None:
    lines = ["# kept", "mtllib skin.mtl", "o thing"]
    lines += ["v {:.7f} {:.7f} {:.7f} 0.5 0.25 1".format(*point) for point in POINTS]
    lines += [f"vt {n / len(POINTS):.6f} {n % 7 / 7:.6f}" for n in range(len(POINTS))]
    lines += ["vn 0 0 1", "g first", "usemtl skin"]
    lines += ["f {0}/{0}/1 {1}/{1}/1 {2}/{2}/1".format(*face) for face in FACES[:100] + 1]
    lines += ["usemtl other"] + ["f {} {} {}".format(*face) for face in FACES[100:] + 1]
    path.write_text("\n".join(lines) + "\n")


def make_off(path: Path) -> None:
    lines = ["OFF", "# kept", f"{len(POINTS)} {len(FACES)} 0", ""]
    lines += ["{:.7f} {:.7f} {:.7f}".format(*point) for point in POINTS]
    lines += ["3 {} {} {} 255 0 0".format(*face) for face in FACES]
    path.write_text("\n".join(lines) + "\n")


def make_glb(path: Path) -> None:
    """Two nodes below one that turns and stretches; texture coordinates, a picture, extras."""
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3], [4, 5, 6]) @ np.diag([2, 2, 3, 1])
    uv = np.stack([np.arange(len(POINTS)) / len(POINTS)] * 2, axis=1)
    for name, place in (("one", np.eye(4)), ("second", trimesh.transformations.translation_matrix([100, 0, 0]))):
        mesh = trimesh.Trimesh(POINTS * (1 + len(name)), FACES, process=False)
        mesh.visual = trimesh.visual.TextureVisuals(uv=uv)
        scene.add_geometry(mesh, node_name=name, geom_name=name, transform=turn @ place)
    scene.metadata["shop"] = "kept"
    path.write_bytes(scene.export(file_type="glb"))


def make_3mf(path: Path) -> None:
    """In inches, turned and stretched by its build, with colours, a part of a slicer's, and a picture."""
    vertices = "".join('<vertex x="{:.7f}" y="{:.7f}" z="{:.7f}"/>'.format(*point) for point in POINTS)
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}" pid="5" p1="0"/>'.format(*face) for face in FACES)
    model = (
        '<?xml version="1.0" encoding="UTF-8"?>\n<model unit="inch" xml:lang="en-US" '
        'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
        'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">'
        '<metadata name="Title">kept</metadata><resources>'
        '<m:colorgroup id="5"><m:color color="#FF0000FF"/></m:colorgroup>'
        f'<object id="1" type="model"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>'
        '</object><object id="2" type="model"><components><component objectid="1" '
        'transform="0 1 0 -1 0 0 0 0 1 7 8 9"/></components></object></resources>'
        '<build><item objectid="2" transform="2 0 0 0 2 0 0 0 3 1 2 3"/></build></model>'
    )
    relations = (
        '<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
        '<Relationship Id="r" Target="/3D/3dmodel.model" '
        'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("_rels/.rels", relations)
        archive.writestr("3D/3dmodel.model", model)
        archive.writestr("Metadata/slicer.config", "kept")


MAKERS: dict[str, tuple[str, Maker]] = {
    "binary STL": ("a.stl", make_stl),
    "ASCII STL": ("b.stl", make_ascii_stl),
    "PLY": ("c.ply", make_ply),
    "ASCII PLY": ("e.ply", make_ascii_ply),
    "OBJ": ("f.obj", make_obj),
    "OFF": ("g.off", make_off),
    "GLB": ("h.glb", make_glb),
    "3MF": ("i.3mf", make_3mf),
}


def made(kind: str, folder: Path) -> Path:
    name, make = MAKERS[kind]
    make(folder / name)
    return folder / name


def read_by_trimesh(path: Path) -> np.ndarray:
    """The triangles' corners, in an order that does not depend on the file's."""
    scene = trimesh.load_scene(path, process=False)
    return in_order(np.concatenate([mesh.triangles for mesh in scene.dump()]))


def in_order(triangles: np.ndarray) -> np.ndarray:
    return triangles[np.lexsort(np.round(triangles.mean(axis=1), 3).T)]


@pytest.mark.parametrize("kind", MAKERS)
def test_the_shape_is_what_another_library_reads(tmp_path: Path, kind: str) -> None:
    path = made(kind, tmp_path)
    shape = read_body(path)
    np.testing.assert_allclose(in_order(shape.points[shape.faces]), read_by_trimesh(path), rtol=1e-5, atol=1e-4)
    assert shape.unit == {"GLB": "m", "3MF": "inch"}.get(kind, "mm")


@pytest.mark.parametrize("kind", MAKERS)
def test_what_is_written_is_the_same_file_with_other_positions(tmp_path: Path, kind: str) -> None:
    path = made(kind, tmp_path)
    shape = read_body(path)
    moved = shape.points + np.random.default_rng(1).normal(size=shape.points.shape)
    out = tmp_path / f"out{path.suffix}"
    shape.write(out, moved, shape.skin)
    again = read_body(out)
    np.testing.assert_allclose(again.points[again.faces], moved[shape.faces], rtol=1e-6, atol=1e-5)
    np.testing.assert_allclose(in_order(moved[shape.faces]), read_by_trimesh(out), rtol=1e-5, atol=1e-4)
    assert without_positions(out) == without_positions(path)
    assert sorted(file.name for file in tmp_path.iterdir()) == sorted([path.name, out.name])


def without_positions(path: Path) -> object:
    """All of a file but its positions, and normals of facets, which follow from these."""
    contents = path.read_bytes()
    match path.suffix:
        case ".stl" if contents.startswith(b"solid"):
            return re.sub(rb"(vertex|normal)( +%b){3}" % NUMBER, rb"\1", contents)
        case ".stl":
            rows = np.frombuffer(contents, "<u2", len(FACES) * 25, 84).reshape(-1, 25)
            return contents[:84], rows[:, 24].tobytes(), contents[84 + rows.nbytes :]
        case ".ply" if b"ascii" in contents:
            return [line.split()[3:] if len(line.split()) == 4 else line for line in contents.splitlines()[8:170]]
        case ".ply":
            end = contents.index(b"end_header\n") + 11
            rows = np.frombuffer(contents, "u1", len(POINTS) * 29, end).reshape(-1, 29)
            return contents[:end], rows[:, [0, 25, 26, 27, 28]].tobytes(), contents[end + rows.nbytes :]
        case ".obj":
            return re.sub(rb"(?m)^v( %b){3}" % NUMBER, b"v", contents)
        case ".off":
            return re.sub(rb"(?m)^%b %b %b$" % (NUMBER, NUMBER, NUMBER), b"", contents)
        case ".glb":
            return glb_without_positions(contents)
        case ".3mf":
            with zipfile.ZipFile(io.BytesIO(contents)) as archive:
                parts = {name: archive.read(name) for name in archive.namelist()}
            return {name: re.sub(rb'([xyz])="%b"' % NUMBER, rb"\1", text) for name, text in parts.items()}
    raise ValueError(path)


def glb_without_positions(contents: bytes) -> object:
    length = struct.unpack_from("<I", contents, 12)[0]
    document = json.loads(contents[20 : 20 + length])
    binary = bytearray(contents[28 + length :])
    for mesh in document["meshes"]:
        accessor = document["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]
        del accessor["min"], accessor["max"]
        begin = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
        binary[begin : begin + 12 * accessor["count"]] = bytes(12 * accessor["count"])
    return document, bytes(binary)


def test_weld_keeps_the_order_and_tells_signs_of_zero_not_apart() -> None:
    points, number = weld(np.array([[1, 0, 0], [0, 0, 2], [1, -0.0, 0], [0, 0, 2.5]]))
    assert points.tolist() == [[1, 0, 0], [0, 0, 2], [0, 0, 2.5]]
    assert number.tolist() == [0, 1, 0, 2]


def test_one_mesh_in_two_places_is_read_and_not_written(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    for x in (0, 100):
        place = trimesh.transformations.translation_matrix([x, 0, 0])
        scene.add_geometry(trimesh.Trimesh(POINTS, FACES), geom_name=f"{x}", transform=place)
    for suffix in ("glb", "3mf"):
        (tmp_path / f"two.{suffix}").write_bytes(scene.export(file_type=suffix))
    length = struct.unpack_from("<I", (tmp_path / "two.glb").read_bytes(), 12)[0]
    contents = (tmp_path / "two.glb").read_bytes()
    document = json.loads(contents[20 : 20 + length])
    for node in document["nodes"]:
        if "mesh" in node:
            node["mesh"] = 0
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    rest = contents[20 + length :]
    (tmp_path / "two.glb").write_bytes(
        struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest
    )
    shape = read_body(tmp_path / "two.glb")
    assert len(shape.faces) == 2 * len(FACES)
    with pytest.raises(meshmark.FormatError, match="several places"):
        shape.write(tmp_path / "out.glb", shape.points, shape.skin)


def test_what_the_host_misreads_is_refused(tmp_path: Path) -> None:
    make_ply(tmp_path / "big-endian.ply", ">")
    with pytest.raises(meshmark.FormatError, match="Save it anew"):
        read_body(tmp_path / "big-endian.ply")


@pytest.mark.parametrize("kind", MAKERS)
def test_a_broken_file_is_read_or_refused(tmp_path: Path, kind: str) -> None:
    path = made(kind, tmp_path)
    whole = path.read_bytes()
    for part in (0, 3, 60, len(whole) // 2):
        path.write_bytes(whole[:part])
        with suppress(meshmark.FormatError):  # half of a text file may be whole in itself
            read_body(path)
