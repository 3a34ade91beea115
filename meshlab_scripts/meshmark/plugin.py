# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the plugin that this package was built with, and loads it into pymeshlab."""

import ctypes
import os
from importlib import metadata
from pathlib import Path

import pymeshlab

from .errors import MeshmarkError

NAME = "libfilter_watermark.so"
PACKAGE = Path(__file__).resolve().parent
# In this order: what the user names, what the wheel carries, what a checkout has built.
PLACES = (PACKAGE / NAME, PACKAGE.parents[1] / "build" / "meshlab-2025.07" / NAME)
SODIUM = PACKAGE / "libsodium.so.23"  # in the wheel only; elsewhere the system's

EMBED = "apply_coord_watermark"
DETECT = "get_watermark"
DETECT_WITH_ORIGINAL = "get_watermark_with_original"
ATTACK = "apply_watermark_attack"
MEASURE = "get_watermark_distortion"

NEEDED = {EMBED, DETECT, DETECT_WITH_ORIGINAL, ATTACK, MEASURE}


def path() -> Path:
    """The plugin's file: $MESHMARK_PLUGIN, that beside this module, or that of the checkout's build folder."""
    named = os.environ.get("MESHMARK_PLUGIN")
    for place in (Path(named),) if named else PLACES:
        if place.is_file():
            return place
    raise MeshmarkError(
        f"The plugin {named or NAME} is not there. Build it first (tests/run.sh, or meshlab_scripts/quickstart.sh), "
        "or name it in the environment variable MESHMARK_PLUGIN."
    )


def load(named: Path | None = None) -> None:
    """Loads it, or the one that is named, unless the process has one already."""
    if _missing() == set():
        return
    found = named or path()
    if SODIUM.is_file():
        ctypes.CDLL(str(SODIUM), mode=ctypes.RTLD_GLOBAL)
    try:
        pymeshlab.load_plugin(str(found))
    except pymeshlab.PyMeshLabException as error:
        raise MeshmarkError(f"pymeshlab {metadata.version('pymeshlab')} does not load {found}: {error}") from error
    if _missing():
        raise MeshmarkError(f"{found} lacks {', '.join(sorted(_missing()))}. Build the plugin of this version.")


def _missing() -> set[str]:
    return NEEDED - set(pymeshlab.filter_list())
