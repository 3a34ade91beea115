# SPDX-License-Identifier: GPL-3.0-or-later
"""What readings come to, in words: a name, nobody, or that it cannot be told."""

from dataclasses import dataclass
from enum import StrEnum

from ..bounds import rounded_up
from ..catalog.ledger import Ledger, Model
from ..reports import Finding
from .likeness import Likeness, Likes, nearest, of_one_shape
from .readings import PROVEN, Evidence, Reading

DOUBT = 1e-2  # below it "nobody" is not said either


class Answer(StrEnum):
    """The three answers."""

    NAME = "a name"
    NOBODY = "nobody"
    CANNOT_TELL = "cannot tell"


@dataclass(frozen=True)
class Trace:
    """The answer, and all that it rests on."""

    answer: Answer
    sentence: str
    evidence: Evidence
    model: Model | None = None  # that it is a copy of
    likeness: Likeness | None = None
    recipient: str | None = None
    mixed: bool = False  # another recipient reads beyond doubt, too: copies were averaged

    @property
    def p(self) -> float:
        """Counts candidates and readings."""
        return self.evidence.p

    def json(self) -> dict[str, object]:
        """For other programs."""
        like = self.likeness
        return {
            "answer": str(self.answer),
            "recipient": self.recipient,
            "mixed": self.mixed,
            "p": self.p,
            "model": self.model.name if self.model else None,
            "shape_difference": like.difference if like else None,
            "area_change": like.roughening if like else None,
            "piece": self.evidence.best.piece,
            "candidates": self.evidence.candidates,
            "tries": self.evidence.tries,
            "readings": [one.json() for one in self.evidence.readings],
            "sentence": self.sentence,
        }  # fmt: skip


def judge(evidence: Evidence, likes: Likes, ledger: Ledger) -> Trace:
    """Whose copy it is, by what was read and what shape it has."""
    return _of_a_message(evidence, likes, ledger) if evidence.p < PROVEN else _of_none(evidence, likes)


def _of_a_message(evidence: Evidence, likes: Likes, ledger: Ledger) -> Trace:
    """The message of a recipient is there for certain; the shape of that very piece tells whether in a copy of theirs.

    Who has a copy can put its mark into another object, and lay that beside a model.
    """
    best = evidence.best
    name, p = ledger.name(best.recipient), rounded_up(evidence.p)
    own = next(
        (like for like in _may_be(best, likes) if ledger.has(like.model.id, best.recipient, best.settings)), None
    )
    if own is None:
        like = None if best.of_some_part else nearest(likes[best.piece])
        reason = (
            "from a part of the file that is no piece by itself, so its shape cannot be compared. Save that part as a "
            "file, and trace that."
            if best.of_some_part
            else f"by its shape it is none of the copies that {name} has with such a mark. Who has a copy can put its "
            "mark into another object: so nobody is named."
        )
        text = f"Cannot tell. The message of {name} reads (p {p}), but {reason}{_in(best.piece)}"
        return Trace(Answer.CANNOT_TELL, text, evidence, _model(like), like)
    text = f"{name}: it is the copy of '{own.model.name}' for this recipient (p {p}).{_in(best.piece)}"
    mixed = evidence.bound(best.runner_up_p) < PROVEN
    if mixed:
        text += " A second recipient reads beyond doubt, too: copies were mixed."
    return Trace(Answer.NAME, text, evidence, own.model, own, name, mixed)


def _may_be(reading: Reading, likes: Likes) -> list[Likeness]:
    """The models that what was read may be a copy of, the nearest first: by its shape, or by the original on which it
    was laid.
    """
    if reading.of_some_part:
        return []
    if reading.original is None:
        return [like for like in likes[reading.piece] if like.alike]
    laid = [like for like in likes[reading.piece] if of_one_shape(like.model, reading.original)]
    return sorted(laid, key=lambda like: like.model != reading.original)


def _of_none(evidence: Evidence, likes: Likes) -> Trace:
    """Nobody's message is there for certain: nobody's copy, unless a mark may have been there."""
    near = [one for one in map(nearest, likes.values()) if one and one.alike]
    like = min(near, key=lambda one: one.difference, default=nearest(likes[evidence.best.piece]))
    bodies = _bodies(likes)
    doubts = [_mark_without_name(evidence), *(_doubtful_shape(piece, one) for piece, one in bodies)]
    doubt = next(filter(None, doubts), "")
    if doubt:
        return Trace(Answer.CANNOT_TELL, f"Cannot tell. {doubt}", evidence, _model(like), like)
    names = " and ".join(dict.fromkeys(f"'{one.model.name}'" for _, one in bodies))
    another = any(one.finding == Finding.ANOTHER_KEY for one in evidence.reports)
    text = (
        f"Nobody. It is {names} by its shape, little changed, and no mark of this ledger's key reads"
        f"{', and seems to carry one of another key' if another else ''}: it is unmarked, not one of these copies, or "
        "its mark was taken out."
    )
    return Trace(Answer.NOBODY, text, evidence, _model(like), like)


def _bodies(likes: Likes) -> list[tuple[str, Likeness | None]]:
    """What the file is, with the nearest model: the whole where that is like one, else the pieces of a plate."""
    whole, *pieces = [(piece, nearest(ranking)) for piece, ranking in likes.items()]
    return pieces if pieces and not _model(whole[1]) else [whole]


def _in(piece: str) -> str:
    return "" if piece == "the whole file" else f" In {piece}."


def _model(like: Likeness | None) -> Model | None:
    return like.model if like and like.alike else None


def _mark_without_name(evidence: Evidence) -> str:
    """What speaks for a mark of the ledger's key although nobody can be named; empty where nothing does."""
    verified = next((one.message for one in evidence.reports if evidence.bound(one.p_message) < PROVEN), "")
    if verified:
        return f"It carries '{verified}' of this key (proven), but no copy in the ledger has that message."
    presence = evidence.bound(min((one.presence for one in evidence.reports if one.presence is not None), default=1))
    if presence < PROVEN:
        return (
            f"A mark of this key is there (p {rounded_up(presence)}), but whose it is does not come out: the copy is "
            "damaged, or several were mixed."
        )
    if presence < DOUBT:
        return f"It looks as marked with this key more than chance would have it (p {rounded_up(presence)})."
    if evidence.p < DOUBT:
        return (
            f"One recipient's message reads better than chance (p {rounded_up(evidence.p)}), but not well enough to "
            "name anybody."
        )
    return ""


def _doubtful_shape(piece: str, like: Likeness | None) -> str:
    """Why a mark that is not read may have been there; empty where the shape is that of a model, little changed."""
    if like is None or not like.alike:
        near_by = f"; the nearest, '{like.model.name}', is {like.difference:.0%} off" if like else ""
        return f"Its shape is none of the ledger's models{near_by}. It is another object, or a part of one.{_in(piece)}"
    if not like.intact:
        return (
            f"It is '{like.model.name}' by its shape, but changed (shape {like.difference:.1%}, area "
            f"{like.roughening:+.1%}, {like.faces:.0%} of the faces): a mark may have been "
            f"lost.{_in(piece)}"
        )
    return ""
