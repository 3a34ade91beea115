# SPDX-License-Identifier: GPL-3.0-or-later
"""embed, detect, attack, measure: one file each."""

from pathlib import Path
from typing import Annotated

import typer

from .. import marking
from ..key import find_key
from ..settings import Method, Statistic
from .options import AsJson, Bits, KeyFile, MaxMove, MethodName, StatisticName, Strength, Trim
from .output import busy, show

ATTACKS = (
    "Noise", "Smooth", "Simplify", "Quantize", "Resample", "Remesh", "Isosurface", "Subdivide", "Crop", "Similarity",
    "Affine", "Reorder", "Taubin", "Loop", "Sqrt3", "Mirror", "Plate",
)  # fmt: skip

Source = Annotated[Path, typer.Argument(metavar="IN", help="STL, PLY, OBJ, OFF, GLB or 3MF.", show_default=False)]
Target = Annotated[
    Path, typer.Argument(metavar="OUT", help="Of the same kind. An OUT that exists is replaced.", show_default=False)
]


def add_to(app: typer.Typer) -> None:
    """Adds them to the command."""
    for function in (embed, detect, attack, measure):
        app.command()(function)


def embed(
    source: Source,
    target: Target,
    message: Annotated[str, typer.Option("--message", "-m", help="A text (up to 64 letters), id:17, or hex:C0FFEE.")],
    key_file: KeyFile = None,
    method: MethodName = Method.LAYERED,
    statistic: StatisticName = Statistic.MEAN,
    bits: Bits = 0,
    trim: Trim = -1,
    strength: Strength = 0,
    max_move: MaxMove = None,
    rehearse: Annotated[bool, typer.Option("--rehearse", help="Say which attacks the mark survives.")] = False,
    as_json: AsJson = False,
) -> None:
    """Hide a message in IN, write it to OUT, and read it back from there. What OUT shows stays where it was."""
    with busy(f"Marking {source.name}"):
        report = marking.embed(
            source, target, message=message, key=find_key(None, key_file), method=method, statistic=statistic,
            bits=bits, trim=trim, strength=strength, max_move=max_move, rehearse=rehearse,
        )  # fmt: skip
    show(report, as_json)


def detect(
    source: Source,
    key_file: KeyFile = None,
    expected: Annotated[
        str | None,
        typer.Option("--expected", "-e", help="The message to look for, or file:PATH with one on each line."),
    ] = None,
    original: Annotated[
        Path | None,
        typer.Option("--original", help="The unmarked model, if at hand: reads parts and slight bends, too."),
    ] = None,
    method: MethodName = Method.LAYERED,
    statistic: StatisticName = Statistic.MEAN,
    bits: Bits = 0,
    trim: Trim = -1,
    as_json: AsJson = False,
) -> None:
    """Read a mark from IN. Exit code 0: the message is there; 1: it is not."""
    with busy(f"Reading {source.name}"):
        report = marking.detect(
            source, key=find_key(None, key_file), expected=expected, original=original, method=method,
            statistic=statistic, bits=bits, trim=trim,
        )  # fmt: skip
    show(report, as_json)
    raise typer.Exit(0 if report.found else 1)


def attack(
    source: Source,
    target: Annotated[
        Path,
        typer.Argument(
            metavar="OUT",
            help="In the format of its ending: any that pymeshlab writes. It keeps the shape only.",
            show_default=False,
        ),
    ],
    name: Annotated[str, typer.Option("--attack", "-a", help=f"{', '.join(ATTACKS[:-1])} or {ATTACKS[-1]}.")],
    amount: Annotated[float, typer.Option("--amount", help="Of the attack's own kind; -1 is the usual amount.")] = -1,
    iterations: Annotated[int, typer.Option("--iterations", help="-1 is the usual number.")] = -1,
    seed: Annotated[int, typer.Option("--seed", min=0)] = 0,
    as_json: AsJson = False,
) -> None:
    """Do to IN what a user, a file format or an adversary might, and write it to OUT."""
    with busy(f"Attacking {source.name}"):
        report = marking.attack(source, target, attack=name, amount=amount, iterations=iterations, seed=seed)
    show(report, as_json)


def measure(
    source: Source,
    reference: Annotated[Path, typer.Argument(metavar="REFERENCE", help="To compare with.", show_default=False)],
    samples: Annotated[
        int, typer.Option("--samples", min=0, help="Points on each surface; 0 is ten for each vertex.")
    ] = 0,
    seed: Annotated[int, typer.Option("--seed", min=0)] = 0,
    as_json: AsJson = False,
) -> None:
    """Tell how far IN is from REFERENCE."""
    with busy(f"Measuring {source.name}"):
        report = marking.measure(source, reference, samples=samples, seed=seed)
    show(report, as_json)
