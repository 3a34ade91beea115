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
    """A passphrase, `file:PATH` (what is in that file) or `env:NAME`, as in the plugin's dialog."""

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
        """The secret that the plugin derives its key from, byte for byte (key_from_text() in vcg_ext/key/key.cpp).

        All that is typed is in Unicode's composed form. A file counts without the end of its last line, which editors
        add and drop; a variable counts as it is. What is empty is no key.
        """
        text = unicodedata.normalize("NFC", self._source)
        if text.startswith("file:"):
            return _read_file(text.removeprefix("file:"))
        if text.startswith("env:"):
            return _read_environment(text.removeprefix("env:"))
        return text.encode()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Key) and self._source == other._source

    def __hash__(self) -> int:
        return hash(self._source)

    def __repr__(self) -> str:
        return f"Key({self._source!r})" if self.is_reference else "Key(a passphrase)"


def _read_file(path: str) -> bytes:
    try:
        secret = Path(path).read_bytes().removesuffix(b"\n").removesuffix(b"\r")
    except OSError as error:
        raise MeshmarkError(f"The key file '{path}' cannot be read: {error.strerror}.") from error
    if not secret:
        raise MeshmarkError(f"The key file '{path}' is empty. Write the secret into it, or name another.")
    return secret


def _read_environment(name: str) -> bytes:
    secret = os.environb.get(os.fsencode(name))
    if not secret:
        raise MeshmarkError(f"The environment variable '{name}', which should hold the key, is not set.")
    return secret


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
