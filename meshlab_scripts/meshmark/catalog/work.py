# SPDX-License-Identifier: GPL-3.0-or-later
"""One copy, made by a worker: marked, written, read again, and left beside its place under a name of its own."""

import os
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from .. import marking
from ..errors import FormatError, MeshmarkError, MovesTooMuch, NotReadBack, Refused
from ..key import Key
from ..reports import EmbedReport
from ..settings import Settings
from .plan import Job, Order, digest

PART = ".part-"  # begins the names of files that are on their way
REFUSALS = (Refused, MovesTooMuch, NotReadBack)


@dataclass(frozen=True)
class Made:
    """A copy that waits to be entered, or why there is none."""

    part: str = ""
    sha256: str = ""
    recipe: dict[str, object] | None = None
    figures: dict[str, Any] | None = None
    seconds: float = 0
    refusal: str = ""  # of the model itself: so it would be again
    failure: str = ""  # of this machine, here and now: another run may succeed


def make(job: Job, run: str) -> Made:
    """Makes it. Never raises for what concerns this copy alone."""
    began = time.perf_counter()
    target = job.order.copies / job.file
    part = target.with_name(f"{PART}{run}-{target.name}")
    try:
        _require_inputs(job, run)
        target.parent.mkdir(parents=True, exist_ok=True)
        report, settings = _marked(job, part)
        with part.open("rb") as file:
            os.fsync(file.fileno())
    except (MeshmarkError, OSError) as error:
        with suppress(OSError):
            part.unlink()
        kind = "refusal" if _lasts(error) else "failure"
        return Made(**{kind: str(error)}, seconds=time.perf_counter() - began)
    kept = ("max_displacement", "mrms", "mrms_relative", "layers", "capacity", "warnings", "version", "seconds")
    return Made(
        part=part.relative_to(job.order.copies).as_posix(),
        sha256=digest(part),
        recipe=vars(replace(settings, bits=report.carriers)),
        figures={name: value for name, value in report.json().items() if name in kept},
        seconds=time.perf_counter() - began,
    )


def _lasts(error: Exception) -> bool:
    """Whether this model would be refused again; a file that could not be written is the machine's fault."""
    return isinstance(error, (*REFUSALS, FormatError)) and not isinstance(error.__cause__, OSError)


def _marked(job: Job, part: Path) -> tuple[EmbedReport, Settings]:
    """By the first method that the model takes. Where it takes none, the error has the reason of each."""
    reasons = []
    for settings in _choices(job.order):
        try:
            report = marking.embed(
                job.source, part, message=job.item.message, key=job.order.key, strength=job.order.strength,
                max_move=job.order.max_move, **settings.values(),
            )  # fmt: skip
        except REFUSALS as error:
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


def _require_inputs(job: Job, run: str) -> None:
    """Other machines may see another key, or another file, and a file may have changed since the run began."""
    if _check(job.order.key, job.salt, run) != job.key_check:
        raise MeshmarkError("This machine has another key than the ledger's.")
    if digest(job.source) != job.item.model.sha256:
        raise MeshmarkError(f"'{job.source}' is not the model that it was when the run began.")


@lru_cache(maxsize=4)
def _check(key: Key, salt: bytes, run: str) -> str:
    """Once a run: it takes as long as a small copy."""
    return key.check(salt)
