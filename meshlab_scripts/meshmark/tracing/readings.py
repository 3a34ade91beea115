# SPDX-License-Identifier: GPL-3.0-or-later
"""What is tried, and what is read.

Each piece of the file is read once for each recipe in the ledger, with all its recipients as candidates. A reading's p
counts the candidates; times the number of readings it bounds the chance that anyone at all is named wrongly.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import pymeshlab

from .. import host, marking
from ..catalog.ledger import Model
from ..errors import Refused
from ..key import Key
from ..reports import DetectReport, Finding
from ..settings import Settings
from ..shape.pieces import Piece
from .likeness import Likes, nearest

PROVEN = 1e-6  # below it somebody is named, and no more is read
REGISTERED = 2  # pieces, besides the whole, that are laid on originals


@dataclass(frozen=True)
class Attempt:
    """What is to be read: a piece, for one recipe and those who have copies of it, blind or with an original."""

    piece: Piece
    settings: Settings
    group: dict[int, int]  # message by recipient
    original: Model | None = None
    file: Path | None = None


@dataclass(frozen=True)
class Reading:
    """One piece read with one recipe, blind or with the original."""

    piece: str
    settings: Settings
    original: Model | None  # blind without
    recipient: int | None = None  # the best candidate
    p: float = 1  # of that candidate; counts the candidates, not the readings
    runner_up_p: float = 1
    report: DetectReport | None = None
    refusal: str = ""

    @property
    def of_some_part(self) -> bool:
        """Whether the filter read parts of the piece by themselves: then its shape is not that of what was read."""
        return self.original is None and self.report is not None and bool(self.report.parts)

    def json(self) -> dict[str, object]:
        """For other programs."""
        return {
            "piece": self.piece,
            "original": self.original.name if self.original else None,
            "p": self.p,
            "runner_up_p": self.runner_up_p,
            "verdict": self.report.verdict if self.report else self.refusal,
            **self.settings.values(),
        }

    def __str__(self) -> str:
        way = f"with the original '{self.original.name}'" if self.original else "blind"
        return f"{self.piece}, {self.settings.method}, {way}: {self.report.verdict if self.report else self.refusal}"


@dataclass(frozen=True)
class Evidence:
    """All that was read."""

    readings: list[Reading]
    tries: int  # readings that were meant to be made; p counts them all
    candidates: int

    @property
    def best(self) -> Reading:
        """The one that says the most of anybody."""
        return min(self.readings, key=lambda one: one.p)

    @property
    def p(self) -> float:
        """Of that one; counts candidates and readings."""
        return self.bound(self.best.p)

    @property
    def reports(self) -> list[DetectReport]:
        """Of the pieces that could be read at all."""
        return [one.report for one in self.readings if one.report]

    def bound(self, p: float) -> float:
        """Of one reading, whichever it is."""
        return min(1.0, p * self.tries)


def plan(
    parts: list[Piece], likes: Likes, groups: dict[Settings, dict[int, int]], files: dict[int, Path]
) -> list[Attempt]:
    """What is tried, the likeliest first. `files` are the originals at hand, by the number of the model."""
    whole = nearest(likes[parts[0].name])
    in_order = parts if whole and whole.alike else [*parts[1:], parts[0]]  # no model: a plate of some, perhaps
    blind = [Attempt(piece, settings, group) for piece in in_order for settings, group in groups.items()]
    laid = [
        replace(attempt, original=like.model, file=files[like.model.id])
        for attempt in blind
        if attempt.piece in parts[: 1 + REGISTERED]
        for like in likes[attempt.piece.name]  # a part is like none: all are tried
        if like.model.id in files
    ]
    return blind + laid


def read(attempts: list[Attempt], key: Key) -> Evidence:
    """Reads until one is proof of which piece it is. All that were meant to be read count in p, so that it stays a
    bound.
    """
    candidates = len(set().union(*(attempt.group for attempt in attempts)))
    return Evidence(list(_readings(attempts, key)), len(attempts), candidates)


def _readings(attempts: list[Attempt], key: Key) -> Iterator[Reading]:
    for attempt in attempts:
        reading = _read(attempt, key)
        yield reading
        if reading.p * len(attempts) < PROVEN and not reading.of_some_part:
            return


def _read(attempt: Attempt, key: Key) -> Reading:
    expected = [f"id:{message}" for message in attempt.group.values()]
    if len(expected) == 1:
        expected *= 2  # p of a list is a bound for copies of others, too, that of one message is not
    reading = Reading(attempt.piece.name, attempt.settings, attempt.original)
    with host.own_meshes() as meshes:
        meshes.add_mesh(pymeshlab.Mesh(attempt.piece.points, attempt.piece.faces))
        try:
            report = marking.detect(
                meshes, key=key, expected=expected, original=attempt.file, **attempt.settings.values()
            )
        except Refused as error:  # a piece that carries nothing says nothing
            return replace(reading, refusal=str(error))
    recipient, p = _who(report, attempt.group)
    runner_up_p = 1.0 if report.runner_up_p is None else report.runner_up_p
    return replace(reading, recipient=recipient, p=p, runner_up_p=runner_up_p, report=report)


def _who(report: DetectReport, group: dict[int, int]) -> tuple[int | None, float]:
    """The best candidate, and its p. But nobody where another message is proven: the best candidate's is near to it, no
    more.
    """
    if report.finding == Finding.ANOTHER_MESSAGE:
        return None, 1.0
    best = list(group)[(report.candidate or 0) % len(group)]
    return best, 1.0 if report.p_value is None else report.p_value
