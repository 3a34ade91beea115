# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: the shape that is in them and what it shows, and the same files with other positions."""

import lzma
import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from xml.etree.ElementTree import ParseError
from zipfile import BadZipFile

import numpy as np

from ..errors import FormatError
from . import glb, hosted, obj, off, ply, stl, threemf
from .body import Body, Corners, Points, Skin, weld

READERS: dict[str, Callable[[Path], Body]] = {
    ".stl": stl.read,
    ".ply": ply.read,
    ".obj": obj.read,
    ".off": off.read,
    ".glb": glb.read,
    ".3mf": threemf.read,
}

# What broken files lead to: the language's own errors, and those of the libraries that read.
_BROKEN = (
    ArithmeticError, AttributeError, EOFError, LookupError, MemoryError, RuntimeError, TypeError, ValueError,
    BadZipFile, ParseError, lzma.LZMAError, struct.error, zlib.error,
)  # fmt: skip

__all__ = ["READERS", "Body", "Corners", "Points", "Skin", "read_body", "weld"]


def read_body(path: Path) -> Body:
    """The shape of a file, by its ending; what is none of ours MeshLab reads.

    :raises FormatError: where it is not there, or cannot be read
    """
    if not path.is_file():
        raise FormatError(f"There is no file '{path}'.")
    try:
        body = READERS.get(path.suffix.lower(), hosted.read)(path)
    except _BROKEN as error:
        why = str(error) or type(error).__name__
        raise FormatError(f"'{path}' cannot be read: it is broken ({why}). Export it anew.") from error
    if not np.isfinite(body.points).all():
        raise FormatError(f"'{path}' has coordinates that are no finite numbers. Remove these vertices first.")
    return body
