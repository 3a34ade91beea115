# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls the plugin's filters in pymeshlab, and keeps alive what pymeshlab goes on using after a failure.

pymeshlab 2025.7 keeps a pointer to the log of the MeshSet that last ran a filter that failed, and writes to it with the
next filter of any MeshSet. So those live on here; those that are our own are emptied first.
"""

import json
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pymeshlab

from . import plugin
from .errors import Failed, FormatError, Refused

Value = str | int | float | bool
Json = dict[str, object]

# All that pymeshlab raises; they have no class in common.
ERRORS = (
    pymeshlab.PyMeshLabException,
    pymeshlab.InvalidEnumException,
    pymeshlab.InvalidPercentageException,
    pymeshlab.MissingCompactnessException,
    pymeshlab.MissingComponentException,
)
_FAULTS = ("Not enough memory", "Internal error")  # so the plugin begins (filter_watermark.cpp, key.cpp)
_alive: list[pymeshlab.MeshSet] = []


@contextmanager
def own_meshes() -> Iterator[pymeshlab.MeshSet]:
    """A MeshSet of ours; emptied at the end, and never destroyed too early."""
    plugin.load()
    meshes = pymeshlab.MeshSet()
    try:
        yield meshes
    except Exception:
        _keep(meshes)
        raise
    finally:
        meshes.clear()


def read(meshes: pymeshlab.MeshSet, path: Path) -> None:
    """Adds the layers of a file.

    :raises FormatError: where it is not there, or pymeshlab cannot read it
    """
    if not path.is_file():
        raise FormatError(f"There is no file '{path}'.")
    try:
        meshes.load_new_mesh(str(path))
    except ERRORS as error:
        _keep(meshes)
        raise FormatError(f"'{path}' cannot be read: {_details(error)}") from error


def save(meshes: pymeshlab.MeshSet, path: Path) -> None:
    """Writes the current layer in a format of pymeshlab's.

    :raises FormatError: where it cannot
    """
    try:
        meshes.save_current_mesh(str(path))
    except ERRORS as error:
        _keep(meshes)
        raise FormatError(f"'{path}' cannot be written: {_details(error)}") from error


def apply(meshes: pymeshlab.MeshSet, name: str, **values: Value) -> Json:
    """Applies a filter to the current layer, and returns its numbers: those that pymeshlab's dict can hold.

    :raises Refused: with the filter's own words
    :raises Failed: likewise, where the mesh is not the cause
    """
    plugin.load()
    try:
        return dict(meshes.apply_filter(name, **values))
    except ERRORS as error:
        _keep(meshes)
        words = _details(error)
        raise (Failed if words.startswith(_FAULTS) else Refused)(words) from error


def apply_with_report(meshes: pymeshlab.MeshSet, name: str, **values: Value) -> Json:
    """Applies a filter, and returns its report with all texts."""
    with tempfile.TemporaryDirectory(prefix="meshmark-") as folder:
        report = Path(folder) / "report.json"
        apply(meshes, name, report=str(report), **values)
        return json.loads(report.read_text(encoding="utf-8"))


def _keep(meshes: pymeshlab.MeshSet) -> None:
    if not any(kept is meshes for kept in _alive):
        _alive.append(meshes)


def _details(error: Exception) -> str:
    """The cause, without pymeshlab's frame around it."""
    return str(error).partition("Details: ")[2].strip() or str(error).strip()
