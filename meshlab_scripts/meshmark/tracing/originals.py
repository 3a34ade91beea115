# SPDX-License-Identifier: GPL-3.0-or-later
"""The unmarked models, where they are at hand."""

from pathlib import Path

from ..catalog.ledger import Model
from ..catalog.plan import digest


def unchanged(folder: Path, models: list[Model]) -> dict[int, Path]:
    """The models' files in a folder, by the number of the model, where they are what they were at marking."""
    files = {model: folder / model.name for model in models}
    return {model.id: file for model, file in files.items() if file.is_file() and digest(file) == model.sha256}
