# SPDX-License-Identifier: GPL-3.0-or-later
"""From a found file to a recipient: a name, nobody, or that it cannot be told.

Each piece of the file is read once for each recipe in the ledger, with all its recipients as candidates. A reading's p
counts the candidates; times the number of readings it bounds the chance that anyone at all is named wrongly.
"""

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path

import numpy as np
import pymeshlab

from .. import host, marking
from ..catalog.ledger import Ledger
from ..errors import MeshmarkError, Refused
from ..formats import read_body
from ..key import Key
from ..reports import DetectReport
from ..settings import Settings
from ..shape.pieces import Piece, pieces
from .likeness import Likeness, nearest

PROVEN = 1e-6  # below it somebody is named
DOUBT = 1e-2  # below it "nobody" is not said either
ANOTHER_KEY = 3  # DetectReport.finding


class Answer(StrEnum):
    """The three answers."""

    NAME = "a name"
    NOBODY = "nobody"
    CANNOT_TELL = "cannot tell"


@dataclass(frozen=True)
class Reading:
    """One piece read with one recipe, blind or with the original."""

    piece: str
    settings: Settings
    way: str  # "blind", "with the original"
    recipient: int | None  # the best candidate
    p: float  # of that candidate; counts the candidates, not the readings
    runner_up_p: float
    report: DetectReport | None
    refusal: str = ""


@dataclass(frozen=True)
class Trace:
    """The answer, and all that it rests on."""

    answer: Answer
    sentence: str
    recipient: str | None = None
    others: list[str] = field(default_factory=list)  # who read beyond doubt as well: averaged copies
    p: float = 1.0  # counts candidates and readings
    model: str | None = None
    likeness: Likeness | None = None
    piece: str = ""
    readings: list[Reading] = field(default_factory=list)
    candidates: int = 0

    def json(self) -> dict[str, object]:
        """For other programs."""
        like = self.likeness
        return {
            "answer": str(self.answer),
            "recipient": self.recipient,
            "others": self.others,
            "p": self.p,
            "model": self.model,
            "shape_difference": like.difference if like else None,
            "area_change": like.roughening if like else None,
            "piece": self.piece,
            "candidates": self.candidates,
            "readings": [
                {"piece": one.piece, "way": one.way, "p": one.p, "runner_up_p": one.runner_up_p,
                 "verdict": one.report.verdict if one.report else one.refusal, **one.settings.values()}
                for one in self.readings
            ],
            "sentence": self.sentence,
        }  # fmt: skip


def trace(found: Path, ledger: Ledger, key: Key) -> Trace:
    """Whose copy a file is.

    :raises FormatError: where it cannot be read
    :raises MeshmarkError: where the ledger is empty, or its copies were marked with another key
    """
    if ledger.key_check is None or not ledger.done():
        raise MeshmarkError(f"The ledger '{ledger.path}' has no copies yet.")
    ledger.require(key)
    parts = pieces(read_body(found))
    models = ledger.models()
    likes = {piece.name: nearest(piece, models) for piece in parts}
    groups = _candidates(ledger)
    readings = [_read(piece, settings, group, key) for piece in parts for settings, group in groups]
    return _judge(readings, likes, ledger, sum(len(group) for _, group in groups))


def _candidates(ledger: Ledger) -> list[tuple[Settings, list[tuple[int, int]]]]:
    """Recipients and their messages, for each recipe that the ledger's copies were made with."""
    return [(settings, sorted(group.items())) for settings, group in ledger.candidates().items()]


def _read(piece: Piece, settings: Settings, group: list[tuple[int, int]], key: Key) -> Reading:
    expected = [f"id:{message}" for _, message in group]
    with host.own_meshes() as meshes:
        meshes.add_mesh(pymeshlab.Mesh(piece.points, piece.faces))
        try:
            report = marking.detect(meshes, key=key, expected=expected, **settings.values())
        except Refused as error:  # a piece that carries nothing says nothing
            return Reading(piece.name, settings, "blind", None, 1, 1, None, str(error))
    best = None if report.candidate is None else group[report.candidate][0]
    p = 1.0 if report.p_value is None else report.p_value
    return Reading(piece.name, settings, "blind", best, p, report.runner_up_p or 1, report)


def _judge(readings: list[Reading], likes: dict[str, Likeness | None], ledger: Ledger, candidates: int) -> Trace:
    tries = len(readings)
    best = min(readings, key=lambda one: one.p)
    p = min(1.0, best.p * tries)
    proven = p < PROVEN and best.recipient is not None
    like = likes[best.piece]
    if not proven or like is None or not like.alike:
        near = [one for one in likes.values() if one and one.alike]
        like = min(near, key=lambda one: one.difference, default=like)
    facts = {"p": p, "likeness": like, "model": like.model.name if like and like.alike else None,
             "piece": best.piece, "readings": readings, "candidates": candidates}  # fmt: skip
    if proven:
        return _named(best, ledger, tries, facts)
    reports = [one.report for one in readings if one.report]
    doubt = _mark_without_name(reports, p, tries) or _doubtful_shape(like)
    if doubt:
        return Trace(Answer.CANNOT_TELL, f"Cannot tell. {doubt}", **facts)
    other = ", but seems to carry one of another key" if any(one.finding == ANOTHER_KEY for one in reports) else ""
    text = f"It is '{like.model.name}' by its shape, little changed, and carries no mark of this ledger's key{other}."
    return Trace(Answer.NOBODY, f"Nobody. {text}", **facts)


def _mark_without_name(reports: list[DetectReport], p: float, tries: int) -> str:
    """What speaks for a mark of the ledger's key although nobody can be named; empty where nothing does."""
    verified = next((one.message for one in reports if one.p_message * tries < PROVEN), "")
    if verified:
        return f"It carries '{verified}' of this key (proven), but no copy in the ledger has that message."
    presence = min((one.presence or 1 for one in reports), default=1) * tries
    if presence < PROVEN:
        return (
            f"A mark of this key is there (p {_p(presence)}), but whose it is does not come out: the copy is damaged, "
            "or several were mixed."
        )
    if p < DOUBT:
        return f"One recipient's message reads better than chance (p {_p(p)}), but not well enough to name anybody."
    return ""


def _doubtful_shape(like: Likeness | None) -> str:
    """Why a mark that is not read may have been there; empty where the shape is that of a model, little changed."""
    if like is None or not like.alike:
        near_by = f"; the nearest, '{like.model.name}', is {like.difference:.0%} off" if like else ""
        return f"Its shape is none of the ledger's models{near_by}. It is another object, or a part of one."
    if not like.intact:
        return (
            f"It is '{like.model.name}' by its shape, but changed (shape {like.difference:.1%}, area "
            f"{like.roughening:+.1%}): a mark may have been lost."
        )
    return ""


def _named(best: Reading, ledger: Ledger, tries: int, facts: dict[str, object]) -> Trace:
    names = ledger.recipients()
    name = names[best.recipient][0]
    like: Likeness | None = facts["likeness"]
    has = like is not None and like.alike and (like.model.id, best.recipient) in ledger.done()
    what = (
        f"of '{like.model.name}'" if has else "of one of the models (by its shape it is none that this recipient has)"
    )
    where = "" if best.piece == "the whole file" else f" In {best.piece}."
    mixed = best.runner_up_p * tries < PROVEN
    text = f"{name}: it is the copy {what} for this recipient (p {_p(facts['p'])})." + where
    if mixed:
        text += f" A second recipient reads beyond doubt, too (p {_p(best.runner_up_p * tries)}): copies were mixed."
    return Trace(Answer.NAME, text, recipient=name, others=["a second recipient"] if mixed else [], **facts)


def _p(p: float) -> str:
    """Rounded up, so that it stays a bound."""
    if p >= 1:
        return "1"
    power = int(np.floor(np.log10(p)))
    return f"{np.ceil(p / 10.0**power - 1e-9):.0f}e{power}"
