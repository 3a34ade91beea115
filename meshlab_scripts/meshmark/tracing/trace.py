# SPDX-License-Identifier: GPL-3.0-or-later
"""From a found file to a recipient."""

from pathlib import Path

from ..catalog.ledger import Ledger
from ..errors import MeshmarkError
from ..formats import read_body
from ..key import Key
from ..shape.pieces import pieces
from .likeness import ranked
from .originals import unchanged
from .readings import plan, read
from .verdict import Trace, judge


def trace(found: Path, ledger: Ledger, key: Key, originals: Path | None = None) -> Trace:
    """Whose copy a file is. `originals` is the folder of the unmarked models: with these, where blind reading fails,
    parts and slightly bent copies are read too.

    :raises FormatError: where it cannot be read
    :raises MeshmarkError: where the ledger is empty, its copies were marked with another key, or none of the originals
        is what it was
    """
    if ledger.key_check is None or ledger.empty:
        raise MeshmarkError(f"The ledger '{ledger.path}' has no copies yet.")
    ledger.require(key)
    models = ledger.models()
    files = unchanged(originals, models) if originals else {}
    if originals and not files:
        raise MeshmarkError(f"None of the ledger's models is in '{originals}', or all have changed since.")
    parts = pieces(read_body(found))
    likes = {piece.name: ranked(piece, models) for piece in parts}
    evidence = read(plan(parts, likes, ledger.candidates(), files), key)
    return judge(evidence, likes, ledger)
