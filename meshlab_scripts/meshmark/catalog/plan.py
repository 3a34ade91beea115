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
from .recipients import Recipient, fits

LOCK = ".meshmark.lock"  # in a folder of copies
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
class Item:
    """A copy that is ordered, whether it is there or not."""

    model: Model
    recipient: int
    name: str  # the recipient's
    message: str

    @property
    def at(self) -> tuple[int, int]:
        """Where the ledger has it."""
        return self.model.id, self.recipient

    def __str__(self) -> str:
        return f"{self.model.name} for {self.name}"


@dataclass(frozen=True)
class Job:
    """A copy to make. It can be sent to another machine that sees the same files; the key is not in it, only where it
    is.
    """

    item: Item
    source: Path
    file: str  # its name in the folder of the copies
    order: Order
    key_check: str
    salt: bytes

    @property
    def name(self) -> str:
        """Of this job among all."""
        return "{}-{}".format(*self.item.at)


def model_files(folder: Path, copies: Path) -> list[Path]:
    """All files below a folder that can be marked; not the copies of any run that lie there, and nothing hidden."""
    if not folder.is_dir():
        raise MeshmarkError(f"There is no folder '{folder}'.")
    if folder == copies:
        raise MeshmarkError(f"The copies would lie among the models in '{folder}'. Name a folder of their own.")
    below = {place for place in (copies, *(lock.parent for lock in folder.rglob(LOCK))) if folder in place.parents}
    files = sorted(
        path
        for path in folder.rglob("*")
        if path.suffix.lower() in READERS and path.is_file()
        if below.isdisjoint(path.parents) and not _hidden(path.relative_to(folder))
    )
    if not files:
        raise MeshmarkError(f"'{folder}' has no models: {', '.join(READERS)}.")
    return files


def _hidden(path: Path) -> bool:
    return any(part.startswith(".") for part in path.parts)


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


def enter_models(ledger: Ledger, order: Order, track: Track) -> tuple[list[Model], dict[str, str]]:
    """The models of an order as the ledger knows them, those that are new or have changed too; and what is broken.

    :raises MeshmarkError: where there are none, or not those that a recipient is to get
    """
    files = {path.relative_to(order.models).as_posix(): path for path in model_files(order.models, order.copies)}
    _require_models(order, list(files))
    known = {(model.name, model.sha256): model for model in ledger.models()}
    models, broken = [], {}
    for name, path in zip(files, track(files.values()), strict=True):
        try:
            model = known.get((name, digest(path))) or ledger.add_model(read_model(path, order.models))
        except (FormatError, OSError) as error:
            broken[name] = str(error)
        else:
            models.append(model)
    return models, broken


def _require_models(order: Order, names: list[str]) -> None:
    patterns = dict.fromkeys(pattern for recipient in order.recipients for pattern in recipient.models)
    missing = [f"'{pattern}'" for pattern in patterns if not any(fits(name, pattern) for name in names)]
    if missing:
        raise MeshmarkError(
            f"No model in '{order.models}' fits {', '.join(missing)}, which recipients are to get. Write it as the "
            f"model is called there, such as '{names[0]}'."
        )


def ordered(ledger: Ledger, order: Order, models: list[Model]) -> list[Item]:
    """Every copy that the recipients get."""
    numbers = {name: (number, f"id:{message}") for number, (name, message) in ledger.recipients().items()}
    return [
        Item(model, numbers[recipient.name][0], recipient.name, numbers[recipient.name][1])
        for model in models
        for recipient in order.recipients
        if recipient.gets(model.name)
    ]


def missing_jobs(ledger: Ledger, order: Order, items: list[Item]) -> list[Job]:
    """The copies that are neither there nor refused before.

    :raises MeshmarkError: where another file has the name of one
    """
    there = ledger.done() | ledger.refused().keys()
    taken = ledger.files()
    jobs = []
    for item in items:
        if item.at in there:
            continue
        file = _free(f"{_folder(item.recipient, item.name)}/{item.model.name}", taken)
        if (order.copies / file).exists():
            raise MeshmarkError(
                f"'{order.copies / file}' is there, and not in the ledger '{ledger.path}'. Name the ledger that it "
                "is in, or another folder for the copies, or move it away."
            )
        taken.add(file)
        jobs.append(Job(item, order.models / item.model.name, file, order, ledger.key_check or "", ledger.salt))
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
