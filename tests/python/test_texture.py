# SPDX-License-Identifier: GPL-3.0-or-later
"""A textured mesh through both doors: the picture stays where it was, and the seams stay closed."""

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
    lines += ["vt {:.6f} {:.6f}".format(*point) for point in shown(points)]
    lines += ["f " + " ".join(f"{v}/{v}" for v in face) for face in faces + 1]
    (folder / "textured.obj").write_text("\n".join(lines) + "\n")
    (folder / "skin.mtl").write_text("newmtl skin\nmap_Kd skin.png\n")
    imsave(folder / "skin.png", np.full((8, 8, 3), 0.5))
    return folder / "textured.obj"


def shown(points: np.ndarray) -> np.ndarray:
    """The texture coordinates of places: looked at along z."""
    return points[:, :2] / 8 + 0.5


def read(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[str]]:
    """Positions, faces, texture coordinates, names of textures."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    mesh.compact()
    return mesh.vertex_matrix(), mesh.face_matrix(), mesh.wedge_tex_coord_matrix(), list(mesh.textures())


@pytest.mark.usefixtures("display")
@pytest.mark.parametrize("name", DOORS)
def test_the_picture_stays_where_it_was_and_its_seams_stay_closed(tmp_path: Path, name: str) -> None:
    door = PyMeshLab()
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(write_textured(tmp_path)))
    plain, marked = tmp_path / "plain.ply", tmp_path / "marked.ply"
    meshes.save_current_mesh(str(plain), save_wedge_texcoord=True)
    values: dict[str, Value] = {"Message": "ab", "Bits": 16, "Key": "correct horse", "Method": "L-M"}
    if name == "pymeshlab":
        door.apply(meshes, EMBED, **values)
        meshes.save_current_mesh(str(marked), save_wedge_texcoord=True)
    else:
        (tmp_path / "embed.mlx").write_text(script(EMBED, values))
        done = MeshLabServer().arguments("-i", plain, "-s", tmp_path / "embed.mlx", "-o", marked, "-m", "wt")
        assert done.returncode == 0, done.stdout

    old, faces, _, names = read(plain)
    new, same_faces, texture, same_names = read(marked)
    np.testing.assert_array_equal(same_faces, faces)
    assert same_names == names
    assert len(names) == 1
    slid = np.abs(shown(new) - shown(old))[faces.ravel()].mean()
    off = np.abs(texture - shown(new)[faces.ravel()]).mean()
    assert off < 0.2 * slid
    assert (old != new).any(axis=1).mean() > 0.3
    assert len(np.unique(new, axis=0)) == len(np.unique(old, axis=0)) < len(old)
