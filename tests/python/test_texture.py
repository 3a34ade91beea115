# SPDX-License-Identifier: GPL-3.0-or-later
"""A textured mesh through both doors: the texture stays, and the seams stay closed."""

from pathlib import Path

import numpy as np
import pymeshlab
import pytest
from bad_meshes import BAD_MESHES
from doors import DOORS, EMBED, MeshLabServer, PyMeshLab, Value, script
from matplotlib.image import imsave


def write_textured(folder: Path) -> Path:
    """A body with a texture; the vertices along its many seams are there twice."""
    points, faces = BAD_MESHES["duplicate vertices"]()
    lines = ["mtllib skin.mtl", "usemtl skin"]
    lines += ["v {:.6f} {:.6f} {:.6f}".format(*point) for point in points]
    lines += [f"vt {number / len(points):.6f} {number % 7 / 7:.6f}" for number in range(len(points))]
    lines += ["f " + " ".join(f"{v}/{v}" for v in face) for face in faces + 1]
    (folder / "textured.obj").write_text("\n".join(lines) + "\n")
    (folder / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
    imsave(folder / "skin.png", np.full((8, 8, 3), 0.5))
    return folder / "textured.obj"


def read(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[str]]:
    """Positions, faces, texture coordinates, names of textures."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    mesh.compact()
    return mesh.vertex_matrix(), mesh.face_matrix(), mesh.wedge_tex_coord_matrix(), list(mesh.textures())


@pytest.mark.usefixtures("display")
@pytest.mark.parametrize("name", DOORS)
def test_a_textured_mesh_keeps_its_texture_and_its_seams_stay_closed(tmp_path: Path, name: str) -> None:
    door = PyMeshLab()
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(write_textured(tmp_path)))
    plain, marked = tmp_path / "plain.ply", tmp_path / "marked.ply"
    meshes.save_current_mesh(str(plain), save_wedge_texcoord=True)
    values: dict[str, Value] = {"Message": "ab", "Bits": 16, "Key": "correct horse"}
    if name == "pymeshlab":
        door.apply(meshes, EMBED, **values)
        meshes.save_current_mesh(str(marked), save_wedge_texcoord=True)
    else:
        (tmp_path / "embed.mlx").write_text(script(EMBED, values))
        done = MeshLabServer().arguments("-i", plain, "-s", tmp_path / "embed.mlx", "-o", marked, "-m", "wt")
        assert done.returncode == 0, done.stdout

    old, *before = read(plain)
    new, *after = read(marked)
    for was, stays in zip(before, after, strict=True):
        np.testing.assert_array_equal(stays, was)
    assert len(before[-1]) == 1
    assert (old != new).any(axis=1).mean() > 0.3
    assert len(np.unique(new, axis=0)) == len(np.unique(old, axis=0)) < len(old)
