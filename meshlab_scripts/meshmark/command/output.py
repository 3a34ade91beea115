# SPDX-License-Identifier: GPL-3.0-or-later
"""How a report is shown: as a table for people, or as JSON."""

import json
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from ..bounds import rounded_up
from ..reports import BOUNDS, Report

console = Console(highlight=False)
errors = Console(stderr=True, highlight=False)


def show(report: Report, as_json: bool) -> None:
    """The report's short values, its warnings, and its own sentence last."""
    if as_json:
        print_json(report.json())
        return
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, value in report.json().items():
        text = _bounds(value) if name in BOUNDS else _short(value)
        if text and name not in ("warnings", "verdict", "change", "recipe", "survival"):
            table.add_row(f"[dim]{name}[/]", escape(text))
    console.print(table)
    warn(report.warnings)
    console.print(f"[bold]{escape(str(report))}[/]", soft_wrap=True)


def print_json(values: object) -> None:
    """On standard output, for other programs."""
    print(json.dumps(values, indent=2, ensure_ascii=False))


def warn(texts: list[str]) -> None:
    """On standard error."""
    for text in texts:
        errors.print(f"[yellow]warning:[/] {escape(text)}", soft_wrap=True)


@contextmanager
def busy(what: str) -> Iterator[None]:
    """Something moves while a single long step runs; nothing where the output is no terminal."""
    with errors.status(what):
        yield


def _bounds(value: object) -> str:
    """One, or several by name."""
    if isinstance(value, dict):
        return ", ".join(f"{name} {_bounds(one)}" for name, one in value.items())
    return rounded_up(value) if isinstance(value, float) else _short(value)


def _short(value: object) -> str:
    """Empty for what is too long for people."""
    if isinstance(value, bool | int | str):
        return str(value) if len(str(value)) <= 80 else ""
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, dict):
        return ", ".join(f"{name} {_short(one)}" for name, one in value.items())
    if isinstance(value, list) and value and isinstance(value[0], str):
        return ", ".join(value)
    return ""
