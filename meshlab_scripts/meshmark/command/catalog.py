# SPDX-License-Identifier: GPL-3.0-or-later
"""catalog: a copy of each model for each recipient."""

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from ..catalog import Order, forecast, make_copies
from ..catalog.recipients import read_recipients
from ..catalog.run import Forecast, Outcome
from ..key import find_key
from ..length import read_length
from ..settings import Method, Settings, Statistic
from .options import AsJson, Bits, KeyFile, MaxMove, MethodNames, StatisticName, Strength, Trim
from .output import console, errors, print_json, warn


def add_to(app: typer.Typer) -> None:
    """Adds it to the command."""
    app.command()(catalog)


def catalog(
    models: Annotated[Path, typer.Argument(metavar="FOLDER", help="The models.", show_default=False)],
    recipients: Annotated[
        Path,
        typer.Argument(
            metavar="RECIPIENTS.csv",
            help="A column 'recipient', and perhaps 'model': then that line is for this model (or pattern) only.",
            show_default=False,
        ),
    ],
    copies: Annotated[Path, typer.Argument(metavar="OUT", help="Where the copies go.", show_default=False)],
    ledger: Annotated[Path | None, typer.Option("--ledger", help="Default: OUT/ledger.sqlite")] = None,
    key_file: KeyFile = None,
    method: MethodNames = [Method.LAYERED, Method.LM],  # noqa: B006 (typer copies it)
    statistic: StatisticName = Statistic.MEAN,
    bits: Bits = 0,
    trim: Trim = -1,
    strength: Strength = 0,
    max_move: MaxMove = None,
    workers: Annotated[int, typer.Option("--workers", min=0, help="0 is one for each core.")] = 0,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", help="Address of a dask scheduler; its workers see the same files and key."),
    ] = None,
    retry: Annotated[bool, typer.Option("--retry", help="Try again what was refused before.")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only say what will be done, and how long.")] = False,
    as_json: AsJson = False,
) -> None:
    """Make a marked copy of each model in FOLDER for each recipient, and note in a ledger whose is which.

    A run that was stopped, in whatever way, goes on where it was when called again. Each file is read again, and
    counts only where its mark is there. What a model refuses is not tried again, unless with --retry; what failed on
    a machine is. Exit code 1: some copies could not be made.
    """
    order = Order(
        models, copies, read_recipients(recipients), find_key(None, key_file),
        Settings(method[0], statistic, bits, trim), strength, None if max_move is None else read_length(max_move),
        tuple(method[1:]),
    )  # fmt: skip
    file = ledger or copies / "ledger.sqlite"
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, TimeRemainingColumn(), console=errors, disable=not errors.is_terminal) as progress:

        def track(paths: Iterable[Path]) -> Iterator[Path]:
            return iter(progress.track(list(paths), description="Reading models"))

        if dry_run:
            _show_forecast(forecast(order, file, workers=workers, track=track), as_json)
            return
        task = progress.add_task("Making copies", total=None)
        outcome = make_copies(
            order, file, scheduler=scheduler, workers=workers, retry=retry, track=track,
            tick=lambda done, total: progress.update(task, completed=done, total=total),
        )  # fmt: skip
    _show_outcome(outcome, file, as_json)
    raise typer.Exit(1 if outcome.refused or outcome.failed or outcome.broken else 0)


def _show_forecast(plan: Forecast, as_json: bool) -> None:
    if as_json:
        print_json(vars(plan))
        return
    warn([f"{name}: {reason}" for name, reason in plan.broken.items()])
    if plan.copies == 0:
        console.print(f"No copies to make: {plan.before:,} are there.")
        return
    time = "unknown, since the models tried refused" if plan.seconds is None else f"about {_duration(plan.seconds)}"
    console.print(
        f"{plan.copies:,} copies to make ({plan.before:,} are there), {plan.bytes / 1e6:,.1f} MB, {time} with "
        f"{plan.workers} workers."
    )


def _show_outcome(outcome: Outcome, ledger: Path, as_json: bool) -> None:
    if as_json:
        print_json(vars(outcome))
        return
    warn([f"{name}: {reason}" for name, reason in outcome.broken.items()])
    _show_reasons("refused", outcome.refused)
    _show_reasons("failed", outcome.failed)
    share = f", {outcome.embedded / outcome.worked:.0%} of the work is embedding" if outcome.worked else ""
    failed = f", {len(outcome.failed):,} failed (run the same again to try them anew)" if outcome.failed else ""
    console.print(
        f"[bold]{outcome.made:,} copies made in {_duration(outcome.seconds)}[/]{share}; {outcome.before:,} were there, "
        f"{len(outcome.refused):,} refused{failed}. Ledger: {escape(str(ledger))}",
        soft_wrap=True,
    )


def _show_reasons(word: str, reasons: dict[str, str]) -> None:
    for reason, count in Counter(reasons.values()).most_common():
        first = next(name for name, text in reasons.items() if text == reason)
        others = f" and {count - 1} more" if count > 1 else ""
        errors.print(f"[yellow]{word}:[/] {escape(f'{first}{others}: {reason}')}", soft_wrap=True)


def _duration(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
