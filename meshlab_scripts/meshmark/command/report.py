# SPDX-License-Identifier: GPL-3.0-or-later
"""report: what is put before somebody else."""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..catalog import Ledger
from ..key import find_key
from ..tracing import trace
from .options import KeyFile
from .output import busy, console
from .trace import CODES


def add_to(app: typer.Typer) -> None:
    """Adds it to the command."""
    app.command()(report)


def report(
    found: Annotated[Path, typer.Argument(metavar="FOUND", help="The file that turned up.", show_default=False)],
    ledger: Annotated[Path, typer.Option("--ledger", "-l", help="Of the catalogue.")] = Path("ledger.sqlite"),
    original: Annotated[
        Path | None, typer.Option("--original", help="Folder of the unmarked models, for reading and for the pictures.")
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="Default: FOUND with the ending .html")] = None,
    key_file: KeyFile = None,
) -> None:
    """Trace FOUND and write one HTML page: the finding, pictures, what it is worth, and what would refute it.

    Exit codes as those of trace.
    """
    from ..evidence import write_page  # matplotlib takes longer to load than all other commands need

    with busy(f"Reading {found.name}"), Ledger(ledger) as opened:
        result = trace(found, opened, find_key(None, key_file), original)
        page = out or found.with_suffix(".html")
        write_page(page, found, result, opened, original)
    console.print(f"[bold]{escape(result.sentence)}[/] {escape(str(page))}", soft_wrap=True)
    raise typer.Exit(CODES[result.answer])
