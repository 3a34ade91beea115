# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the jobs on all cores, or on a user's cluster (dask.distributed), and keeps the ledger."""

import fcntl
import logging
import os
import secrets
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import MeshmarkError
from ..settings import Settings
from .ledger import Copy, Ledger
from .plan import Job, Order, Track, enter_models, missing_jobs
from .work import Made, make, sweep

if TYPE_CHECKING:
    from dask.distributed import Client

Tick = Callable[[int, int], None]  # how many are done, of how many


@dataclass
class Outcome:
    """What a run did."""

    before: int = 0
    made: int = 0
    refused: dict[str, str] = field(default_factory=dict)  # why, by "model for recipient"
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
    order = _absolute(order)
    order.copies.mkdir(parents=True, exist_ok=True)
    with _alone(order.copies), Ledger(ledger_file, create=True) as ledger:
        ledger.require(order.key)
        ledger.settle(order.copies)
        sweep(order.copies)
        if retry:
            ledger.forget_refusals()
        ledger.add_recipients(recipient.name for recipient in order.recipients)
        models, broken = enter_models(ledger, order.models, track)
        jobs = missing_jobs(ledger, order, models)
        outcome = Outcome(before=len(ledger.done()), broken=broken)
        if jobs:
            _run(jobs, ledger, outcome, scheduler, workers, tick)
        _tell_refusals(ledger, outcome)
    outcome.seconds = time.perf_counter() - began
    return outcome


def forecast(order: Order, ledger_file: Path, *, workers: int = 0, track: Track = iter) -> Forecast:
    """What make_copies() would do. Marks one model of middling size for nobody, to see how long that takes."""
    order = _absolute(order)
    workers = workers or os.cpu_count() or 1
    with tempfile.TemporaryDirectory(prefix="meshmark-") as folder:
        with _copy_of(ledger_file, Path(folder) / "ledger.sqlite") as ledger:
            before = len(ledger.done())
            ledger.require(order.key)
            ledger.add_recipients(recipient.name for recipient in order.recipients)
            models, broken = enter_models(ledger, order.models, track)
            jobs = missing_jobs(ledger, order, models)
        jobs_by_size = sorted(jobs, key=lambda job: job.model.vertices)
        seconds = None
        for job in jobs_by_size[len(jobs) // 2 :: max(1, len(jobs) // 8)]:  # the first may refuse
            tried = make(replace(job, order=replace(order, copies=Path(folder))), "forecast")
            if not tried.error:
                seconds = tried.seconds / job.model.vertices * sum(j.model.vertices for j in jobs) / workers
                break
    return Forecast(len(jobs), before, sum(job.model.bytes for job in jobs), seconds, workers, broken)


def _run(jobs: list[Job], ledger: Ledger, outcome: Outcome, scheduler: str | None, workers: int, tick: Tick) -> None:
    from dask.distributed import as_completed

    by_name = {job.name: job for job in jobs}
    run = secrets.token_hex(4)
    lost = 0
    with _client(scheduler, workers) as client:
        futures = [client.submit(make, job, run, key=f"{run}-{job.name}", pure=False) for job in jobs]
        tick(0, len(jobs))
        for number, future in enumerate(as_completed(futures), 1):
            job = by_name[future.key.partition("-")[2]]
            if future.status == "finished":
                _enter(job, future.result(), ledger, outcome)
            elif future.status == "error":  # make() raises nothing: the job took its worker with it
                ledger.refuse(job.model.id, job.recipient, f"The worker died: {future.exception()!r}")
            else:
                lost += 1  # the cluster is gone, which says nothing of the job
            future.release()
            tick(number, len(jobs))
    if lost:
        raise MeshmarkError(f"The cluster was lost with {lost} copies to make. Run the same again: it goes on there.")


def _enter(job: Job, made: Made, ledger: Ledger, outcome: Outcome) -> None:
    outcome.worked += made.seconds
    if made.error:
        ledger.refuse(job.model.id, job.recipient, made.error)
        return
    figures = dict(made.figures or {})
    outcome.embedded += sum((figures.pop("seconds", None) or {}).values())
    outcome.made += 1
    copy = Copy(job.model.id, job.recipient, job.file, made.sha256, made.part, Settings(**made.recipe), figures)
    ledger.accept(copy, job.order.copies)


def _tell_refusals(ledger: Ledger, outcome: Outcome) -> None:
    models = {model.id: model.name for model in ledger.models()}
    names = ledger.recipients()
    for (model, recipient), reason in ledger.refused().items():
        outcome.refused[f"{models[model]} for {names[recipient][0]}"] = reason


def _absolute(order: Order) -> Order:
    return replace(order, models=order.models.resolve(), copies=order.copies.resolve())


@contextmanager
def _copy_of(ledger: Path, copy: Path) -> Iterator[Ledger]:
    """A forecast leaves no trace: it works on a copy of the ledger, or on an empty one."""
    if ledger.is_file():
        with Ledger(ledger) as old:
            old.copy_to(copy)
    with Ledger(copy, create=True) as opened:
        yield opened


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Two runs at once into one folder would take each other's unfinished files away."""
    with (folder / ".lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise MeshmarkError(f"Another run is at work in '{folder}'.") from error
        yield


@contextmanager
def _client(scheduler: str | None, workers: int) -> "Iterator[Client]":
    import dask  # takes longer to load than most commands need
    from dask.distributed import Client, LocalCluster

    if scheduler:
        with Client(scheduler) as client:
            yield client
        return
    with (
        # A machine that slept, or a run that was paused, is no dead worker.
        dask.config.set({"distributed.scheduler.worker-ttl": None}),
        LocalCluster(
            n_workers=workers or os.cpu_count(), threads_per_worker=1, dashboard_address=None,
            silence_logs=logging.ERROR,
        ) as cluster,
        Client(cluster) as client,
    ):  # fmt: skip
        yield client
