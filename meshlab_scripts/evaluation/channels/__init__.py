# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file goes through in the real world: formats, Draco, slicers, editors. A protocol names them as attacks."""

from functools import cache
from pathlib import Path

from meshmark import formats

from ..jobs import digest
from .chain import ten_in_a_row
from .formats import FORMATS, round_trip
from .shape import Channel, Shape
from .solid import hollowed, in_units
from .tools import ToolMissing, decimated, draco, exported, remeshed

CHANNELS: dict[str, Channel] = {
    "Draco": draco,
    **{kind: round_trip(kind) for kind in FORMATS},
    "PrusaSlicer STL": exported("STL"),
    "PrusaSlicer 3MF": exported("3MF"),
    "Blender remesh": remeshed,
    "Blender decimate": decimated,
    "Hollow": hollowed,
    "Units": in_units,
    "Ten": ten_in_a_row,
}


@cache
def code_digest() -> str:
    """A hash of what channels are made of: the code of this folder, and of meshmark's formats."""
    folders = (Path(__file__).parent, Path(formats.__file__).parent)
    return digest(*(path for folder in folders for path in sorted(folder.glob("*.py"))))


__all__ = ["CHANNELS", "Channel", "Shape", "ToolMissing", "code_digest"]
