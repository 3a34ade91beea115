# SPDX-License-Identifier: GPL-3.0-or-later
"""The secret: where it comes from, and how it reaches the filter without passing through any log, file or history."""

import hashlib
import itertools
import os
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .errors import MeshmarkError

VARIABLE = "WATERMARK_KEY"
_number = itertools.count()


class Key:
    """A passphrase, `file:PATH` (that file's bytes) or `env:NAME`, as in the plugin's dialog."""

    def __init__(self, source: str) -> None:
        if not source:
            raise MeshmarkError(f"The key is empty. Name a key file, or set the environment variable {VARIABLE}.")
        self._source = source

    @property
    def is_reference(self) -> bool:
        """Whether this only says where the key is, so that it may be sent to another process."""
        return self._source.startswith(("file:", "env:"))

    @contextmanager
    def lent(self) -> Iterator[str]:
        """What the filter gets. pymeshlab keeps a history of all parameters, so a passphrase is lent by environment."""
        if self.is_reference:
            yield self._source
            return
        name = f"MESHMARK_KEY_{os.getpid()}_{next(_number)}"
        os.environ[name] = unicodedata.normalize("NFC", self._source)
        try:
            yield f"env:{name}"
        finally:
            del os.environ[name]

    def check(self, salt: bytes) -> str:
        """Eight digits that tell another key from this one, and nothing about it: 2^32 keys have the same."""
        secret = hashlib.scrypt(self._bytes(), salt=salt, n=2**15, r=8, p=1, maxmem=2**26, dklen=4)
        return secret.hex()

    def _bytes(self) -> bytes:
        kind, _, rest = self._source.partition(":")
        try:
            if kind == "file":
                return Path(rest).read_bytes()
            if kind == "env":
                return os.environ[rest].encode()
        except OSError as error:
            raise MeshmarkError(f"The key file '{rest}' cannot be read: {error.strerror}.") from error
        except KeyError as error:
            raise MeshmarkError(f"The environment variable '{rest}', which should hold the key, is not set.") from error
        return unicodedata.normalize("NFC", self._source).encode()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Key) and self._source == other._source

    def __hash__(self) -> int:
        return hash(self._source)

    def __repr__(self) -> str:
        return f"Key({self._source!r})" if self.is_reference else "Key(a passphrase)"


def find_key(key: "Key | str | None", key_file: Path | None = None) -> Key:
    """The key that is meant: this one, that of the file, or that of the environment variable WATERMARK_KEY."""
    if isinstance(key, Key):
        return key
    if key is not None:
        return Key(key)
    if key_file is not None:
        return Key(f"file:{key_file.resolve()}")
    if not os.environ.get(VARIABLE):
        raise MeshmarkError(f"There is no key. Name a key file, or set the environment variable {VARIABLE}.")
    return Key(f"env:{VARIABLE}")
