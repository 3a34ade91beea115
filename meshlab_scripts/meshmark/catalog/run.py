# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the jobs on all cores, or on a user's cluster (dask.distributed), and keeps the ledger."""

import os
import secrets
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..alone import alone
from ..errors import MeshmarkError
from ..settings import Settings
from .ledger import Copy, Ledger
from .plan import LOCK, Item, Job, Order, Track, enter_models, missing_jobs, ordered
from .work import Made, make, sweep

Tick = Callable[[int, int], None]  # how many are done, of how many


@dataclass
class Outcome:
    """What a run did of what was ordered."""

    before: int = 0
    made: int = 0
    refused: dict[str, str] = field(default_factory=dict)  # why, by "model for recipient"
    failed: dict[str, str] = field(default_factory=dict)  # why, likewise; the next run tries them again
    broken: dict[str, str] = field(default_factory=dict)  # why, by model
    seconds: float = 0
    worked: float = 0  # seconds of all workers together
    embedded: float = 0  # of these, inside of the filter that embeds


@dataclass(frozen=True)
class Forecast:
    """What a run would do."""

    copies: int
    before: int
    bytes: int
    seconds: float | None  # with as many workers
    workers: int
    broken: dict[str, str]


def make_copies(
    order: Order,
    ledger_file: Path,
    *,
    scheduler: str | None = None,
    workers: int = 0,
    retry: bool = False,
    track: Track = iter,
    tick: Tick = lambda done, all_: None,
) -> Outcome:
    """Makes the copies that are missing. Killed at any time it goes on, when called again, where it was.

    :raises MeshmarkError: where the order as a whole cannot be met; what concerns single copies is in the outcome
    """
    if not order.key.is_reference:
        raise MeshmarkError("A catalogue needs its key in a file or in an environment variable: workers read it there.")
    began = time.perf_counter()
    order, ledger_file = _absolute(order), ledger_file.resolve()
    with (  # two runs at once would take each other's unfinished files away
        alone(order.copies / LOCK, f"in '{order.copies}'"),
        alone(ledger_file.with_name(f".{ledger_file.name}.lock"), f"with the ledger '{ledger_file}'"),
        Ledger(ledger_file, "write") as ledger,
    ):
        ledger.begin(order.key, order.copies)
        ledger.settle(order.copies)
        sweep(order.copies)
        if retry:
            ledger.forget_refusals()
        items, broken = _items(ledger, order, track)
        outcome = Outcome(before=_there(ledger, items), broken=broken)
        jobs = missing_jobs(ledger, order, items)
        if jobs:
            _run(jobs, ledger, outcome, scheduler, workers, tick)
        reasons = ledger.refused()
        outcome.refused = {str(item): reasons[item.at] for item in items if item.at in reasons}
    outcome.seconds = time.perf_counter() - began
    return outcome


def forecast(order: Order, ledger_file: Path, *, workers: int = 0, track: Track = iter) -> Forecast:
    """What make_copies() would do. Marks one model of middling size for nobody, to see how long that takes."""
    order = _absolute(order)
    workers = workers or os.cpu_count() or 1
    with Ledger(ledger_file, "draft") as ledger:
        ledger.begin(order.key, order.copies)
        items, broken = _items(ledger, order, track)
        before = _there(ledger, items)
        jobs = missing_jobs(ledger, order, items)
    seconds = None
    with tempfile.TemporaryDirectory(prefix="meshmark-") as folder:
        jobs_by_size = sorted(jobs, key=lambda job: job.item.model.vertices)
        for job in jobs_by_size[len(jobs) // 2 :: max(1, len(jobs) // 8)]:  # the first may refuse
            tried = make(replace(job, order=replace(order, copies=Path(folder))), "forecast")
            if tried.part:
                vertices = sum(j.item.model.vertices for j in jobs)
                seconds = tried.seconds / job.item.model.vertices * vertices / workers
                break
    return Forecast(len(jobs), before, sum(job.item.model.bytes for job in jobs), seconds, workers, broken)


def _items(ledger: Ledger, order: Order, track: Track) -> tuple[list[Item], dict[str, str]]:
    """What is ordered, in the ledger with all that it consists of; and which models are broken."""
    models, broken = enter_models(ledger, order, track)
    ledger.add_recipients(recipient.name for recipient in order.recipients)
    return ordered(ledger, order, models), broken


def _there(ledger: Ledger, items: list[Item]) -> int:
    done = ledger.done()
    return sum(item.at in done for item in items)


def _run(jobs: list[Job], ledger: Ledger, outcome: Outcome, scheduler: str | None, workers: int, tick: Tick) -> None:
    from ..cluster import client, ended  # dask takes longer to load than most commands need

    by_name = {job.name: job for job in jobs}
    run = secrets.token_hex(4)
    with client(scheduler, workers) as dask:
        futures = [dask.submit(make, job, run, key=f"{run}-{job.name}", pure=False) for job in jobs]
        tick(0, len(jobs))
        for number, (name, result, death) in enumerate(ended(futures), 1):
            made = Made(failure=f"The worker gave no answer: {death!r}.") if death else result
            _enter(by_name[name.partition("-")[2]], made, ledger, outcome)
            tick(number, len(jobs))


def _enter(job: Job, made: Made, ledger: Ledger, outcome: Outcome) -> None:
    outcome.worked += made.seconds
    if made.refusal:
        ledger.refuse(*job.item.at, made.refusal)
    elif made.failure:
        outcome.failed[str(job.item)] = made.failure
    else:
        figures = dict(made.figures or {})
        outcome.embedded += sum((figures.pop("seconds", None) or {}).values())
        outcome.made += 1
        copy = Copy(*job.item.at, job.file, made.sha256, made.part, Settings(**made.recipe), figures)
        ledger.accept(copy, job.order.copies)


def _absolute(order: Order) -> Order:
    return replace(order, models=order.models.resolve(), copies=order.copies.resolve())
