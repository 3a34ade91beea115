# SPDX-License-Identifier: GPL-3.0-or-later
"""Who gets what: a CSV file with a recipient a line, and where a column `model` says so, with that model only."""

import csv
import unicodedata
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from ..errors import MeshmarkError


@dataclass(frozen=True)
class Recipient:
    """A name, and patterns of the models that go there; none: all models."""

    name: str
    models: tuple[str, ...]

    def gets(self, model: str) -> bool:
        """Whether a model, by its path in the catalogue, goes there."""
        return not self.models or any(fnmatchcase(model, pattern) for pattern in self.models)


def read_recipients(path: Path) -> list[Recipient]:
    """The column `recipient`, or else the first one; several lines of one name count together.

    :raises MeshmarkError: where the file is not there, is no CSV in UTF-8, or names nobody
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file, skipinitialspace=True))
    except OSError as error:
        raise MeshmarkError(f"The recipients cannot be read from '{path}': {error.strerror}.") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise MeshmarkError(f"'{path}' is no CSV file in UTF-8: {error}.") from error
    found: dict[str, list[str]] = {}
    everything: set[str] = set()
    for row in rows:
        name = unicodedata.normalize("NFC", (row.get("recipient") or next(iter(row.values()), None) or "").strip())
        if not name:
            continue
        model = (row.get("model") or "").strip()
        found.setdefault(name, [])
        if model:
            found[name].append(model)
        else:
            everything.add(name)
    if not found:
        raise MeshmarkError(f"'{path}' names nobody. Its first line names the columns, such as: recipient")
    return [Recipient(name, () if name in everything else tuple(models)) for name, models in found.items()]
