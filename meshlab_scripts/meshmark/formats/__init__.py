# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: the shape that is in them and what it shows, and the same files with other positions."""

from collections.abc import Callable
from pathlib import Path

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

__all__ = ["READERS", "Body", "Corners", "Points", "Skin", "read_body", "weld"]


def read_body(path: Path) -> Body:
    """The shape of a file, by its ending; what is none of ours MeshLab reads.

    :raises FormatError: where it is not there, or cannot be read
    """
    if not path.is_file():
        raise FormatError(f"There is no file '{path}'.")
    try:
        return READERS.get(path.suffix.lower(), hosted.read)(path)
    except (ValueError, KeyError, IndexError, TypeError, OverflowError) as error:  # what broken files lead to
        raise FormatError(f"'{path}' cannot be read: it is broken ({error}).") from error
