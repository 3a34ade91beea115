# SPDX-License-Identifier: GPL-3.0-or-later
"""Files with textures and colours, marked by meshmark: what they show slides with the plugin's own mesh, seams stay
closed, and all else is what it was.
"""

import json
import struct
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import meshmark
import numpy as np
import pymeshlab
import pytest
import trimesh
from bodies import body
from doors import EMBED, PyMeshLab
from matplotlib.image import imsave
from meshmark.formats import read_body
from meshmark.formats.corners import corners_of, shared
from PIL import Image

KEY = "correct horse"
MARK = {"message": "id:5", "key": KEY, "method": "L-M"}
CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
MATERIAL = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"


@dataclass(frozen=True)
class Textured:
    """Two halves, each with a map of its own on one picture; the seam between them is a loop."""

    points: np.ndarray
    faces: np.ndarray
    left: np.ndarray  # per face

    def texture(self, coarse: bool = False) -> np.ndarray:
        """Of the corners. Coarse: rounded so far that many vertices share their coordinates."""
        places = self.points[:, 1:][self.faces] / 160 + 0.5
        both = np.where(self.left[:, None, None], places * [0.4, 0.9], [0.95, 0.95] - places * [0.4, 0.9])
        return np.round(both, 2 if coarse else 6)

    def colors(self) -> np.ndarray:
        """Of the vertices, 8 bits each."""
        return np.round(127.5 + 127.5 * np.sin(self.points / 3)).astype(np.uint8)


@pytest.fixture(scope="module")
def thing() -> Textured:
    ball = body(3)
    points, faces = np.round(ball.vertices, 4), ball.faces.astype(np.int32)
    return Textured(points, faces, points[faces].mean(axis=1)[:, 0] < 0)


def lines(form: str, rows: np.ndarray) -> list[str]:
    return [form.format(*row) for row in rows.tolist()]


def write_obj(path: Path, thing: Textured, texture: np.ndarray) -> None:
    """Each pair of coordinates once; the halves are two groups with their coordinates before them."""
    text = ["mtllib skin.mtl", *lines("v {:.4f} {:.4f} {:.4f}", thing.points)]
    before = 0
    for name, half in (("left", thing.left), ("right", ~thing.left)):
        table, place = np.unique(texture[half].reshape(-1, 2), axis=0, return_inverse=True)
        corners = np.stack([thing.faces[half] + 1, place.reshape(-1, 3) + 1 + before], axis=2).reshape(-1, 6)
        text += [f"g {name}", *lines("vt {:.6f} {:.6f} 0.25", table), "usemtl skin"]
        text += lines("f {}/{} {}/{} {}/{}", corners)
        before += len(table)
    path.write_text("\n".join(text) + "\n")
    (path.parent / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
    imsave(path.parent / "skin.png", np.full((8, 8, 3), 0.5))


def write_ply(path: Path, thing: Textured, texture: np.ndarray, ascii_: bool = False) -> None:
    """Coordinates of corners, as MeshLab writes them, between properties that nobody knows."""
    kind = "ascii" if ascii_ else "binary_little_endian"
    header = (
        f"ply\nformat {kind} 1.0\nelement vertex {len(thing.points)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(thing.faces)}\nproperty list uchar int vertex_indices\n"
        "property uchar odd_one\nproperty list uchar float texcoord\nend_header\n"
    )
    rows = np.zeros(len(thing.faces), [("n", "u1"), ("f", "<i4", 3), ("odd", "u1"), ("m", "u1"), ("uv", "<f4", 6)])
    rows["n"], rows["m"], rows["odd"] = 3, 6, np.arange(len(rows)) % 200
    rows["f"], rows["uv"] = thing.faces, texture.reshape(-1, 6)
    if ascii_:
        text = lines("{:.4f} {:.4f} {:.4f}", thing.points)
        text += [" ".join(map(str, [3, *row["f"], row["odd"], 6, *row["uv"]])) for row in rows]
        path.write_text(header + "\n".join(text) + "\n")
    else:
        path.write_bytes(header.encode() + thing.points.astype("<f4").tobytes() + rows.tobytes())


def apart(thing: Textured, texture: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, texture and faces of a mesh whose vertices are twice where they show two things."""
    rows = np.column_stack([thing.faces.ravel(), texture.reshape(-1, 2)])
    rows, number = np.unique(rows, axis=0, return_inverse=True)
    return thing.points[rows[:, 0].astype(int)], rows[:, 1:], number.reshape(-1, 3)


def write_vertex_ply(path: Path, thing: Textured, texture: np.ndarray) -> None:
    points, uv, faces = apart(thing, texture)
    text = ["ply", "format ascii 1.0", f"element vertex {len(points)}", *(f"property float {name}" for name in "xyzst")]
    text += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    text += lines("{:.4f} {:.4f} {:.4f} {:.6f} {:.6f}", np.column_stack([points, uv]))
    path.write_text("\n".join(text + lines("3 {} {} {}", faces)) + "\n")


def write_glb(path: Path, thing: Textured, texture: np.ndarray) -> None:
    points, uv, faces = apart(thing, texture)
    mesh = trimesh.Trimesh(points, faces, process=False)
    imsave(path.parent / "skin.png", np.full((8, 8, 3), 0.5))
    image = trimesh.visual.texture.SimpleMaterial(image=Image.open(path.parent / "skin.png"))
    mesh.visual = trimesh.visual.TextureVisuals(uv=uv * [1, -1] + [0, 1], material=image)
    mesh.export(path)


def write_3mf(path: Path, thing: Textured, texture: np.ndarray) -> None:
    """A group of coordinates, each pair once."""
    table, place = np.unique(texture.reshape(-1, 2), axis=0, return_inverse=True)
    corners = np.column_stack([thing.faces, place.reshape(-1, 3)])
    model = (
        f'<model unit="millimeter" xmlns="{CORE[1:-1]}" xmlns:m="{MATERIAL[1:-1]}"><resources>'
        '<m:texture2d id="2" path="/3D/skin.png" contenttype="image/png"/><m:texture2dgroup id="3" texid="2">'
        + "".join(lines('<m:tex2coord u="{:.6f}" v="{:.6f}"/>', table))
        + '</m:texture2dgroup><object id="1" type="model"><mesh><vertices>'
        + "".join(lines('<vertex x="{:.4f}" y="{:.4f}" z="{:.4f}"/>', thing.points))
        + "</vertices><triangles>"
        + "".join(lines('<triangle v1="{}" v2="{}" v3="{}" pid="3" p1="{}" p2="{}" p3="{}"/>', corners))
        + '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>'
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(
            "_rels/.rels",
            '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r" '
            'Target="/3D/a.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
        )
        archive.writestr("3D/a.model", model)
        archive.writestr("3D/skin.png", b"a picture")


def shown_by_pymeshlab(path: Path) -> np.ndarray:
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    if mesh.has_wedge_tex_coord():
        return mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    return mesh.vertex_tex_coord_matrix()[mesh.face_matrix()]


def shown_by_trimesh(path: Path) -> np.ndarray:
    mesh = trimesh.load_mesh(path, process=False)
    return (mesh.visual.uv * [1, -1] + [0, 1])[mesh.faces]


def shown_in_3mf(path: Path) -> np.ndarray:
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("3D/a.model"))
    table = np.array([[float(one.get(name)) for name in "uv"] for one in root.iter(f"{MATERIAL}tex2coord")])
    return table[[[int(one.get(p)) for p in ("p1", "p2", "p3")] for one in root.iter(f"{CORE}triangle")]]


Writer = Callable[[Path, Textured, np.ndarray], None]
Reader = Callable[[Path], np.ndarray]
KINDS: dict[str, tuple[str, Writer, Reader]] = {
    "OBJ": ("a.obj", write_obj, shown_by_pymeshlab),
    "PLY": ("b.ply", write_ply, shown_by_pymeshlab),
    "ASCII PLY": ("c.ply", lambda path, thing, texture: write_ply(path, thing, texture, True), shown_by_pymeshlab),
    "PLY of vertices": ("d.ply", write_vertex_ply, shown_by_pymeshlab),
    "GLB": ("e.glb", write_glb, shown_by_trimesh),
    "3MF": ("f.3mf", write_3mf, shown_in_3mf),
}


def by_the_plugin(
    thing: Textured, texture: np.ndarray | None = None, colors: np.ndarray | None = None
) -> pymeshlab.MeshSet:
    """The plugin's own mesh, as the current layer."""
    values = {}
    if texture is not None:
        values["w_tex_coords_matrix"] = texture.reshape(-1, 2)
    if colors is not None:
        values["v_color_matrix"] = np.column_stack([colors / 255, np.ones(len(colors))])
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(thing.points, thing.faces, **values))
    PyMeshLab().apply(meshes, EMBED, Message="id:5", Key=KEY, Method="L-M")
    return meshes


Marked = Callable[[str, bool], tuple[Path, Path]]


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory, thing: Textured) -> Marked:
    """A file of a kind, and the same marked."""

    @cache
    def make(kind: str, coarse: bool = False) -> tuple[Path, Path]:
        name, write, _ = KINDS[kind]
        folder = tmp_path_factory.mktemp("marked")
        write(folder / name, thing, thing.texture(coarse))
        meshmark.embed(folder / name, folder / f"out-{name}", **MARK)
        return folder / name, folder / f"out-{name}"

    return make


def in_order_of(kind: str, thing: Textured) -> Textured:
    """Faces as the file has them: in OBJ one half before the other."""
    order = np.argsort(~thing.left, kind="stable") if kind == "OBJ" else np.arange(len(thing.left))
    return Textured(thing.points, thing.faces[order], thing.left[order])


@pytest.mark.parametrize(("kind", "coarse"), [*((kind, False) for kind in KINDS), ("OBJ", True), ("3MF", True)])
def test_the_texture_of_the_file_is_that_of_the_plugins_mesh(
    marked: Marked, thing: Textured, kind: str, coarse: bool
) -> None:
    shown = KINDS[kind][2]
    thing = in_order_of(kind, thing)
    texture = thing.texture(coarse)
    before, after = marked(kind, coarse)
    np.testing.assert_allclose(shown(before), texture, atol=1e-6)
    plugin = by_the_plugin(thing, texture)
    expected = plugin.current_mesh().wedge_tex_coord_matrix().reshape(-1, 3, 2)
    assert (np.abs(expected - texture).max(axis=2) > 1e-4).mean() > 0.3
    np.testing.assert_allclose(shown(after), expected, atol=2e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_seams_are_closed_and_the_picture_is_where_it_was(marked: Marked, thing: Textured, kind: str) -> None:
    """Each half shows its y and z, so on the seam both must tell of one place, and elsewhere of nearly their own."""
    thing = in_order_of(kind, thing)
    out = read_body(marked(kind, False)[1])
    uv, left = out.skin.texture, thing.left
    told = (np.where(left[:, None, None], uv, [0.95, 0.95] - uv) / [0.4, 0.9] - 0.5) * 160
    seam = np.intersect1d(thing.faces[left], thing.faces[~left])
    assert len(seam) > 20
    of_left, of_right = np.zeros((2, len(thing.points), 2))
    of_left[thing.faces[left]], of_right[thing.faces[~left]] = told[left], told[~left]
    np.testing.assert_allclose(of_left[seam], of_right[seam], atol=2e-3)
    now = out.points[out.faces]
    slid = np.linalg.norm(now - thing.points[thing.faces], axis=2)
    off = np.linalg.norm(told - now[..., 1:], axis=2)
    inside = ~np.isin(thing.faces, seam)
    assert off[inside].mean() < 0.2 * slid[inside].mean()


def test_picture_and_material_are_kept(marked: Marked) -> None:
    glb, package, obj = (marked(kind, False) for kind in ("GLB", "3MF", "OBJ"))
    images = [trimesh.load_mesh(path, process=False).visual.material.baseColorTexture for path in glb]
    np.testing.assert_array_equal(*map(np.asarray, images))
    old, new = (glb_document(path.read_bytes()) for path in glb)
    assert old == new
    with zipfile.ZipFile(package[1]) as archive:
        assert archive.read("3D/skin.png") == b"a picture"
    old, new = (path.read_text().splitlines() for path in obj)
    assert [line for line in old if line[0] != "v"] == [line for line in new if line[0] != "v"]
    assert all(line.endswith(" 0.25") for line in new if line.startswith("vt "))


def glb_document(contents: bytes) -> dict:
    """All of it but the bounds of positions and texture coordinates."""
    document = json.loads(contents[20 : 20 + struct.unpack_from("<I", contents, 12)[0]])
    for accessor in document["accessors"]:
        accessor.pop("min", None), accessor.pop("max", None)
    return document


def write_colored(path: Path, thing: Textured) -> None:
    colors = thing.colors()
    rows = np.column_stack([thing.points, colors])
    text: list[str] = []
    match path.suffix:
        case ".off":
            text = ["COFF", f"{len(rows)} {len(thing.faces)} 0"]
            text += lines("{:.4f} {:.4f} {:.4f} {:.0f} {:.0f} {:.0f} 255", rows) + lines("3 {} {} {}", thing.faces)
        case ".obj":
            scaled = np.column_stack([thing.points, colors / 255])
            text = lines("v {:.4f} {:.4f} {:.4f} {:.6f} {:.6f} {:.6f}", scaled)
            text += lines("f {} {} {}", thing.faces + 1)
        case ".ply":
            text = ["ply", "format ascii 1.0", f"element vertex {len(rows)}", *(f"property float {x}" for x in "xyz")]
            text += [
                *(f"property uchar {name}" for name in ("red", "green", "blue")),
                f"element face {len(thing.faces)}",
            ]
            text += ["property list uchar int vertex_indices", "end_header"]
            text += lines("{:.4f} {:.4f} {:.4f} {:.0f} {:.0f} {:.0f}", rows) + lines("3 {} {} {}", thing.faces)
        case ".glb":
            trimesh.Trimesh(thing.points, thing.faces, vertex_colors=colors, process=False).export(path)
            return
    path.write_text("\n".join(text) + "\n")


@pytest.mark.parametrize("kind", ["off", "obj", "ply", "glb"])
def test_colours_of_vertices_are_those_of_the_plugins_mesh(tmp_path: Path, thing: Textured, kind: str) -> None:
    write_colored(tmp_path / f"a.{kind}", thing)
    meshmark.embed(tmp_path / f"a.{kind}", tmp_path / f"b.{kind}", **MARK)
    plugin = by_the_plugin(thing, colors=thing.colors())
    expected = plugin.current_mesh().vertex_color_matrix()[:, :3] * 255
    if kind == "obj":  # the host rounds down what it reads
        found = np.loadtxt(tmp_path / "b.obj", usecols=(4, 5, 6), max_rows=len(thing.points)) * 255
    elif kind == "glb":
        found = trimesh.load_mesh(tmp_path / "b.glb", process=False).visual.vertex_colors[:, :3]
    else:
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(tmp_path / f"b.{kind}"))
        found = meshes.current_mesh().vertex_color_matrix()[:, :3] * 255
    assert (expected.round() != thing.colors()).any(axis=1).mean() > 0.3
    np.testing.assert_array_equal(np.round(found), expected.round())


def test_corners_that_shared_a_place_get_their_own() -> None:
    table = np.array([[0.0, 0], [1, 1], [2, 2]])
    index = np.array([0, 1, 1, 1, 2])
    new = np.array([[0.5, 0], [1, 1], [3, 3], [3, 3], [2, 2]])
    values, place = shared(index, table, new)
    np.testing.assert_array_equal(values[place], new)
    assert values.tolist() == [[0.5, 0], [1, 1], [2, 2], [3, 3]]


def test_polygons_show_at_their_corners_what_the_file_says(tmp_path: Path) -> None:
    """A prism on a pentagon, whichever way MeshLab cuts it up. (Of PLY it reads no polygons with texture.)"""
    turn = np.arange(5) * 2 * np.pi / 5
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = np.vstack([np.column_stack([ring, np.full(5, z)]) for z in (0, 1)]).round(6)
    faces = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], *([k, (k + 1) % 5, 5 + (k + 1) % 5, 5 + k] for k in range(5))]
    text = lines("v {} {} {}", points) + lines("vt {} {}", points[::-1, :2])
    text += ["f " + " ".join(f"{v + 1}/{10 - v}/{v - 10}" for v in face) for face in faces]
    (tmp_path / "a.obj").write_text("\n".join(text) + "\n")
    found = read_body(tmp_path / "a.obj")
    assert len(found.faces) == 2 * 3 + 5 * 2
    np.testing.assert_allclose(found.skin.texture, found.points[found.faces][..., :2], atol=1e-6)


def test_corners_of_polygons_are_found_along_any_diagonal() -> None:
    triangles = np.array([[1, 2, 3], [3, 0, 1], [4, 5, 6]])
    assert corners_of([[0, 1, 2, 3], [7, 7, 8], [4, 5, 6]], triangles).tolist() == [[1, 2, 3], [3, 0, 1], [7, 8, 9]]
    with pytest.raises(ValueError, match="polygons"):
        corners_of([[0, 1, 2]], triangles)
