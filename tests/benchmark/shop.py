# SPDX-License-Identifier: GPL-3.0-or-later
"""A shop as the benchmarks need one: copies made by the catalogue's own code, and traced."""

import itertools
import os
from collections import defaultdict
from pathlib import Path

import meshmark
from meshmark.catalog import Ledger, Order, make_copies
from meshmark.catalog.recipients import Recipient
from meshmark.settings import Settings
from meshmark.tracing import Answer, trace

MESHES = Path(__file__).resolve().parents[2] / "build" / "data" / "meshes"
RECIPIENTS = 20


class Shop:
    """Models, a key, and copies, each of the next model for the next recipients."""

    def __init__(
        self, folder: Path, models: list[Path], copies: int, scheduler: str, settings: Settings | None = None
    ) -> None:
        self.models = folder / "models"
        self.models.mkdir(parents=True)
        for model in models:
            (self.models / model.name).write_bytes(model.read_bytes())
        self.key = meshmark.Key(f"file:{folder / 'secret.key'}")
        (folder / "secret.key").write_bytes(os.urandom(32))
        per_model = [len(range(n, copies, len(models))) for n in range(len(models))]
        buyers = itertools.cycle(f"buyer-{n}" for n in range(RECIPIENTS))
        orders = defaultdict(list)
        for model, count in zip(models, per_model, strict=True):
            for _ in range(count):
                orders[next(buyers)].append(model.name)
        recipients = [Recipient(name, tuple(names)) for name, names in orders.items()]
        self.ledger = folder / "ledger.sqlite"
        order = Order(self.models, folder / "out", recipients, self.key, settings or Settings(), otherwise=("L-M",))
        self.refused = make_copies(order, self.ledger, scheduler=scheduler).refused
        with Ledger(self.ledger) as ledger:
            names = {model.id: model for model in ledger.models()}
            self.copies = [(folder / "out" / c.file, ledger.name(c.recipient), names[c.model]) for c in ledger.copies()]

    def answer(self, found: Path, originals: bool = False) -> tuple[Answer, str | None]:
        """Whose copy it is."""
        with Ledger(self.ledger) as ledger:
            result = trace(found, ledger, self.key, self.models if originals else None)
        return result.answer, result.recipient
