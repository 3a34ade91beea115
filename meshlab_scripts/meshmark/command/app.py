# SPDX-License-Identifier: GPL-3.0-or-later
"""The command itself: exit code 0 for a find (or a job done), 1 for none, 2 for an error, 3 where it cannot be told."""

import sys
import traceback
from importlib import metadata
from typing import Annotated

import typer
from rich.markup import escape

from ..errors import MeshmarkError
from . import catalog, report, single, trace
from .output import errors

ERROR = 2

app = typer.Typer(
    name="meshmark",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for group in (single, catalog, trace, report):
    group.add_to(app)


def _version(wanted: bool) -> None:
    if wanted:
        print(f"meshmark {metadata.version('meshmark')}, pymeshlab {metadata.version('pymeshlab')}")
        raise typer.Exit


@app.callback(epilog="The key comes from --key-file or from the environment variable WATERMARK_KEY.")
def _about(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Versions.")] = False,
) -> None:
    """Marks copies of 3D models, one for each recipient, and tells from a found copy whose it was.

    Exit codes: 0 found (or done), 1 not found, 2 error, 3 cannot tell (trace).
    """


def main() -> None:
    """What the shell calls."""
    try:
        app()
    except (MeshmarkError, OSError) as error:
        errors.print(f"[bold red]meshmark:[/] {escape(str(error))}", soft_wrap=True)
        sys.exit(ERROR)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:  # the interpreter's own code for it is 1, which is "not found"
        traceback.print_exc()
        errors.print(
            f"[bold red]meshmark:[/] This is a fault of meshmark: {escape(repr(error))}. Report it with all that is "
            "above.",
            soft_wrap=True,
        )
        sys.exit(ERROR)
