# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be made: the copies that recipients get and the ledger does not have yet."""

import hashlib
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from ..errors import FormatError, MeshmarkError
from ..formats import READERS, read_body
from ..key import Key
from ..length import Length
from ..settings import Settings
from ..shape.signature import body_signature
from .ledger import Ledger, Model
from .recipients import Recipient

Track = Callable[[Iterable[Path]], Iterable[Path]]


@dataclass(frozen=True)
class Order:
    """What the user asks for."""

    models: Path
    copies: Path
    recipients: list[Recipient]
    key: Key
    settings: Settings
    strength: float = 0
    max_move: Length | None = None
    otherwise: tuple[str, ...] = ()  # methods for models that refuse that of the settings, in this order


@dataclass(frozen=True)
class Job:
    """One copy. It can be sent to another machine that sees the same files; the key is not in it, only where it is."""

    model: Model
    recipient: int
    message: str
    source: Path
    file: str  # its name in the folder of the copies
    order: Order
    key_check: str
    salt: bytes

    @property
    def name(self) -> str:
        """Of this job among all."""
        return f"{self.model.id}-{self.recipient}"


def model_files(folder: Path) -> list[Path]:
    """All files below a folder that can be marked."""
    if not folder.is_dir():
        raise MeshmarkError(f"There is no folder '{folder}'.")
    files = sorted(path for path in folder.rglob("*") if path.suffix.lower() in READERS and path.is_file())
    if not files:
        raise MeshmarkError(f"'{folder}' has no models: {', '.join(READERS)}.")
    return files


def read_model(path: Path, folder: Path) -> Model:
    """What the ledger keeps of a model. It has no number yet.

    :raises FormatError: where it cannot be read
    """
    body = read_body(path)
    return Model(
        id=0,
        name=path.relative_to(folder).as_posix(),
        sha256=digest(path),
        bytes=path.stat().st_size,
        vertices=len(body.points),
        faces=len(body.faces),
        unit=body.unit,
        signature=tuple(body_signature(body).tolist()),
    )


def enter_models(ledger: Ledger, folder: Path, track: Track) -> tuple[list[Model], dict[str, str]]:
    """The models of a folder as the ledger knows them, those that are new or have changed too; and what is broken."""
    known = {(model.name, model.sha256): model for model in ledger.models()}
    models, broken = [], {}
    for path in track(model_files(folder)):
        name = path.relative_to(folder).as_posix()
        model = known.get((name, digest(path)))
        if model is None:
            try:
                model = ledger.add_model(read_model(path, folder))
            except FormatError as error:
                broken[name] = str(error)
                continue
        models.append(model)
    return models, broken


def missing_jobs(ledger: Ledger, order: Order, models: list[Model]) -> list[Job]:
    """The copies that are neither there nor refused before."""
    numbers = {name: (number, message) for number, (name, message) in ledger.recipients().items()}
    there = ledger.done() | ledger.refused().keys()
    taken = ledger.files()
    jobs = []
    for model in models:
        for recipient in order.recipients:
            number, message = numbers[recipient.name]
            if (model.id, number) in there or not recipient.gets(model.name):
                continue
            file = _free(f"{_folder(number, recipient.name)}/{model.name}", taken)
            taken.add(file)
            jobs.append(
                Job(model, number, f"id:{message}", order.models / model.name, file, order, ledger.key_check or "",
                    ledger.salt)
            )  # fmt: skip
    return jobs


def digest(path: Path) -> str:
    """SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _folder(number: int, name: str) -> str:
    """A recipient's folder: the number makes it unique, the name is for people."""
    plain = re.sub(r"[^\w.@+-]+", "-", name).strip("-.")[:60]
    return f"{number:04}-{plain}" if plain else f"{number:04}"


def _free(file: str, taken: set[str]) -> str:
    """The name itself, or with the next number where a model has changed since."""
    path, number = Path(file), 2
    while file in taken:
        file = path.with_name(f"{path.stem}-{number}{path.suffix}").as_posix()
        number += 1
    return file
