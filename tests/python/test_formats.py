# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of every kind: what is read is what another library reads, and writing changes positions and nothing else."""

import io
import itertools
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
from hostile_files import HOSTILE, glb_of
from meshmark.formats import read_body, weld

Maker = Callable[[Path], None]
OTHER_CHUNK = struct.pack("<I4s8s", 8, b"XTRA", b"kept too")


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
    """As nobody would write it, with normals that are no numbers."""
    lines = ["solid a name"]
    for triangle in POINTS[FACES]:
        lines += ["  facet NORMAL 1.#QNAN  0 1 ", "\touter loop"]
        lines += ["      VERTEX  {:.6f} {:.6f}\t{:.6f} ".format(*corner) for corner in triangle]
        lines += ["    endloop", "  endfacet"]
    path.write_text("\r\n".join([*lines, "endsolid a name", ""]), newline="")


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
    """With Windows' ends of lines, and MeshLab's blanks before these."""
    lines = [f"ply\nformat ascii 1.0\nelement vertex {len(POINTS)}\nproperty float x\nproperty float y",
             f"property float z\nproperty uchar red\nelement face {len(FACES)}",
             "property list uchar int vertex_indices\nend_header"]  # fmt: skip
    lines += ["{:.7f}  {:.7f} {:.7f} {} ".format(*point, n) for n, point in enumerate(POINTS)]
    lines += ["3 {} {} {} ".format(*face) for face in FACES]
    path.write_text("\r\n".join("\n".join(lines).split("\n")) + "\r\n", newline="")


def make_obj(path: Path) -> None:
    lines = ["# kept", "mtllib skin.mtl", "o thing"]
    lines += ["v  {:.7f} {:.7f}\t{:.7f} 0.5 0.25 1 ".format(*point) for point in POINTS]
    lines += [f"vt {n / len(POINTS):.6f} {n % 7 / 7:.6f}" for n in range(len(POINTS))]
    lines += ["vn 0 0 1", "g first", "usemtl skin"]
    lines += ["f {0}/{0}/1 {1}/{1}/1 {2}/{2}/1".format(*face) for face in FACES[:100] + 1]
    lines += ["usemtl other"] + ["f {} {} {}".format(*face) for face in FACES[100:] + 1]
    path.write_text("\n".join(lines) + "\n")


def make_off(path: Path) -> None:
    lines = ["OFF", "# kept", f"{len(POINTS)} {len(FACES)} 0", ""]
    lines += ["{:.7f}  {:.7f} {:.7f} ".format(*point) for point in POINTS]
    lines += ["3 {} {} {} 255 0 0".format(*face) for face in FACES]
    path.write_text("\n".join(lines) + "\n")


def make_glb(path: Path) -> None:
    """Two nodes below one that turns and stretches; texture coordinates, extras, another chunk, a JSON for people."""
    scene = trimesh.Scene()
    turn = trimesh.transformations.rotation_matrix(0.7, [1, 2, 3], [4, 5, 6]) @ np.diag([2, 2, 3, 1])
    uv = np.stack([np.arange(len(POINTS)) / len(POINTS)] * 2, axis=1)
    for name, place in (("one", np.eye(4)), ("second", trimesh.transformations.translation_matrix([100, 0, 0]))):
        mesh = trimesh.Trimesh(POINTS * (1 + len(name)), FACES, process=False)
        mesh.visual = trimesh.visual.TextureVisuals(uv=uv)
        scene.add_geometry(mesh, node_name=name, geom_name=name, transform=turn @ place)
    scene.metadata["shop"] = "kept"
    contents = scene.export(file_type="glb")
    text = json.dumps(glb_document(contents), indent=1).encode()
    rest = contents[20 + struct.unpack_from("<I", contents, 12)[0] :] + OTHER_CHUNK
    path.write_bytes(glb_of(text + b" " * (-len(text) % 4), rest))


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
        archive.comment = b"kept"


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
    out.write_bytes(shape.written(moved, shape.skin))
    again = read_body(out)
    np.testing.assert_allclose(again.points[again.faces], moved[shape.faces], rtol=1e-6, atol=1e-5)
    np.testing.assert_allclose(in_order(moved[shape.faces]), read_by_trimesh(out), rtol=1e-5, atol=1e-4)


def in_pieces(contents: bytes, kind: str) -> list[bytes]:
    """All of a file, so that each number that may change is a piece of its own."""
    match kind:
        case "binary STL":
            return cut(contents, [84] + [12, 12, 12, 12, 2] * len(FACES))
        case "PLY":
            return cut(contents, [contents.index(b"end_header\n") + 11] + [1, 8, 8, 8, 4] * len(POINTS))
        case "GLB":
            length = struct.unpack_from("<I", contents, 12)[0]
            binary = contents[20 + length :]
            return [contents[:20], *in_words(contents[20 : 20 + length]), *cut(binary, [4] * (len(binary) // 4))]
        case "3MF":
            with zipfile.ZipFile(io.BytesIO(contents)) as archive:
                entries = [(entry, archive.read(entry)) for entry in archive.infolist()]
                pieces = [archive.comment]
            for entry, text in entries:
                pieces += [f"{entry.filename} {entry.date_time} {entry.external_attr:o}".encode(), *in_words(text)]
            return pieces
    return in_words(contents)


def cut(contents: bytes, lengths: list[int]) -> list[bytes]:
    ends = np.cumsum([0, *lengths]).tolist()
    return [contents[begin:end] for begin, end in itertools.pairwise([*ends, len(contents)])]


def in_words(text: bytes) -> list[bytes]:
    return re.split(rb"([\s\"',:\[\]]+)", text)


@pytest.mark.parametrize("kind", MAKERS)
def test_what_has_not_moved_is_byte_for_byte_what_it_was(tmp_path: Path, kind: str) -> None:
    """Of an entry in a 3MF that is its text."""
    path = made(kind, tmp_path)
    shape = read_body(path)
    own = in_pieces(path.read_bytes(), kind)
    assert in_pieces(shape.written(shape.points + 0.0, shape.skin), kind) == own  # MeshLab makes 0 of -0
    inmost = int(np.abs(shape.points - shape.points.mean(axis=0)).max(axis=1).argmin())  # no bound of anything
    moved = shape.points.copy()
    moved[inmost] += [0.25, 0.5, 0.75]
    new = in_pieces(shape.written(moved, shape.skin), kind)
    changed = sum(a != b for a, b in zip(own, new, strict=True))
    facets = int((shape.faces == inmost).any(axis=1).sum())
    assert changed == {"binary STL": 2 * facets, "ASCII STL": 6 * facets}.get(kind, 3)


def test_bounds_of_a_glb_follow_and_nothing_else_in_its_json(tmp_path: Path) -> None:
    make_glb(tmp_path / "a.glb")
    shape = read_body(tmp_path / "a.glb")
    contents = (tmp_path / "a.glb").read_bytes()
    document = glb_document(contents)
    accessor = document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
    turn = np.reshape(document["nodes"][1]["matrix"], (4, 4)).T[:3, :3]
    highest = int((shape.points[: len(POINTS)] @ np.linalg.inv(turn).T)[:, 2].argmax())
    moved = shape.points.copy()
    moved[highest] += turn @ [0, 0, 1.5]
    (tmp_path / "b.glb").write_bytes(shape.written(moved, shape.skin))
    new = (tmp_path / "b.glb").read_bytes()
    assert struct.unpack_from("<I", new, 8)[0] == len(new)
    assert len(new) % 4 == 0
    document["accessors"][accessor]["max"][2] = float(np.float32(document["accessors"][accessor]["max"][2] + 1.5))
    assert glb_document(new) == document
    words, new_words = (in_words(of[20 : 20 + struct.unpack_from("<I", of, 12)[0]].rstrip()) for of in (contents, new))
    assert sum(a != b for a, b in zip(words, new_words, strict=True)) == 1
    assert new.endswith(OTHER_CHUNK)


def glb_document(contents: bytes) -> dict:
    return json.loads(contents[20 : 20 + struct.unpack_from("<I", contents, 12)[0]])


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
    contents = (tmp_path / "two.glb").read_bytes()
    document = glb_document(contents)
    for node in document["nodes"]:
        if "mesh" in node:
            node["mesh"] = 0
    text = json.dumps(document).encode()
    rest = contents[20 + struct.unpack_from("<I", contents, 12)[0] :]
    (tmp_path / "two.glb").write_bytes(glb_of(text + b" " * (-len(text) % 4), rest))
    shape = read_body(tmp_path / "two.glb")
    assert len(shape.faces) == 2 * len(FACES)
    with pytest.raises(meshmark.FormatError, match="several places"):
        shape.written(shape.points, shape.skin)


def test_an_off_file_may_have_polygons_colours_and_blank_lines(tmp_path: Path) -> None:
    """MeshLab 2025.07 takes the first five vertices for any pentagon's, and dies of the others."""
    points = [[9, 9, 9], [0, 0, 0], [2, 0, 0], [3, 2, 0], [1, 3, 0], [-1, 2, 0]]
    text = ["OFF", "6 2 0", *("{} {} {}".format(*point) for point in points), "  ", " 5 1 2 3 4 5 7", "3 0 1 2 7"]
    (tmp_path / "a.off").write_text("\n".join(text) + "\n")
    shape = read_body(tmp_path / "a.off")
    corners = shape.points[shape.faces[:-1]]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(axis=0)) / 2
    ring = np.array(points)[1:, :2]
    assert area == pytest.approx(abs(np.linalg.det(np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)).sum()) / 2)
    assert shape.faces[-1].tolist() == [0, 1, 2]


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


@pytest.mark.parametrize("fault", HOSTILE)
def test_a_hostile_file_is_refused(tmp_path: Path, fault: str) -> None:
    ending, contents = HOSTILE[fault]
    path = tmp_path / f"a.{ending}"
    path.write_bytes(contents())
    with pytest.raises(meshmark.FormatError):
        read_body(path)


def test_what_a_matrix_flattens_is_not_written(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.Trimesh(POINTS, FACES), transform=np.diag([1, 1, 0, 1]))
    (tmp_path / "flat.glb").write_bytes(scene.export(file_type="glb"))
    shape = read_body(tmp_path / "flat.glb")
    with pytest.raises(meshmark.FormatError, match="flattens"):
        shape.written(shape.points + 1, shape.skin)
