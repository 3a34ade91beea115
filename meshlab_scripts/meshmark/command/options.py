# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that several subcommands share."""

from pathlib import Path
from typing import Annotated

import typer

from ..settings import Method, Statistic

KeyFile = Annotated[
    Path | None,
    typer.Option("--key-file", help="File with the secret key; without it the environment variable WATERMARK_KEY."),
]
AsJson = Annotated[bool, typer.Option("--json", help="The whole report as JSON on standard output.")]
MethodName = Annotated[Method, typer.Option("--method", help="Detection needs the same one.")]
MethodNames = Annotated[
    list[Method],
    typer.Option(
        "--method",
        help="May be given several times: a model that refuses the first is marked by the next. trace knows.",
    ),
]
StatisticName = Annotated[Statistic, typer.Option("--statistic", help="Detection needs the same one.")]
Bits = Annotated[
    int,
    typer.Option(
        "--bits", min=0, max=1024, help="Number of carriers; 0 is what suits the message, and detection finds it."
    ),
]
Trim = Annotated[float, typer.Option("--trim", help="0 to 0.45; -1 draws it from the key. Detection needs the same.")]
Strength = Annotated[float, typer.Option("--strength", min=0, help="0 is the method's default.")]
MaxMove = Annotated[
    str | None,
    typer.Option("--max-move", help="Refuse what moves a vertex further: 0.05mm, 50um, .002in, or in the file's unit."),
]
