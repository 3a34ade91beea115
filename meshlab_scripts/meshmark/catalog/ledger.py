# SPDX-License-Identifier: GPL-3.0-or-later
"""The ledger: one SQLite file that says which recipient has which copy. Never the key.

It is written by one process, in transactions; killed at any time it is whole (SQLite's write-ahead log). A copy is
entered before its file appears under its name: so where there is a file there is an entry.
"""

import json
import os
import secrets
import sqlite3
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, Self

from ..errors import MeshmarkError
from ..key import Key
from ..settings import Settings

VERSION = 1
IDS = 2**32  # of messages `id:NUMBER`
_SCHEMA = """
CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE models (
    id INTEGER PRIMARY KEY, name TEXT NOT NULL, sha256 TEXT NOT NULL, bytes INTEGER NOT NULL, vertices INTEGER NOT NULL,
    faces INTEGER NOT NULL, unit TEXT NOT NULL, signature TEXT NOT NULL, UNIQUE (name, sha256));
CREATE TABLE recipients (
    id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, message INTEGER NOT NULL UNIQUE, added TEXT NOT NULL);
CREATE TABLE copies (
    model INTEGER NOT NULL REFERENCES models, recipient INTEGER NOT NULL REFERENCES recipients,
    file TEXT NOT NULL UNIQUE, sha256 TEXT NOT NULL, part TEXT, recipe TEXT NOT NULL, figures TEXT NOT NULL,
    made TEXT NOT NULL, PRIMARY KEY (model, recipient));
CREATE TABLE refusals (
    model INTEGER NOT NULL REFERENCES models, recipient INTEGER NOT NULL REFERENCES recipients, reason TEXT NOT NULL,
    at TEXT NOT NULL, PRIMARY KEY (model, recipient));
"""

_CURES = {
    sqlite3.SQLITE_BUSY: "Another program is at work in it. Try again when that is done.",
    sqlite3.SQLITE_CANTOPEN: "Make sure that the file and its folder can be read.",
    sqlite3.SQLITE_READONLY: "Make sure that the file and its folder can be written.",
    sqlite3.SQLITE_FULL: "Make room on its disk, and run the same again: it goes on from there.",
    sqlite3.SQLITE_IOERR: "Look after its disk, and run the same again: it goes on from there.",
}

Use = Literal["read", "write", "draft"]


@dataclass(frozen=True)
class Model:
    """A file of the catalogue, as it was when its first copy was ordered."""

    id: int
    name: str  # its path in the catalogue
    sha256: str
    bytes: int
    vertices: int
    faces: int
    unit: str
    signature: tuple[float, ...]


@dataclass(frozen=True)
class Copy:
    """An entry: a marked file, and what it was made with."""

    model: int
    recipient: int
    file: str  # in the folder of the copies
    sha256: str
    part: str | None  # where the file still lies that is to come under its name
    recipe: Settings
    figures: dict[str, object]
    made: str = ""  # when


class Ledger:
    """The file, open to `read`, or to `write` (a new one where there is none); or a `draft`, which is what is in the
    file, but leaves no trace of what is entered. `with` closes it.
    """

    def __init__(self, path: Path, use: Use = "read") -> None:
        if use == "read" and not path.is_file():
            raise MeshmarkError(f"There is no ledger '{path}'.")
        self.path = path
        try:
            with self._explained():
                self._sql = _connect(path, use)
            if use != "read":
                self._prepare()
            version = self._told("version")
        except sqlite3.DatabaseError as error:
            raise MeshmarkError(f"'{path}' is no ledger: {error}.") from error
        if version != str(VERSION):
            raise MeshmarkError(f"'{self.path}' is a ledger of another version of meshmark.")

    def _prepare(self) -> None:
        with self._transaction():
            if self._do("SELECT count(*) FROM sqlite_master").fetchone()[0] == 0:
                for statement in _SCHEMA.split(";"):
                    self._do(statement)
                self._tell("version", str(VERSION))
                self._tell("salt", secrets.token_hex(16))

    def _do(self, statement: str, values: Sequence[object] = ()) -> sqlite3.Cursor:
        with self._explained():
            return self._sql.execute(statement, values)

    @contextmanager
    def _explained(self) -> Iterator[None]:
        """A fault of the machine is no fault of the file."""
        try:
            yield
        except sqlite3.OperationalError as error:
            cure = _CURES.get(error.sqlite_errorcode & 0xFF)  # without what SQLite says closer
            if cure is None:
                raise
            raise MeshmarkError(f"The ledger '{self.path}' cannot be used: {error}. {cure}") from error

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._do("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            self._sql.rollback()
            raise
        self._do("COMMIT")

    def _tell(self, name: str, value: str) -> None:
        self._do("INSERT OR REPLACE INTO about VALUES (?, ?)", (name, value))

    def _told(self, name: str) -> str | None:
        row = self._do("SELECT value FROM about WHERE name = ?", (name,)).fetchone()
        return row[0] if row else None

    @property
    def salt(self) -> bytes:
        """Of the key's check."""
        return bytes.fromhex(self._told("salt") or "")

    @property
    def key_check(self) -> str | None:
        """What Key.check() gave for this ledger's key."""
        return self._told("key check")

    def require(self, key: Key) -> None:
        """Makes sure that this is the key.

        :raises MeshmarkError: where the copies so far were marked with another one
        """
        if not self.empty and key.check(self.salt) != self.key_check:
            raise MeshmarkError(f"The copies of '{self.path}' were marked with another key. Use that one.")

    def begin(self, key: Key, folder: Path) -> None:
        """Before copies are made: with this key, in this folder. As long as there are none, both may change.

        :raises MeshmarkError: where the copies so far were marked with another key, or lie in another folder
        """
        self.require(key)
        self._require_folder(folder)
        with self._transaction():
            check = key.check(self.salt)
            if check != self.key_check:
                self._tell("key check", check)
                self.forget_refusals()  # another key may do
            self._tell("folder", os.path.relpath(folder, self._home))

    def _require_folder(self, folder: Path) -> None:
        """What is on its way is looked for there alone; it may move, together with the ledger or without."""
        place = (self._home / (self._told("folder") or folder)).resolve()
        if place != folder and place.is_dir() and not self.empty:
            raise MeshmarkError(
                f"The copies of '{self.path}' are in '{place}', not in '{folder}'. Name that folder, or move it there."
            )

    @property
    def _home(self) -> Path:
        return self.path.resolve().parent

    def models(self) -> list[Model]:
        """All, the oldest first."""
        rows = self._do("SELECT * FROM models ORDER BY id")
        return [Model(*row[:-1], signature=tuple(json.loads(row[-1]))) for row in rows]

    def add_model(self, model: Model) -> Model:
        """A model that is new, or has changed; its `id` is given here."""
        with self._transaction():
            at = self._do(
                "INSERT INTO models VALUES (NULL, ?, ?, ?, ?, ?, ?, ?)",
                (model.name, model.sha256, model.bytes, model.vertices, model.faces, model.unit,
                 json.dumps(model.signature)),
            ).lastrowid  # fmt: skip
        return Model(at, *[getattr(model, name) for name in list(Model.__dataclass_fields__)[1:]])

    def recipients(self) -> dict[int, tuple[str, int]]:
        """Name and message by id."""
        return {row[0]: row[1:] for row in self._do("SELECT id, name, message FROM recipients")}

    def name(self, recipient: int) -> str:
        """Of one recipient."""
        return self._do("SELECT name FROM recipients WHERE id = ?", (recipient,)).fetchone()[0]

    def has(self, model: int, recipient: int, recipe: Settings) -> bool:
        """Whether this copy was made, with this recipe."""
        these = (model, recipient, _text(recipe))
        found = self._do("SELECT 1 FROM copies WHERE model = ? AND recipient = ? AND recipe = ?", these)
        return found.fetchone() is not None

    @property
    def empty(self) -> bool:
        """Whether there are no copies."""
        return self._do("SELECT 1 FROM copies LIMIT 1").fetchone() is None

    def add_recipients(self, names: Iterable[str]) -> None:
        """Gives those who are new a message each.

        Its number is drawn: then the chance that an innocent's reads as well as the leaker's is what the code promises
        of any two, and a copy does not tell how many there are.
        """
        with self._transaction():
            known = {name for (name,) in self._do("SELECT name FROM recipients")}
            used = {message for (message,) in self._do("SELECT message FROM recipients")}
            for name in names:
                if name in known:
                    continue
                while (message := secrets.randbelow(IDS)) in used:
                    pass
                used.add(message)
                self._do("INSERT INTO recipients (name, message, added) VALUES (?, ?, ?)", (name, message, now()))

    def done(self) -> set[tuple[int, int]]:
        """Model and recipient of every copy."""
        return set(self._do("SELECT model, recipient FROM copies"))

    def refused(self) -> dict[tuple[int, int], str]:
        """Why a copy could not be made, by model and recipient."""
        rows = self._do("SELECT model, recipient, reason FROM refusals")
        return {(model, recipient): reason for model, recipient, reason in rows}

    def copies(self) -> list[Copy]:
        """All, in the order of models and recipients."""
        rows = self._do(
            "SELECT model, recipient, file, sha256, part, recipe, figures, made FROM copies ORDER BY model, recipient"
        )
        return [
            Copy(*place, recipe=Settings(**json.loads(recipe)), figures=json.loads(figures), made=made)
            for *place, recipe, figures, made in rows
        ]

    def candidates(self) -> dict[Settings, dict[int, int]]:
        """Who has a copy of this recipe: recipient and message."""
        found: defaultdict[str, dict[int, int]] = defaultdict(dict)
        for text, recipient, message in self._do(
            "SELECT copies.recipe, recipients.id, recipients.message "
            "FROM copies JOIN recipients ON recipients.id = copies.recipient"
        ):
            found[text][recipient] = message
        return {Settings(**json.loads(text)): dict(sorted(found[text].items())) for text in sorted(found)}

    def files(self) -> set[str]:
        """The names of all copies."""
        return {name for (name,) in self._do("SELECT file FROM copies")}

    def accept(self, copy: Copy, folder: Path) -> None:
        """Enters a copy, and brings its file from where it lies to its name."""
        self._do(
            "INSERT INTO copies VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
            (copy.model, copy.recipient, copy.file, copy.sha256, copy.part, _text(copy.recipe),
             json.dumps(copy.figures), now()),
        )  # fmt: skip
        self._arrive(copy, folder)

    def refuse(self, model: int, recipient: int, reason: str) -> None:
        """Notes why a copy could not be made."""
        self._do("INSERT OR REPLACE INTO refusals VALUES (?, ?, ?, ?)", (model, recipient, reason, now()))

    def forget_refusals(self) -> None:
        """So that they are tried again."""
        self._do("DELETE FROM refusals")

    def settle(self, folder: Path) -> None:
        """After a crash: brings files to their names whose entry was made, and drops entries whose file is lost."""
        for copy in self.copies():
            if copy.part is None:
                continue
            if (folder / copy.part).is_file() or (folder / copy.file).is_file():
                self._arrive(copy, folder)
            else:
                self._do("DELETE FROM copies WHERE file = ?", (copy.file,))

    def _arrive(self, copy: Copy, folder: Path) -> None:
        part = folder / (copy.part or "")
        if part.is_file():
            _bring(part, folder / copy.file)
        self._do("UPDATE copies SET part = NULL WHERE file = ?", (copy.file,))
        self._do("DELETE FROM refusals WHERE model = ? AND recipient = ?", (copy.model, copy.recipient))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._sql.close()


def _text(recipe: Settings) -> str:
    return json.dumps(vars(recipe))


def _bring(part: Path, place: Path) -> None:
    part.replace(place)


def _connect(path: Path, use: Use) -> sqlite3.Connection:
    if use == "write":
        path.parent.mkdir(parents=True, exist_ok=True)
        sql = sqlite3.connect(path, isolation_level=None)
        sql.execute("PRAGMA journal_mode=WAL")
        sql.execute("PRAGMA synchronous=FULL")
        return sql
    if use == "draft":
        sql = sqlite3.connect(":memory:", isolation_level=None)
        if path.is_file():
            with closing(_connect(path, "read")) as old:
                old.backup(sql)
        return sql
    # Beside a file in a folder that cannot be written SQLite has no place for what it shares with other programs.
    alone = not os.access(path.parent, os.W_OK) and not path.with_name(f"{path.name}-wal").exists()
    address = f"{path.resolve().as_uri()}?mode=ro{'&immutable=1' if alone else ''}"
    return sqlite3.connect(address, uri=True, isolation_level=None)


def now() -> str:
    """UTC, to the second."""
    return datetime.now(UTC).isoformat(timespec="seconds")
