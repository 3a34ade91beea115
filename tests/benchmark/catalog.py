# SPDX-License-Identifier: GPL-3.0-or-later
"""A catalogue that is killed halfway and run again: how many copies there are, each once, and what they took.

build/venv/bin/python tests/benchmark/catalog.py
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Annotated

import typer
from meshmark.catalog import Ledger
from rich import print as show

MESHES = Path(__file__).resolve().parents[2] / "build" / "data" / "meshes"
MODELS = [
    "head", "ellipe0.003", "elk", "camel", "bear", "blobby", "blobby_3cc", "knot", "hand", "bear_bis",
    "mannequin-devil", "cactus", "three_peaks", "elephant", "triceratops", "cow", "knot1", "retinal", "anchor_dense",
    "femur", "dino", "homer", "knot2", "b9_mesh", "holes", "fandisk", "lion", "lion-head", "fandisk_large",
    "diplodocus",
]  # fmt: skip
OPTIONS = ["models", "who.csv", "out", "--json", "--key-file", "secret.key"]


def main(
    models: Annotated[list[str], typer.Argument(help="Names of meshes in --meshes, without .off")] = MODELS,
    meshes: Annotated[Path, typer.Option()] = MESHES,
    recipients: Annotated[int, typer.Option()] = 20,
    workers: Annotated[int, typer.Option()] = 1,
) -> None:
    """Marks a copy of each model for each recipient, and prints what came of it."""
    with tempfile.TemporaryDirectory(prefix="catalog-") as name:
        folder = Path(name)
        (folder / "models").mkdir()
        for model in models:
            (folder / "models" / f"{model}.off").write_bytes((meshes / f"{model}.off").read_bytes())
        (folder / "who.csv").write_text("recipient\n" + "".join(f"buyer {n}\n" for n in range(recipients)))
        (folder / "secret.key").write_bytes(os.urandom(32))
        command = [sys.executable, "-m", "meshmark", "catalog", *OPTIONS, "--workers", str(workers)]
        killed = _killed(command, folder, len(models) * recipients // 2)
        outcome = json.loads(subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, check=False).stdout)
        show(f"killed at {killed} copies; then {outcome['before']} were there and {outcome['made']} were made, "
             f"in {outcome['seconds']:.0f} s, {outcome['embedded'] / outcome['worked']:.0%} of the work in the filter "
             f"that embeds")  # fmt: skip
        _check(folder / "out")
        reasons = {name.partition(" for ")[0]: text for name, text in outcome["refused"].items()}
        for model, count in Counter(name.partition(" for ")[0] for name in outcome["refused"]).most_common():
            show(f"{count} of {model} refused, one because: {reasons[model]}")


def _killed(command: list[str], folder: Path, at: int) -> int:
    """Runs it, and kills it when so many copies are there; how many were."""
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
        while run.poll() is None and len(_files(folder / "out")) < at:
            time.sleep(0.5)
        run.kill()
    return len(_files(folder / "out"))


def _files(copies: Path) -> dict[str, str]:
    """What is there under its name, and its hash."""
    return {
        path.relative_to(copies).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in copies.rglob("*.off")
        if not path.name.startswith(".")
    }


def _check(copies: Path) -> None:
    """Ledger and files are one; no copy twice; nothing unfinished."""
    with Ledger(copies / "ledger.sqlite") as ledger:
        entries = ledger.copies()
    agree = {copy.file: copy.sha256 for copy in entries} == _files(copies)
    once = len({(copy.model, copy.recipient) for copy in entries}) == len(entries)
    left = list(copies.rglob(".part*"))
    methods = Counter(copy.recipe.method for copy in entries)
    show(f"{len(entries)} copies ({', '.join(f'{n} {method}' for method, n in methods.items())}); "
         f"ledger and files agree: {agree}; each once: {once}; unfinished files: {len(left)}")  # fmt: skip


if __name__ == "__main__":
    typer.run(main)
