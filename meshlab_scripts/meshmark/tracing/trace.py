# SPDX-License-Identifier: GPL-3.0-or-later
"""From a found file to a recipient: a name, nobody, or that it cannot be told.

Each piece of the file is read once for each recipe in the ledger, with all its recipients as candidates. A reading's p
counts the candidates; times the number of readings it bounds the chance that anyone at all is named wrongly.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path

import pymeshlab

from .. import host, marking
from ..catalog.ledger import Ledger, Model
from ..catalog.plan import digest
from ..errors import MeshmarkError, Refused
from ..formats import read_body
from ..key import Key
from ..reports import DetectReport
from ..settings import Settings
from ..shape.pieces import Piece, pieces
from .bounds import rounded_up
from .likeness import Likeness, nearest, ranked

PROVEN = 1e-6  # below it somebody is named
DOUBT = 1e-2  # below it "nobody" is not said either
REGISTERED = 2  # pieces, besides the whole, that are laid on originals
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
    original: Model | None  # blind without
    recipient: int | None = None  # the best candidate
    p: float = 1  # of that candidate; counts the candidates, not the readings
    runner_up_p: float = 1
    report: DetectReport | None = None
    refusal: str = ""

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
class Trace:
    """The answer, and all that it rests on."""

    answer: Answer
    sentence: str
    recipient: str | None = None
    mixed: bool = False  # another recipient reads beyond doubt, too: copies were averaged
    p: float = 1.0  # counts candidates and readings
    model: str | None = None
    likeness: Likeness | None = None
    piece: str = ""
    readings: list[Reading] = field(default_factory=list)
    tries: int = 1  # readings that were meant to be made; p counts them all
    candidates: int = 0
    ledger: str = ""

    def json(self) -> dict[str, object]:
        """For other programs."""
        like = self.likeness
        return {
            "answer": str(self.answer),
            "recipient": self.recipient,
            "mixed": self.mixed,
            "p": self.p,
            "model": self.model,
            "shape_difference": like.difference if like else None,
            "area_change": like.roughening if like else None,
            "piece": self.piece,
            "candidates": self.candidates,
            "tries": self.tries,
            "readings": [one.json() for one in self.readings],
            "sentence": self.sentence,
        }  # fmt: skip


def trace(found: Path, ledger: Ledger, key: Key, originals: Path | None = None) -> Trace:
    """Whose copy a file is. `originals` is the folder of the unmarked models: with these, where blind reading fails,
    parts and bent copies are read too.

    :raises FormatError: where it cannot be read
    :raises MeshmarkError: where the ledger is empty, its copies were marked with another key, or none of the originals
        is what it was
    """
    if ledger.key_check is None or ledger.empty:
        raise MeshmarkError(f"The ledger '{ledger.path}' has no copies yet.")
    ledger.require(key)
    parts = pieces(read_body(found))
    models = ledger.models()
    likes = {piece.name: nearest(piece, models) for piece in parts}
    groups = ledger.candidates()
    whole = likes[parts[0].name]
    in_order = (
        parts if whole and whole.alike else [*parts[1:], parts[0]]
    )  # what is no model is a plate of some, perhaps
    attempts = [_Attempt(piece, settings, group) for piece in in_order for settings, group in groups.items()]
    if originals is not None:
        files = _originals(originals, models)
        attempts += [
            replace(attempt, original=model, file=files[model.id])
            for attempt in attempts
            if attempt.piece in parts[: 1 + REGISTERED]
            for model in _likely_first(attempt.piece, models, files)
        ]
    candidates = len(set().union(*groups.values()))
    return _judge(list(_readings(attempts, key)), len(attempts), likes, ledger, candidates)


@dataclass(frozen=True)
class _Attempt:
    """What is read: a piece, for one recipe and those who have copies of it, blind or with an original."""

    piece: Piece
    settings: Settings
    group: dict[int, int]  # message by recipient
    original: Model | None = None
    file: Path | None = None


def _readings(attempts: list[_Attempt], key: Key) -> Iterator[Reading]:
    """One after the other, until one is proof. All that were meant to be read count in p, so that it stays a bound."""
    for attempt in attempts:
        reading = _read(attempt, key)
        yield reading
        if reading.p * len(attempts) < PROVEN:
            return


def _originals(folder: Path, models: list[Model]) -> dict[int, Path]:
    """The models' files, by the number of the model, where they are what they were."""
    files = {model.id: folder / model.name for model in models}
    found = {m.id: files[m.id] for m in models if files[m.id].is_file() and digest(files[m.id]) == m.sha256}
    if not found:
        raise MeshmarkError(f"None of the ledger's models is in '{folder}', or all have changed since.")
    return found


def _likely_first(piece: Piece, models: list[Model], files: dict[int, Path]) -> list[Model]:
    """The models whose originals are tried with a piece; a part is like none, so all are, the nearest first."""
    return [like.model for like in ranked(piece, models) if like.model.id in files]


def _read(attempt: _Attempt, key: Key) -> Reading:
    recipients = list(attempt.group)
    expected = [f"id:{message}" for message in attempt.group.values()]
    reading = Reading(attempt.piece.name, attempt.settings, attempt.original)
    with host.own_meshes() as meshes:
        meshes.add_mesh(pymeshlab.Mesh(attempt.piece.points, attempt.piece.faces))
        try:
            report = marking.detect(
                meshes, key=key, expected=expected, original=attempt.file, **attempt.settings.values()
            )
        except Refused as error:  # a piece that carries nothing says nothing
            return replace(reading, refusal=str(error))
    return replace(
        reading,
        recipient=recipients[report.candidate or 0],  # of one alone the filter gives no number
        p=1.0 if report.p_value is None else report.p_value,
        runner_up_p=report.runner_up_p or 1.0,
        report=report,
    )


def _judge(
    readings: list[Reading], tries: int, likes: dict[str, Likeness | None], ledger: Ledger, candidates: int
) -> Trace:
    best = min(readings, key=lambda one: one.p)
    p = min(1.0, best.p * tries)
    proven = p < PROVEN
    like = likes[best.piece]
    if not proven or like is None or not like.alike:
        near = [one for one in likes.values() if one and one.alike]
        like = min(near, key=lambda one: one.difference, default=like)
    facts = {"p": p, "likeness": like, "model": like.model.name if like and like.alike else None,
             "piece": best.piece, "readings": readings, "tries": tries, "ledger": str(ledger.path),
             "candidates": candidates}  # fmt: skip
    if proven:
        return _named(best, ledger, tries, facts)
    reports = [one.report for one in readings if one.report]
    doubt = _mark_without_name(reports, p, tries) or _doubtful_shape(like)
    if doubt:
        return Trace(Answer.CANNOT_TELL, f"Cannot tell. {doubt}", **facts)
    other = ", and seems to carry one of another key" if any(one.finding == ANOTHER_KEY for one in reports) else ""
    text = (
        f"It is '{like.model.name}' by its shape, little changed, and no mark of this ledger's key reads{other}: it is "
        "unmarked, not one of these copies, or its mark was taken out."
    )
    return Trace(Answer.NOBODY, f"Nobody. {text}", **facts)


def _mark_without_name(reports: list[DetectReport], p: float, tries: int) -> str:
    """What speaks for a mark of the ledger's key although nobody can be named; empty where nothing does."""
    verified = next((one.message for one in reports if one.p_message * tries < PROVEN), "")
    if verified:
        return f"It carries '{verified}' of this key (proven), but no copy in the ledger has that message."
    presence = min((one.presence or 1 for one in reports), default=1) * tries
    if presence < PROVEN:
        return (
            f"A mark of this key is there (p {rounded_up(presence)}), but whose it is does not come out: the copy is "
            "damaged, or several were mixed."
        )
    if p < DOUBT:
        return (
            f"One recipient's message reads better than chance (p {rounded_up(p)}), but not well enough to name "
            "anybody."
        )
    return ""


def _doubtful_shape(like: Likeness | None) -> str:
    """Why a mark that is not read may have been there; empty where the shape is that of a model, little changed."""
    if like is None or not like.alike:
        near_by = f"; the nearest, '{like.model.name}', is {like.difference:.0%} off" if like else ""
        return f"Its shape is none of the ledger's models{near_by}. It is another object, or a part of one."
    if not like.intact:
        return (
            f"It is '{like.model.name}' by its shape, but changed (shape {like.difference:.1%}, area "
            f"{like.roughening:+.1%}, {like.faces:.0%} of the faces): a mark may have been lost."
        )
    return ""


def _named(best: Reading, ledger: Ledger, tries: int, facts: dict[str, object]) -> Trace:
    name = ledger.name(best.recipient)
    like: Likeness | None = facts["likeness"]
    model = best.original or (like.model if like and like.alike else None)
    facts["model"] = model.name if model else None
    where = "" if best.piece == "the whole file" else f" In {best.piece}."
    if model is None or not ledger.has(model.id, best.recipient):
        text = (
            f"The message of {name} reads (p {rounded_up(facts['p'])}), but by its shape it is none of the models that "
            f"{name} has. Who has a copy can put its mark into another object: so nobody is named.{where}"
        )
        return Trace(Answer.CANNOT_TELL, f"Cannot tell. {text}", **facts)
    text = f"{name}: it is the copy of '{model.name}' for this recipient (p {rounded_up(facts['p'])}).{where}"
    mixed = best.runner_up_p * tries < PROVEN
    if mixed:
        text += " A second recipient reads beyond doubt, too: copies were mixed."
    return Trace(Answer.NAME, text, recipient=name, mixed=mixed, **facts)
