# SPDX-License-Identifier: GPL-3.0-or-later
"""The page: one HTML file with all in it."""

import base64
import html
from importlib import metadata, resources
from pathlib import Path
from string import Template

from ..bounds import odds, rounded_up
from ..catalog.ledger import Copy, Ledger, now
from ..catalog.plan import digest
from ..tracing import Answer, Trace
from ..tracing.originals import unchanged
from .pictures import picture

COLORS = {Answer.NAME: "#b2182b", Answer.NOBODY: "#1b7837", Answer.CANNOT_TELL: "#666666"}


def write_page(out: Path, found: Path, result: Trace, ledger: Ledger, originals: Path | None) -> None:
    """Writes what a trace found, with pictures, hashes, versions, and what would refute it."""
    model = result.model
    original = unchanged(originals, [model]).get(model.id) if originals and model else None
    template = Template(resources.files(__package__).joinpath("page.html").read_text(encoding="utf-8"))
    values = {
        "title": f"Whose copy is {found.name}?",
        "sentence": result.sentence,
        "shape": _shape(result),
        "tries": str(result.evidence.tries),
        "command": f"meshmark trace {found.name} --ledger {ledger.path.name} --key-file KEY"
        + (" --original FOLDER" if originals else ""),
    }
    blocks = {
        "color": COLORS[result.answer],
        "picture": base64.b64encode(picture(found, original)).decode(),
        "meaning": "".join(f"<p>{html.escape(text)}</p>" for text in _meaning(result)),
        "readings": "".join(f"<tr><td>{html.escape(str(one))}</td></tr>" for one in result.evidence.readings),
        "facts": "".join(
            f"<tr><th>{html.escape(name)}</th><td><code>{html.escape(value)}</code></td></tr>"
            for name, value in _facts(found, result, ledger).items()
        ),
    }
    escaped = {name: html.escape(text) for name, text in values.items()}
    out.write_text(template.substitute(escaped | blocks), encoding="utf-8")


def _meaning(result: Trace) -> list[str]:
    texts = [
        f"p = {rounded_up(result.p)}: were this file unmarked, marked with another key, or a copy of somebody who is "
        f"not among the {result.evidence.candidates:,} recipients, the probability that the message of any of them "
        f"could be read as well from it would be at most {odds(result.p)}. Somebody is named only below 1 in a million."
    ]
    if result.mixed:
        texts.append("More than one recipient's message reads beyond doubt: the file was made from several copies.")
    if result.answer == Answer.NOBODY:
        texts.append("The file is this model, changed so little that a mark of this key would be expected to read.")
    if result.answer == Answer.CANNOT_TELL:
        texts.append("That is no proof of innocence, and no suspicion against anybody.")
    return texts


def _shape(result: Trace) -> str:
    like = result.likeness
    if like is None:
        return "The file has no shape that could be compared."
    return (
        f"By moments of shape, which do not depend on size and place, {like.piece} and the ledger's model "
        f"'{like.model.name}' differ by {like.difference:.2%}, the area by {like.roughening:+.1%}."
    )


def _facts(found: Path, result: Trace, ledger: Ledger) -> dict[str, str]:
    facts = {
        "found file": found.name,
        "its SHA-256": digest(found),
        "ledger": str(ledger.path.name),
        "check of the key": ledger.key_check or "",
    }
    if result.model:
        facts |= {"model": result.model.name, "its SHA-256 at marking": result.model.sha256}
    copy = _copy(result, ledger)
    if copy:
        facts |= {
            "the recipient's copy": copy.file,
            "its SHA-256 when made": copy.sha256,
            "made": copy.made,
            "with": ", ".join(f"{name} {value}" for name, value in copy.recipe.values().items()),
            "its distance from the model (RMS, of the diagonal)": f"{copy.figures.get('mrms_relative', 0):.2e}",
        }
    return facts | {
        "meshmark": metadata.version("meshmark"),
        "pymeshlab": metadata.version("pymeshlab"),
        "plugin": next((one.report.version for one in result.evidence.readings if one.report), ""),
        "written": now(),
    }


def _copy(result: Trace, ledger: Ledger) -> Copy | None:
    """The entry of the one that is named."""
    if result.recipient is None or result.model is None:
        return None
    return next(
        copy
        for copy in ledger.copies()
        if copy.model == result.model.id and ledger.name(copy.recipient) == result.recipient
    )
