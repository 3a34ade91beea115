# SPDX-License-Identifier: GPL-3.0-or-later
"""One run at a time where two would get into each other's way."""

import fcntl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import MeshmarkError


@contextmanager
def alone(lock: Path, where: str) -> Iterator[None]:
    """Holds the lock, which is gone with the process, however that ends; its file stays.

    :raises MeshmarkError: where another process holds it
    """
    lock.parent.mkdir(parents=True, exist_ok=True)
    with lock.open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise MeshmarkError(f"Another run is at work {where}. Wait for its end.") from error
        yield
