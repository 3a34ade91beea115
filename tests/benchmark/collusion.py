# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipients who average their copies: is one of them named, and never an innocent? And what many recipients cost.

build/venv/bin/python tests/benchmark/collusion.py
"""

import sqlite3
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Annotated

import meshmark
import numpy as np
import trimesh
import typer
from dask.distributed import LocalCluster
from meshmark.catalog import Ledger
from meshmark.settings import Settings
from meshmark.tracing import trace
from rich.console import Console
from shop import MESHES, RECIPIENTS, Shop

MODELS = ["homer", "fandisk", "bear_bis", "camel"]


def main(
    models: Annotated[list[str], typer.Argument(help="Names of meshes in --meshes, without .off")] = MODELS,
    meshes: Annotated[Path, typer.Option()] = MESHES,
    bits: Annotated[int, typer.Option(help="Carriers; 0: as many as are recommended.")] = 0,
    draws: Annotated[int, typer.Option(help="Of a model and of those who average.")] = 20,
    together: Annotated[list[int], typer.Option(help="How many average.")] = [2, 3, 5],  # noqa: B006
    originals: Annotated[bool, typer.Option("--originals", help="With the unmarked models at hand.")] = False,
    recipients: Annotated[int, typer.Option(help="In a ledger that is searched once.")] = 100_000,
) -> None:
    """Prints what came out of each draw, and the time of a trace in a large ledger."""
    console = Console(width=120)
    draw = np.random.default_rng(1)
    with tempfile.TemporaryDirectory(prefix="collusion-") as name, LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:  # fmt: skip
        folder = Path(name)
        files = [meshes / f"{model}.off" for model in models]
        shop = Shop(folder, files, RECIPIENTS * len(files), cluster.scheduler_address, Settings(bits=bits))
        for count in together:
            drawn = (_averaged(shop, folder, models[n % len(models)], count, draw) for n in range(draws))
            counts = Counter(_said(shop, mean, buyers, originals) for mean, buyers in drawn)
            console.print(f"{count} averaged: {dict(counts)}")
        copy, buyer, model = shop.copies[0]
        _alone(console, copy, shop)
        _fill(shop.ledger, recipients)
        began = time.process_time()
        with Ledger(shop.ledger) as ledger:
            found = trace(copy, ledger, shop.key)
        console.print(f"{model.name}: {found.recipient} of {buyer} among {found.evidence.candidates} candidates, "
                      f"{time.process_time() - began:.2f} s of CPU")  # fmt: skip


def _averaged(shop: Shop, folder: Path, model: str, count: int, draw: np.random.Generator) -> tuple[Path, list[str]]:
    """The mean of some copies of a model, and whose these are."""
    copies = [(file, buyer) for file, buyer, of in shop.copies if of.name == f"{model}.off"]
    chosen = [copies[n] for n in draw.choice(len(copies), count, replace=False)]
    shapes = [trimesh.load_mesh(file, process=False) for file, _ in chosen]
    mean = trimesh.Trimesh(np.mean([shape.vertices for shape in shapes], axis=0), shapes[0].faces, process=False)
    mean.export(folder / "found.ply")
    return folder / "found.ply", [buyer for _, buyer in chosen]


def _said(shop: Shop, found: Path, buyers: list[str], originals: bool) -> str:
    """What is said of whose copy it is."""
    answer, name = shop.answer(found, originals)
    if name is None:
        return str(answer)
    return "one of them" if name in buyers else "AN INNOCENT"


def _alone(console: Console, copy: Path, shop: Shop) -> None:
    """What one detection takes in the same file."""
    with Ledger(shop.ledger) as ledger:
        settings, group = next(iter(ledger.candidates().items()))
    began = time.process_time()
    meshmark.detect(copy, key=shop.key, expected=f"id:{next(iter(group.values()))}", **settings.values())
    console.print(f"one detection: {time.process_time() - began:.2f} s of CPU")


def _fill(ledger: Path, count: int) -> None:
    """Enters the first copy for so many others too."""
    with Ledger(ledger, "write") as open_ledger:
        open_ledger.add_recipients(f"other {n}" for n in range(count))
    with sqlite3.connect(ledger) as sql:
        sql.execute(
            "INSERT INTO copies SELECT c.model, r.id, 'other/' || r.id, c.sha256, NULL, c.recipe, c.figures, c.made "
            "FROM recipients r, (SELECT * FROM copies ORDER BY recipient, model LIMIT 1) c WHERE r.name LIKE 'other %'"
        )


if __name__ == "__main__":
    typer.run(main)
