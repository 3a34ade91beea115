# SPDX-License-Identifier: GPL-3.0-or-later
"""Our MSDM beside MSDM2 of MEPP2, on distorted and marked meshes: a table, and the correlation of their ranks.

Needs the program msdm2, which is built by hand: msdm2.cpp says how.

    build/venv/bin/python tests/benchmark/msdm2/compare.py .../msdm2
"""

import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import pandas as pd
import pymeshlab
import typer
from meshmark import Refused, host, plugin
from scipy.stats import spearmanr
from tqdm import tqdm

ROOT = Path(__file__).resolve().parents[3]
ATTACKS: dict[str, dict[str, host.Value]] = {
    "noise .05 %": {"attack": "Noise", "amount": 0.0005},
    "noise .1 %": {"attack": "Noise", "amount": 0.001},
    "noise .3 %": {"attack": "Noise", "amount": 0.003},
    "smoothing .1 x 5": {"attack": "Smooth", "amount": 0.1, "iterations": 5},
    "smoothing .5 x 1": {"attack": "Smooth", "amount": 0.5, "iterations": 1},
    "smoothing .5 x 10": {"attack": "Smooth", "amount": 0.5, "iterations": 10},
    "Taubin": {"attack": "Taubin"},
    "quantization 10": {"attack": "Quantize", "amount": 10},
    "quantization 8": {"attack": "Quantize", "amount": 8},
    "simplification 50 %": {"attack": "Simplify", "amount": 0.5},
}
MARKS = ("Waves", "L-M", "QSP", "Cho", "Geodesic", "Spectral")


@dataclass(frozen=True)
class Row:
    mesh: str
    what: str
    file: Path
    mrms: float
    ours: float


def distorted(mesh: str, folder: Path) -> list[Row]:
    """The mesh, attacked and marked, each in a file, with what we measure."""
    original = folder / f"{mesh}.off"
    rows = []
    for what in tqdm([*ATTACKS, *MARKS], desc=mesh):
        with host.own_meshes() as meshes:
            for _ in range(2):
                host.read(meshes, ROOT / "build/data/meshes" / f"{mesh}.off")
            try:
                if what in ATTACKS:
                    host.apply(meshes, plugin.ATTACK, **{"iterations": -1, "seed": 1, **ATTACKS[what]})
                else:
                    host.apply(meshes, plugin.EMBED, message="id:1", key="msdm", method=what, bits=64)
            except Refused as error:
                tqdm.write(f"{mesh} {what}: {error}")
                continue
            found = host.apply(meshes, plugin.MEASURE, reference=0)
            number = len(rows)
            save(meshes, folder / f"{mesh}-{number}.off")
            meshes.set_current_mesh(0)
            save(meshes, original)
            rows.append(Row(mesh, what, folder / f"{mesh}-{number}.off", found["mrms_relative"], found["msdm"]))
    return rows


def save(meshes: pymeshlab.MeshSet, path: Path) -> None:
    """Positions and faces alone: CGAL's reader wants no more."""
    meshes.save_current_mesh(str(path), save_vertex_color=False, save_face_color=False)


def main(
    program: Annotated[Path, typer.Argument(help="msdm2, built as msdm2.cpp says")],
    mesh: Annotated[list[str], typer.Option(help="names of test meshes, closed ones")] = ["homer", "fandisk"],  # noqa: B006
) -> None:
    with tempfile.TemporaryDirectory(prefix="msdm2-") as name:
        folder = Path(name)
        rows = [row for name in mesh for row in distorted(name, folder)]
        theirs = {}
        for row in tqdm(rows, desc="MSDM2"):
            done = subprocess.run(
                [program, folder / f"{row.mesh}.off", row.file], capture_output=True, text=True, check=True, timeout=900
            )
            line = next(line for line in done.stdout.splitlines() if line.startswith("RESULT"))
            theirs[row] = [float(value) for value in line.split()[2:]]
    frame = pd.DataFrame(
        [(row.mesh, row.what, row.mrms * 1e4, row.ours, *theirs[row]) for row in rows],
        columns=["mesh", "distortion", "MRMS x 1e-4", "ours", "MSDM2", "MSDM2 back", "MSDM2 both"],
    )
    print("| " + " | ".join(frame.columns) + " |\n|" + "---|" * len(frame.columns))
    for row in frame.itertuples(index=False):
        print("| " + " | ".join(f"{cell:.3f}" if isinstance(cell, float) else cell for cell in row) + " |")
    print()
    for name, part in [("all", frame), *frame.groupby("mesh")]:
        for column in ("MSDM2", "MSDM2 both"):
            print(f"{name}: rank correlation of ours with {column} {spearmanr(part['ours'], part[column])[0]:.3f}")


if __name__ == "__main__":
    typer.run(main)
