# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws frame error rates of the payload code from what tests/benchmark/code_rates prints, and prints its tables."""

from pathlib import Path
from typing import Annotated

import matplotlib as mpl
import pandas as pd
import typer
from matplotlib import pyplot as plt
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
COLUMNS = ["table", "bits", "carriers", "list", "esn0_db", "error_rate", "maximum_likelihood", "normal_approximation"]
TARGET = 1e-2
# Of a code: its colour, whose brightness differs too, and its marker.
LOOKS = [("#000000", "v"), ("#b2182b", "o"), ("#08306b", "s"), ("#d95f0e", "D"), ("#1b7837", "^"), ("#636363", "P"),
         ("#762a83", "X"), ("#5ab4ac", "*")]  # fmt: skip
HOLLOW = {"markerfacecolor": "none", "linestyle": "none", "markersize": 9}


def read(paths: list[Path]) -> pd.DataFrame:
    tables = [pd.read_csv(path, comment="#") for path in paths]
    rows = pd.concat(tables, ignore_index=True)[COLUMNS]
    return rows.replace({"error_rate": {0: float("nan")}, "maximum_likelihood": {0: float("nan")}})


def draw(rows: pd.DataFrame, output: Path) -> None:
    """Left: beside maximum likelihood over all words. Right: beside the normal approximation."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4), sharey=True, layout="constrained")
    codes = sorted(
        set(rows[rows.table.isin(["small", "curve"])][["bits", "carriers"]].itertuples(index=False, name=None))
    )
    look = dict(zip(codes, LOOKS, strict=False))
    small = rows[rows.table == "small"]
    for code, curve in small.groupby(["bits", "carriers"]):
        color, marker = look[code]
        left.semilogy(
            curve.esn0_db, curve.error_rate, "-", color=color, marker=marker, label="{} bits in {}".format(*code)
        )
        left.semilogy(curve.esn0_db, curve.maximum_likelihood, marker=marker, color=color, **HOLLOW)
    left.set_title("list of 32; hollow: maximum likelihood", fontsize=10)

    curves = rows[rows.table == "curve"]
    for code, group in curves.groupby(["bits", "carriers"]):
        color, marker = look[code]
        for size, curve in group.groupby("list"):
            label = "{} bits in {}".format(*code) if size == 32 else None
            style = {1: {"linestyle": ":"}, 32: {"marker": marker}, 128: {"marker": marker, **HOLLOW}}[size]
            right.semilogy(curve.esn0_db, curve.error_rate, color=color, label=label, **style)
        ideal = group.drop_duplicates("esn0_db")
        right.semilogy(ideal.esn0_db, ideal.normal_approximation, "--", color=color, linewidth=1)
    right.set_title("list of 32; dotted 1; hollow 128; dashed: normal approximation", fontsize=10)
    for axes in (left, right):
        axes.axhline(TARGET, color="gray", linewidth=0.5)
        axes.set(xlabel="Es/N0 of a carrier, dB", ylim=(3e-4, 1))
        axes.grid(alpha=0.3)
    left.set_ylabel("messages read wrong")
    lines = {name: line for axes in (left, right) for line, name in zip(*axes.get_legend_handles_labels(), strict=True)}
    figure.legend(lines.values(), lines.keys(), loc="outside right upper")
    output.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(output, dpi=75)
    with Image.open(output) as picture:
        picture.convert("RGB").quantize(64).save(output, optimize=True)


def print_tables(rows: pd.DataFrame) -> None:
    start = "| bits | carriers | normal approximation, dB |"
    print(f"{start} code, dB | apart, dB |\n|---|---|---|---|---|")
    for row in rows[rows.table == "length"].itertuples():
        ideal, real, apart = row.esn0_db, row.error_rate, row.maximum_likelihood
        print(f"| {row.bits} | {row.carriers} | {ideal:.2f} | {real:.2f} | {apart:.2f} |")
    print(f"\n{start} proven 1 of 2, dB | proven 19 of 20, dB |\n|---|---|---|---|---|")
    for row in rows[rows.table == "proof"].itertuples():
        half, nearly_all, ideal = row.esn0_db, row.error_rate, row.maximum_likelihood
        print(f"| {row.bits} | {row.carriers} | {ideal:.1f} | {half:.1f} | {nearly_all:.1f} |")


def main(
    tables: Annotated[list[Path], typer.Argument(help="what code_rates printed, in one file or several")],
    output: Annotated[Path, typer.Option(help="the picture")] = ROOT / "meshlab_scripts/results/payload/code-rates.png",
) -> None:
    mpl.use("agg")
    rows = read(tables)
    draw(rows, output)
    print_tables(rows)


if __name__ == "__main__":
    typer.run(main)
