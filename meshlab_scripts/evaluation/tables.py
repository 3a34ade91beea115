# SPDX-License-Identifier: GPL-3.0-or-later
"""Markdown tables: ours with the standard deviation over the keys, and the thesis' figure beside it in brackets."""

import math
from collections.abc import Callable

import pandas as pd

from .jobs import METHODS
from .protocol import COLUMN_OPTIONS, Spec
from .results import require, select

# Our meshes that are, or come close to, the thesis' own.
COUNTERPARTS = {"bunny00": "Bunny", "fandisk": "Fandisk"}

Cells = list[tuple[float, float]]  # mean and deviation


def table(spec: Spec, frame: pd.DataFrame) -> str:
    """One of the protocol's tables, and after it the columns that ask for it relative to another."""
    columns = spec["columns"]
    ours = _measure(spec, frame)
    published = {
        row: [(float(value), math.nan) for value in values] for row, values in spec.get("published", {}).items()
    }
    text = _markdown(columns, ours, published)
    relative = [{**column, "digits": 3} for column in columns if "over" in column]
    if relative:
        text += f"\n\nRelative to {' and '.join(dict.fromkeys(column['over'] for column in relative))}:\n\n"
        text += _markdown(relative, _relative(columns, ours), _relative(columns, published))
    return text


def _measure(spec: Spec, frame: pd.DataFrame) -> dict[str, Cells]:
    require(frame, [*spec["rows"], *(column["value"] for column in spec["columns"])], f"table {spec['name']!r}")
    rows = {}
    marks = select(frame, spec["experiment"])[spec["rows"]].drop_duplicates().sort_values(spec["rows"])
    for row in marks.itertuples(index=False):
        fixed = dict(zip(spec["rows"], row, strict=True))
        cells = []
        for column in spec["columns"]:
            varied = {name: value for name, value in column.items() if name not in COLUMN_OPTIONS}
            chosen = select(frame, spec["experiment"], where={**fixed, **varied})
            values = chosen[column["value"]] * column.get("scale", 1)
            alike = len(values) > 1 and values.nunique() == 1  # whose mean is rounded, so they would seem to differ
            cells.append((values.mean(), 0.0 if alike else values.std()))
        rows[" ".join(map(str, row))] = cells
    return rows


def _relative(columns: list[Spec], rows: dict[str, Cells]) -> dict[str, Cells]:
    relative = {}
    for row, cells in rows.items():
        means = {column["label"]: mean for column, (mean, _) in zip(columns, cells, strict=True)}
        relative[row] = [(means[c["label"]] / means[c["over"]], math.nan) for c in columns if "over" in c]
    return relative


def _markdown(columns: list[Spec], ours: dict[str, Cells], published: dict[str, Cells]) -> str:
    lines = [["", *(column["label"] for column in columns)]]
    compared = set()
    for row, cells in ours.items():
        mesh, _, rest = row.partition(" ")
        counterpart = f"{COUNTERPARTS.get(mesh, mesh)} {rest}".strip()
        compared.add(counterpart)
        thesis = published.get(counterpart, [(math.nan, math.nan)] * len(columns))
        lines.append([row, *map(_cell, columns, cells, thesis)])
    nothing = (math.nan, math.nan)
    for row, cells in published.items():
        if row not in compared:
            lines.append(
                [f"*{row}*", *(_cell(column, nothing, cell) for column, cell in zip(columns, cells, strict=True))]
            )
    return grid(lines)


def _cell(column: Spec, ours: tuple[float, float], thesis: tuple[float, float]) -> str:
    form = f".{column['significant']}g" if "significant" in column else f".{column.get('digits', 2)}f"
    texts = [" ± ".join(f"{value:{form}}" for value in ours if math.isfinite(value))]
    texts += [f"({value:{form}})" for value in thesis if math.isfinite(value)]
    return " ".join(filter(None, texts)) or "–"


Published = dict[str, dict[tuple[str, float, int], float]]  # whose, and what after which attack


def robustness(frame: pd.DataFrame, experiment: str, value: str, digits: int, published: Published) -> str:
    """Mean of a result after every attack and amount, a column for each method and for each who published it; empty
    where there are no attacks.
    """
    chosen, varied, methods = _attacked(frame, experiment)
    keys = ["mesh", *varied, "series", "amount", "iterations"]
    if value not in chosen or chosen[value].isna().all():
        return ""
    lines = [["mesh", *varied, "attack", "amount", "iterations", *methods, *published]]
    for at, row in chosen.pivot_table(index=keys, columns="method", values=value).iterrows():
        labels = ["" if label == -1 else f"{label:g}" if isinstance(label, float) else str(label) for label in at]
        cells = [row.get(method, math.nan) for method in methods]
        cells += [known.get(at[-3:], math.nan) for known in published.values()]
        lines.append([*labels, *("–" if math.isnan(cell) else f"{cell:.{digits}f}" for cell in cells)])
    return grid(lines)


def _attacked(frame: pd.DataFrame, experiment: str) -> tuple[pd.DataFrame, list[str], list[str]]:
    """The attacked marks, what else than the method varies between marks, and the methods, with those of no mark."""
    asked = frame[(frame["experiment"] == experiment) & (frame["kind"] == "attack")]
    chosen = asked[asked["error"] == ""]
    choices = chosen.groupby("method")[["bits", "strength", "limits"]].nunique().max()
    varied = list(choices[choices > 1].index)
    return chosen, varied, [method for method in METHODS if method in set(asked["method"])]


def within_limits(frame: pd.DataFrame, experiment: str) -> str:
    """How many marks keep each limit, of how many that were sought, mesh by mesh; empty where there are no limits."""
    sought = frame[(frame["experiment"] == experiment) & (frame["kind"] == "embed") & (frame["limits"] != "")]
    if sought.empty:
        return ""
    methods = [method for method in METHODS if method in set(sought["method"])]
    made = sought["error"].eq("").groupby([sought[name] for name in ["limits", "mesh", "method"]])
    counts = made.agg(["sum", "count"])
    rows = _by_method(counts, methods, lambda marks: f"{marks['sum']} of {marks['count']}")
    return grid([["limits", "mesh", *methods], *rows])


FOUND = -6  # log10 p from which a mark is called found


def found(frame: pd.DataFrame, experiment: str, values: list[str]) -> str:
    """Per cent of the attacked marks that are found, by attack, over meshes, keys and amounts: for each of the values
    of log10 p, with strokes between. Marks that could not be made are in no cell. Empty where there are no attacks.
    """
    chosen, varied, methods = _attacked(frame, experiment)
    values = [value for value in values if value in chosen and chosen[value].notna().any()]
    if not values:
        return ""
    shares = chosen[values].lt(FOUND).groupby([chosen[name] for name in [*varied, "series", "method"]]).mean() * 100
    rows = _by_method(shares, methods, lambda of_values: " / ".join(f"{share:.0f}" for share in of_values))
    return grid([[*varied, "attack", *methods], *rows])


def _by_method(frame: pd.DataFrame, methods: list[str], cell: Callable[[pd.Series], str]) -> list[list[str]]:
    """A row for each of what the index has before the method, and a cell for each method."""
    rows = []
    for at in dict.fromkeys(index[:-1] for index in frame.index):
        cells = [cell(frame.loc[(*at, method)]) if (*at, method) in frame.index else "–" for method in methods]
        rows.append([*map(str, at), *cells])
    return rows


def rates(frame: pd.DataFrame) -> str:
    """Equal error rates by attack and method."""
    methods = [method for method in METHODS if method in frame.columns]
    lines = [["attack", *methods]]
    for attack, row in frame.iterrows():
        lines.append([str(attack), *("–" if math.isnan(row[method]) else f"{row[method]:.3f}" for method in methods)])
    return grid(lines)


def grid(lines: list[list[str]]) -> str:
    """A Markdown table; the first line is its head."""
    head, *body = [[" ".join(cell.split()) for cell in line] for line in lines]
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, rule, *body])
