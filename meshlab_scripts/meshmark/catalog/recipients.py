# SPDX-License-Identifier: GPL-3.0-or-later
"""Who gets what: a CSV file with a recipient a line, and where a column `model` says so, with that model only."""

import csv
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import zip_longest
from pathlib import Path

from ..errors import MeshmarkError


@dataclass(frozen=True)
class Recipient:
    """A name, and patterns of the models that go there; none: all models."""

    name: str
    models: tuple[str, ...]

    def gets(self, model: str) -> bool:
        """Whether a model, by its path in the catalogue, goes there."""
        return not self.models or any(fits(model, pattern) for pattern in self.models)


def fits(model: str, pattern: str) -> bool:
    """Whether it is this model, or one of those that the pattern means."""
    model, pattern = unicodedata.normalize("NFC", model), unicodedata.normalize("NFC", pattern)
    return model == pattern or fnmatchcase(model, pattern)


def read_recipients(path: Path) -> list[Recipient]:
    """The column `recipient`, and `model` where there is one; several lines of one name count together.

    :raises MeshmarkError: where the file is not there, is no CSV in UTF-8, has no such column or a line that is not
        plain, or names nobody
    """
    found: dict[str, list[str]] = {}
    everything: set[str] = set()
    for name, model in _lines(path):
        found.setdefault(name, [])
        if model:
            found[name].append(model)
        else:
            everything.add(name)
    if not found:
        raise MeshmarkError(f"'{path}' names nobody. Its first line is 'recipient', and each other line a name.")
    return [Recipient(name, () if name in everything else tuple(models)) for name, models in found.items()]


def _lines(path: Path) -> Iterator[tuple[str, str]]:
    """The recipient and the model, which may be empty, of each line."""
    rows = iter(_rows(path))
    _, columns = next(rows, (0, ["recipient"]))
    names = [column.casefold() for column in columns]
    if "recipient" not in names:
        raise MeshmarkError(
            f"'{path}' has no column 'recipient', but {', '.join(map(repr, columns))}. Its first line names the "
            "columns: call that of the names 'recipient'."
        )
    for line, cells in rows:
        row = dict(zip_longest(names, cells, fillvalue=""))
        if any(cells[len(names) :]):
            raise MeshmarkError(f"Line {line} of '{path}' has more cells than columns. Put what has commas in quotes.")
        if not row["recipient"]:
            raise MeshmarkError(f"Line {line} of '{path}' names no recipient. Add the name, or take the line out.")
        yield unicodedata.normalize("NFC", row["recipient"]), row.get("model", "")


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """The number and the cells of each line that is not empty. Spreadsheets separate these by commas, semicolons or
    tabs: whichever are in the first line.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            separator = max(",;\t", key=file.readline().count)
            file.seek(0)
            reader = csv.reader(file, delimiter=separator, skipinitialspace=True)
            rows = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except OSError as error:
        raise MeshmarkError(f"The recipients cannot be read from '{path}': {error.strerror}.") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise MeshmarkError(f"'{path}' is no CSV file in UTF-8: {error}.") from error
    return [(line, cells) for line, cells in rows if any(cells)]
