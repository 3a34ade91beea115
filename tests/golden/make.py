# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the golden marks anew: marked meshes of our own, and what detection must read from them.

They pin the format of a mark. Tests read them through the library and through both hosts; so run this only where the
format is meant to change, and say so in the commit. Needs the plugin for pymeshlab, and takes some seconds:

    build/venv/bin/python tests/golden/make.py

What another key reads in them is chance, and changes where a reader looks further than before. `--stranger` writes down
that alone anew, from the marks as they are.
"""

import json
import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import pymeshlab
import typer

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bad_meshes import Mesh, write_ply
from doors import DETECT, EMBED, METHODS, STATISTICS, WITHOUT_STATISTIC, PyMeshLab, Report, Value

HERE = Path(__file__).resolve().parent
KEY = "golden key"
STRANGER = "another key"
MESSAGE = "mark"
BITS = 32
ONE_STATISTIC = set(WITHOUT_STATISTIC)
FREQUENCY = 12  # 10 * 12^2 + 2 = 1,442 vertices; 55 kB a mesh
MOST_BYTES = 1_000_000


def icosphere(frequency: int) -> Mesh:
    """The unit sphere: each face of an icosahedron cut into `frequency`^2 triangles."""
    g = (1 + np.sqrt(5)) / 2
    corners = np.array([(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
                        (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)])  # fmt: skip
    sides = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]  # fmt: skip
    number: dict[frozenset[tuple[int, int]], int] = {}  # of the point with these weights at these corners
    points: list[np.ndarray] = []

    def vertex(side: tuple[int, int, int], *weights: int) -> int:
        name = frozenset((corner, weight) for corner, weight in zip(side, weights, strict=True) if weight)
        if name not in number:
            number[name] = len(points)
            points.append(sum(weight * corners[corner] for corner, weight in sorted(name)))
        return number[name]

    faces = []
    for side in sides:
        for i in range(frequency):
            for j in range(frequency - i):
                k = frequency - i - j
                a, b, c = vertex(side, k, i, j), vertex(side, k - 1, i + 1, j), vertex(side, k - 1, i, j + 1)
                faces.append((a, b, c))
                if k > 1:
                    faces.append((b, vertex(side, k - 2, i + 1, j + 1), c))
    unit = np.array(points)
    return unit / np.linalg.norm(unit, axis=1, keepdims=True), np.array(faces, dtype=np.int32)


def body() -> Mesh:
    """A closed smooth body with some detail and no symmetry; its moments of second order are well apart."""
    unit, faces = icosphere(FREQUENCY)
    x, y, z = unit.T
    radius = 1 + 0.15 * x - 0.1 * y * z + 0.12 * y**3 + 0.08 * z**2 * x
    radius += 0.06 * np.sin(5 * x + 1) * np.cos(4 * y) + 0.03 * np.sin(7 * z - 3 * y + 2) + 0.02 * np.sin(9 * x + 4 * z)
    return unit * radius[:, None] * [2, 1.45, 1.1], faces


def reading(file: Path, key: str, settings: dict[str, Value]) -> Report:
    """What detection with this key reads from a file."""
    found = PyMeshLab().run(DETECT, file, Key=key, Expected=MESSAGE, **settings)
    return {"key": key, **{name: found[name] for name in ("bits", "soft", "p_value")}}


def make_mark(folder: Path, method: str, statistic: str) -> Report:
    """Marks the body, writes it, and returns its entry: how it was made, and what detection reads."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(*body()))
    settings: dict[str, Value] = {"Method": method, "Statistic": statistic, "Bits": BITS}
    PyMeshLab().apply(meshes, EMBED, Key=KEY, Message=MESSAGE, **settings)
    file = folder / f"{method}-{statistic}.ply".lower()
    write_ply(file, (meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()))
    readings = [reading(file, key, settings) for key in (KEY, STRANGER)]
    return {"file": file.name, "settings": settings, "message": MESSAGE, "readings": readings}


def make_marks(folder: Path) -> list[Report]:
    """All of them, and their entries."""
    return [
        make_mark(folder, method, statistic)
        for method in METHODS
        for statistic in (STATISTICS[:1] if method in ONE_STATISTIC else STATISTICS)
    ]


def read_by_stranger(folder: Path) -> list[Report]:
    """The marks' entries with what another key reads now."""
    marks = json.loads((folder / "golden.json").read_text(encoding="utf-8"))
    for mark in marks:
        mark["readings"][1] = reading(folder / mark["file"], STRANGER, mark["settings"])
    return marks


def main(
    folder: Annotated[Path, typer.Option(help="Where to write the marks and golden.json.")] = HERE,
    stranger: Annotated[bool, typer.Option("--stranger", help="Only what another key reads.")] = False,
) -> None:
    """Makes one mark for each method and statistic, and golden.json."""
    marks = read_by_stranger(folder) if stranger else make_marks(folder)
    for mark in marks:
        if mark["readings"][0]["p_value"] > 1e-8:  # 32 carriers cannot say much more
            raise SystemExit(f"{mark['file']} does not read back: choose another body or fewer bits.")
    (folder / "golden.json").write_text(json.dumps(marks, indent=1) + "\n", encoding="utf-8")
    size = sum(path.stat().st_size for path in folder.iterdir() if path.suffix in (".ply", ".json"))
    print(f"{len(marks)} marks, {size:,} bytes")
    if size > MOST_BYTES:
        raise SystemExit(f"The golden marks may take {MOST_BYTES:,} bytes.")


if __name__ == "__main__":
    typer.run(main)
