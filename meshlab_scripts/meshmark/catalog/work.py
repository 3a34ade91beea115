# SPDX-License-Identifier: GPL-3.0-or-later
"""One copy, made by a worker: marked, written, read again, and left beside its place under a name of its own."""

import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from .. import marking
from ..errors import MeshmarkError, MovesTooMuch, NotReadBack, Refused
from ..key import Key
from ..reports import EmbedReport
from ..settings import Settings
from .plan import Job, Order, digest

PART = ".part-"  # begins the names of files that are on their way


@dataclass(frozen=True)
class Made:
    """A copy that waits to be entered, or why there is none."""

    part: str = ""
    sha256: str = ""
    recipe: dict[str, object] | None = None
    figures: dict[str, object] | None = None
    seconds: float = 0
    error: str = ""


def make(job: Job, run: str) -> Made:
    """Makes it. Never raises for what concerns this copy alone."""
    began = time.perf_counter()
    target = job.order.copies / job.file
    part = target.with_name(f"{PART}{run}-{target.name}")
    try:
        _require_key(job)
        target.parent.mkdir(parents=True, exist_ok=True)
        report, settings = _marked(job, part)
        with part.open("rb") as file:
            os.fsync(file.fileno())
    except (MeshmarkError, OSError) as error:
        part.unlink(missing_ok=True)
        return Made(error=str(error), seconds=time.perf_counter() - began)
    kept = ("max_displacement", "mrms", "mrms_relative", "layers", "capacity", "warnings", "version", "seconds")
    return Made(
        part=part.relative_to(job.order.copies).as_posix(),
        sha256=digest(part),
        recipe=vars(replace(settings, bits=report.carriers)),
        figures={name: value for name, value in report.json().items() if name in kept},
        seconds=time.perf_counter() - began,
    )


def _marked(job: Job, part: Path) -> tuple[EmbedReport, Settings]:
    """By the first method that the model takes. Where it takes none, the error has the reason of each."""
    reasons = []
    for settings in _choices(job.order):
        try:
            report = marking.embed(
                job.source, part, message=job.message, key=job.order.key, strength=job.order.strength,
                max_move=job.order.max_move, **settings.values(),
            )  # fmt: skip
        except (Refused, MovesTooMuch, NotReadBack) as error:
            reasons.append((settings.method, error))
        else:
            return report, settings
    if len(reasons) == 1:
        raise reasons[0][1]
    raise Refused(" ".join(f"{method}: {error}" for method, error in reasons))


def _choices(order: Order) -> Iterator[Settings]:
    yield order.settings
    for method in order.otherwise:
        yield replace(order.settings, method=method)


def sweep(folder: Path) -> None:
    """Takes away what a run left that was killed."""
    for path in folder.rglob(".*"):
        if PART in path.name and path.is_file():
            path.unlink()


def _require_key(job: Job) -> None:
    if _check(job.order.key, job.salt) != job.key_check:
        raise MeshmarkError("This machine has another key than the ledger's.")


@lru_cache(maxsize=4)
def _check(key: Key, salt: bytes) -> str:
    return key.check(salt)
