"""A textured mesh through both doors: the texture stays, and the seams stay closed."""

import re
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


def positions(obj: Path) -> np.ndarray:
    return np.array([line.split()[1:4] for line in obj.read_text().splitlines() if line.startswith("v ")], dtype=float)


@pytest.mark.usefixtures("display")
@pytest.mark.parametrize("name", DOORS)
def test_a_textured_mesh_keeps_its_texture_and_its_seams_stay_closed(tmp_path: Path, name: str) -> None:
    textured = write_textured(tmp_path)
    plain, marked = tmp_path / "plain.obj", tmp_path / "marked.obj"
    values: dict[str, Value] = {"Message": "ab", "Bits": 16, "Key": "correct horse"}
    if name == "pymeshlab":
        door = PyMeshLab()
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(textured))
        meshes.save_current_mesh(str(plain), save_wedge_texcoord=True)
        door.apply(meshes, EMBED, **values)
        meshes.save_current_mesh(str(marked), save_wedge_texcoord=True)
    else:
        (tmp_path / "embed.mlx").write_text(script(EMBED, values))
        for arguments in (["-o", plain, "-m", "wt"], ["-s", tmp_path / "embed.mlx", "-o", marked, "-m", "wt"]):
            done = MeshLabServer().arguments("-i", textured, *arguments)
            assert done.returncode == 0, done.stdout

    def rest(obj: Path) -> list[str]:
        return [line for line in obj.read_text().splitlines() if re.match(r"(vt|f|usemtl) ", line)]

    assert len(rest(plain)) > 2 * len(BAD_MESHES["duplicate vertices"]()[1])
    assert any(line.startswith("usemtl") for line in rest(plain))
    assert rest(marked) == rest(plain)
    before, after = positions(plain), positions(marked)
    assert (before != after).any(axis=1).mean() > 0.3
    assert len(np.unique(after, axis=0)) == len(np.unique(before, axis=0)) == len(before) // 2
