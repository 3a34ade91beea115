# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots in one style, legible in black and white: a marker and a line style for each line, bars for the spread."""

from pathlib import Path

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from .curves import error_rates, false_positives
from .jobs import METHODS
from .protocol import Spec
from .results import require, select
from .tables import FOUND

mpl.use("Agg")
plt.rcParams.update({"font.size": 9, "axes.titlesize": 9, "figure.constrained_layout.use": True})

# The family gives colour (its brightness differs too), marker and strokes; variance is dashed and hollow.
FAMILIES = {
    "Layered": ("#762a83", "P", "-"),
    "Waves": ("#000000", "v", "-"),
    "L-M": ("#08306b", "o", "-"),
    "QSP": ("#d95f0e", "s", (0, (6, 1))),
    "Cho": ("#636363", "^", (0, (1, 1))),
    "Pro": ("#1b7837", "D", (0, (4, 1, 1, 1))),
    "Spectral": ("#b2182b", "X", (0, (8, 1, 1, 1, 1, 1))),
}
OTHERS = [("#000000", "v"), ("#08306b", "o"), ("#d95f0e", "s"), ("#1b7837", "D"), ("#636363", "^"), ("#762a83", "P")]
LABELS = {
    "amount": "amount",
    "iterations": "iterations",
    "bits": "bits",
    "strength": "strength α",
    "detection_ratio": "detection ratio",
    "log10_p": "log10 p, message known",
    "log10_p_alone": "log10 p, key alone",
    "log10_p_original": "log10 p, with the original",
    "mrms_relative": "MRMS over the diagonal",
    "msdm": "MSDM",
}
AMOUNTS = {
    "Noise": "displacement over the farthest norm",
    "Simplify": "part of the faces removed",
    "Quantize": "bits per axis",
    "Resample": "vertices kept, as a part",
    "Crop": "part of the faces removed",
    "Draco": "bits a coordinate",
    "Blender remesh": "voxel over the diagonal",
    "Blender decimate": "part of the faces left",
    "Hollow": "wall over the diagonal",
}
ITERATIONS = {"Ten": "steps passed"}
IN_BITS = {"Quantize", "Draco"}
HARDER_BELOW = IN_BITS | {"Resample", "Blender decimate"}


def figure(spec: Spec, frame: pd.DataFrame, path: Path) -> bool:
    """One of the protocol's figures, such as a panel for each mesh and a line for each method. False where empty."""
    chosen = select(frame, spec["experiment"], spec.get("series"), spec.get("where"))
    if chosen.empty:
        return False
    panels = spec.get("panels", "mesh")
    x = spec["x"]
    shown = list(spec["ys"].values()) if "ys" in spec else [spec["y"], spec.get("lines", "method")]
    require(chosen, [x, panels, *shown], f"figure {spec['name']!r}")
    axes = _panels(len(_values(chosen, panels)))
    for axis, panel in zip(axes, _values(chosen, panels), strict=True):
        rows = chosen[chosen[panels] == panel]
        if "ys" in spec:
            for number, (name, column) in enumerate(spec["ys"].items()):
                _line(axis, rows, x, column, name, _style(name, number))
        else:
            lines = spec.get("lines", "method")
            for number, value in enumerate(_values(rows, lines)):
                name = _name(lines, value)
                _line(axis, rows[rows[lines] == value], x, spec["y"], name, _style(name, number))
        axis.set_title(_name(panels, panel))
        attack = chosen["attack"].iloc[0]
        axis.set_xlabel((AMOUNTS if x == "amount" else ITERATIONS).get(attack, LABELS.get(x, x)))
        axis.set_ylabel(spec.get("label") or LABELS.get(spec["y"], spec["y"]))
        if spec.get("y") == "detection_ratio":
            axis.set_ylim(min(0.35, chosen[spec["y"]].min() - 0.03), 1.03)
            axis.axhline(0.5, color="0.6", linewidth=0.6, linestyle=":")
        if spec.get("y", "").startswith("log10_p"):
            axis.axhline(FOUND, color="0.4", linewidth=0.8, linestyle=":")
        axis.xaxis.set_major_locator(MaxNLocator(5, integer=x == "iterations" or attack in IN_BITS))
        if attack in HARDER_BELOW and x == "amount":
            axis.invert_xaxis()  # harder attacks on the right, as in the other figures
    _finish(axes, path)
    return True


def error_curves(frame: pd.DataFrame, experiment: str, path: Path) -> None:
    """False negatives of each attack (all its amounts) and method by threshold, and false positives beside what bounds
    them.
    """
    chosen = frame[(frame["experiment"] == experiment) & (frame["error"] == "")]
    attacked = chosen[chosen["kind"] == "attack"]
    unmarked = chosen[chosen["kind"] == "null"]
    thresholds = np.linspace(0.3, 1, 141)
    positives = false_positives(unmarked, thresholds)
    axes = _panels(attacked["series"].nunique())
    for axis, series in zip(axes, sorted(attacked["series"].unique()), strict=True):
        for number, method in enumerate(_values(attacked, "method")):
            rows = attacked[(attacked["series"] == series) & (attacked["method"] == method)]
            ratios = rows["detection_ratio"].to_numpy()
            _, negative = error_rates(ratios, ratios, thresholds)
            axis.plot(thresholds, negative, label=f"missed: {method}", markevery=20, **_style(method, number))
        for number, (name, (rate, bound)) in enumerate(positives.items()):
            of = f" ({name})" if name else ""
            shade = 0.35 * number / max(1, len(positives) - 1)
            lines = {"color": str(shade), "linewidth": 1.6}
            axis.plot(thresholds, rate, **lines, drawstyle="steps-pre", label=f"false positives{of}")
            axis.plot(thresholds, bound, **{**lines, "color": str(shade + 0.4)}, linestyle=":", label=f"at most{of}")
        axis.set_title(series)
        axis.set_xlabel("threshold of the detection ratio")
        axis.set_ylabel("rate")
    _finish(axes, path)


def _values(rows: pd.DataFrame, column: str) -> list:
    values = sorted(rows[column].unique())
    return [method for method in METHODS if method in values] if column == "method" else values


def _name(column: str, value: object) -> str:
    return {"bits": f"{value} bits", "strength": f"α = {value}"}.get(column, str(value))


def _style(name: str, number: int) -> dict:
    family = next((family for family in FAMILIES if name.startswith(family)), None)
    color, marker, strokes = FAMILIES[family] if family else (*OTHERS[number % len(OTHERS)], "-")
    hollow = name.endswith("Var") or (family is None and number % 2 == 1)
    return {
        "color": color,
        "marker": marker,
        "markersize": 5,
        "linewidth": 1,
        "linestyle": "--" if hollow else strokes,
        "markerfacecolor": "white" if hollow else color,
    }


def _line(axis: Axes, rows: pd.DataFrame, x: str, y: str, name: str, style: dict) -> None:
    groups = rows.groupby(x)[y]
    mean, spread = groups.mean(), groups.std().fillna(0)
    axis.errorbar(mean.index, mean, spread, label=name, capsize=2, elinewidth=0.6, **style)


def _panels(count: int) -> list[Axes]:
    columns = min(count, 3)
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.4 * columns + 1.6, 2.9 * rows), squeeze=False)
    for axis in axes.flat[count:]:
        axis.remove()
    for axis in figure.axes:
        axis.grid(color="0.9", linewidth=0.5)
    return list(axes.flat[:count])


def _finish(axes: list[Axes], path: Path) -> None:
    figure = axes[0].figure
    lines = {name: line for axis in axes for line, name in zip(*axis.get_legend_handles_labels(), strict=True)}
    figure.legend(lines.values(), lines.keys(), loc="outside right upper", fontsize="small")
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)
