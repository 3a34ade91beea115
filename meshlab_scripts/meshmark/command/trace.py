# SPDX-License-Identifier: GPL-3.0-or-later
"""trace: whose copy is it?"""

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from ..catalog import Ledger
from ..key import find_key
from ..tracing import Answer, trace
from .options import AsJson, KeyFile
from .output import busy, console, print_json

CODES = {Answer.NAME: 0, Answer.NOBODY: 1, Answer.CANNOT_TELL: 3}


def add_to(app: typer.Typer) -> None:
    """Adds it to the command."""
    app.command(name="trace")(_trace)


def _trace(
    found: Annotated[Path, typer.Argument(metavar="FOUND", help="The file that turned up.", show_default=False)],
    ledger: Annotated[Path, typer.Option("--ledger", "-l", help="Of the catalogue.")] = Path("ledger.sqlite"),
    original: Annotated[
        Path | None,
        typer.Option("--original", help="Folder of the unmarked models: reads parts and slight bends, too."),
    ] = None,
    key_file: KeyFile = None,
    as_json: AsJson = False,
) -> None:
    """Tell from a found file whose copy it is.

    Exit code 0: a name; 1: nobody (the model, unmarked, or marked with another key); 2: error; 3: cannot tell.
    """
    with busy(f"Reading {found.name}"), Ledger(ledger) as opened:
        result = trace(found, opened, find_key(None, key_file), original)
    if as_json:
        print_json(result.json())
    else:
        for one in result.evidence.readings:
            console.print(f"[dim]{escape(str(one))}[/]", soft_wrap=True)
        console.print(f"[bold]{escape(result.sentence)}[/]", soft_wrap=True)
    raise typer.Exit(CODES[result.answer])
