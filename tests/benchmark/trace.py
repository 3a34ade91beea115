# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose copy is it, after what a file goes through? Counts of answers by attack and by size of the model.

Copies are marked for twenty recipients of a shop, with the catalogue's own code; each is attacked in every way and
traced. Unmarked models, and copies of another shop with another key, are attacked and traced in this shop's ledger.

build/venv/bin/python tests/benchmark/trace.py
"""

import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import meshmark
import numpy as np
import trimesh
import typer
from dask.distributed import LocalCluster
from meshmark.tracing import Answer
from rich.console import Console
from rich.table import Table
from shop import MESHES, Shop

MODELS = [
    "hand", "elk", "blobby", "cow", "elephant", "homer", "fandisk", "dino", "lion-head", "fandisk_large",
    "diplodocus", "bunny00",
]  # fmt: skip
SIZES = (2_000, 8_000, 15_000)  # vertices: where the columns of the table end

Attack = Callable[[Path, Path, int], Path]  # a copy, a folder, a seed; the attacked file


def filtered(name: str, amount: float = -1, iterations: int = -1) -> Attack:
    """One of the plugin's attacks."""

    def attack(copy: Path, folder: Path, seed: int) -> Path:
        out = folder / "found.ply"
        meshmark.attack(copy, out, attack=name, amount=amount, iterations=iterations, seed=seed)
        return out

    return attack


def exported(kind: str) -> Attack:
    """Another format, written by another library: vertices apart where it wants them so."""

    def attack(copy: Path, folder: Path, seed: int) -> Path:
        out = folder / f"found.{kind}"
        trimesh.load_mesh(copy, process=False).export(out)
        return out

    return attack


def mirrored(copy: Path, folder: Path, seed: int) -> Path:
    """Turned and mirrored."""
    mesh = trimesh.load_mesh(copy, process=False)
    mesh.apply_transform(trimesh.transformations.rotation_matrix(1 + seed, [1, 2, 3]) @ np.diag([-1, 1, 1, 1]))
    mesh.export(folder / "found.ply")
    return folder / "found.ply"


def plate(copy: Path, folder: Path, seed: int) -> Path:
    """Four of it, turned about, in one file."""
    mesh = trimesh.load_mesh(copy, process=False)
    width = 1.5 * float(np.linalg.norm(mesh.extents))
    places = [trimesh.transformations.rotation_matrix(n, [0, 0, 1], point=mesh.centroid) for n in range(4)]
    four = [mesh.copy().apply_transform(p).apply_translation([n * width, 0, 0]) for n, p in enumerate(places)]
    trimesh.util.concatenate(four).export(folder / "found.stl")
    return folder / "found.stl"


ATTACKS: dict[str, Attack] = {
    "similarity": filtered("Similarity"),
    "reorder": filtered("Reorder"),
    "noise .1 %": filtered("Noise", 0.001),
    "simplification 50 %": filtered("Simplify", 0.5),
    "simplification 90 %": filtered("Simplify", 0.9),
    "remeshing": filtered("Remesh"),
    "isosurface .5 %": filtered("Isosurface", 0.005),
    "smoothing x 5": filtered("Smooth", iterations=5),
    "quantization 9 bits": filtered("Quantize", 9),
    "STL": exported("stl"),
    "GLB": exported("glb"),
    "mirrored": mirrored,
    "a plate of four": plate,
    "crop 30 %, with the original": filtered("Crop", 0.3),
}
WITH_ORIGINAL = "crop 30 %, with the original"
HARMLESS = ("similarity", "reorder", "STL", "GLB", "mirrored")  # after which "nobody" can be said of coarse models too


def main(
    models: Annotated[list[str], typer.Argument(help="Names of meshes in --meshes, without .off")] = MODELS,
    meshes: Annotated[Path, typer.Option()] = MESHES,
    copies: Annotated[int, typer.Option(help="Of all models together.")] = 60,
    strangers: Annotated[int, typer.Option(help="Unmarked files, and files of another shop.")] = 60,
    every: Annotated[int, typer.Option(help="Of how many copies one is cropped: all originals are tried with it.")] = 4,
    only: Annotated[list[str] | None, typer.Option(help="These attacks only.")] = None,
) -> None:
    """Prints a table of attacks and sizes."""
    console = Console(width=120)
    attacks = {name: attack for name, attack in ATTACKS.items() if not only or name in only}
    began = time.process_time()
    files = [meshes / f"{name}.off" for name in models]
    with tempfile.TemporaryDirectory(prefix="trace-") as name, LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:  # fmt: skip
        folder = Path(name)
        ours = Shop(folder / "ours", files, copies, cluster.scheduler_address)
        theirs = Shop(folder / "theirs", files, len(files), cluster.scheduler_address)
        for name, reason in {**ours.refused, **theirs.refused}.items():
            console.print(f"no copy: {name}: {reason}")
        counts: defaultdict[str, defaultdict[str, Counter]] = defaultdict(lambda: defaultdict(Counter))
        for number, (copy, buyer, model) in enumerate(ours.copies):
            for attack, do in attacks.items():
                if attack == WITH_ORIGINAL and number % every:
                    continue
                try:
                    found = do(copy, folder, number)
                except meshmark.Refused:  # an isosurface of an open mesh
                    continue
                answer, name = ours.answer(found, attack == WITH_ORIGINAL)
                verdict = "right" if name == buyer else "WRONG" if name else str(answer)
                counts[attack][size_of(model.vertices)][verdict] += 1
                if verdict != "right":
                    console.print(f"{attack}, {model.name} ({model.vertices} vertices): {verdict}")
        harmless = [name for name in HARMLESS if name in attacks]
        for number in range(strangers if harmless else 0):
            unmarked = files[number % len(files)]
            copy, *_ = theirs.copies[number % len(theirs.copies)]
            for kind, source in (("unmarked", unmarked), ("another shop's", copy)):
                attack = harmless[(number + number // len(files)) % len(harmless)]
                answer, name = ours.answer(attacks[attack](source, folder, number))
                verdict = "right" if answer == Answer.NOBODY else "WRONG" if name else str(answer)
                counts[f"{kind}: nobody"]["all"][verdict] += 1
    console.print(table(counts))
    console.print(f"{time.process_time() - began:.0f} s of CPU")


def size_of(vertices: int) -> str:
    """The column."""
    return next((f"< {size:,}" for size in SIZES if vertices < size), f"≥ {SIZES[-1]:,}")


def table(counts: dict[str, dict[str, Counter]]) -> Table:
    """Right ones of all, and what the others were."""
    columns = [*(f"< {size:,}" for size in SIZES), f"≥ {SIZES[-1]:,}", "all"]
    shown = Table("attack", *columns)
    for attack, by_size in counts.items():
        by_size = {**by_size, "all": sum(by_size.values(), Counter())}
        shown.add_row(attack, *(cell(by_size.get(column, Counter())) for column in columns))
    return shown


def cell(verdicts: Counter) -> str:
    """Such as 8 of 9, 1 nobody."""
    if not verdicts:
        return ""
    others = [f"{count} {verdict}" for verdict, count in verdicts.items() if verdict != "right"]
    return ", ".join([f"{verdicts['right']} of {verdicts.total()}", *others])


if __name__ == "__main__":
    typer.run(main)
