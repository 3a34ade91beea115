# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin's four filters through pymeshlab."""

import os
from pathlib import Path

import numpy as np
import pymeshlab

Value = str | int | float | bool
Numbers = dict[str, float]

EMBED, DETECT, ATTACK, MEASURE = (
    "apply_coord_watermark",
    "get_watermark",
    "apply_watermark_attack",
    "get_watermark_distortion",
)
# pymeshlab keeps a pointer to the log of the MeshSet whose filter failed last, and writes to it: it must live on.
_failed: list[pymeshlab.MeshSet] = []
_loaded: set[Path] = set()


def load(plugin: Path) -> None:
    """Loads the plugin, once in a process. Raises where it has not all four filters."""
    if plugin in _loaded:
        return
    pymeshlab.load_plugin(str(plugin))
    missing = {EMBED, DETECT, ATTACK, MEASURE} - set(pymeshlab.filter_list())
    if missing:
        raise RuntimeError(f"{plugin} lacks {', '.join(sorted(missing))}. Build the plugin of this version.")
    _loaded.add(plugin)


def opened(*paths: Path) -> pymeshlab.MeshSet:
    """The meshes as layers 0, 1, ...; the last is the current one."""
    meshes = pymeshlab.MeshSet()
    for path in paths:
        meshes.load_new_mesh(str(path))
    return meshes


def save(meshes: pymeshlab.MeshSet, path: Path) -> None:
    """Saves the current layer; the file is there whole, or not at all."""
    part = path.with_name(f".{os.getpid()}-{path.name}")
    meshes.save_current_mesh(str(part))
    part.replace(path)


def embed(meshes: pymeshlab.MeshSet, **values: Value) -> Numbers:
    """Watermark: Embed."""
    return _apply(meshes, EMBED, values)


def detect(meshes: pymeshlab.MeshSet, **values: Value) -> Numbers:
    """Watermark: Detect."""
    return _apply(meshes, DETECT, values)


def attack(meshes: pymeshlab.MeshSet, **values: Value) -> Numbers:
    """Watermark: Attack."""
    return _apply(meshes, ATTACK, values)


def distortion(meshes: pymeshlab.MeshSet, **values: Value) -> Numbers:
    """Watermark: Measure Distortion."""
    return _apply(meshes, MEASURE, values)


def _apply(meshes: pymeshlab.MeshSet, name: str, values: dict[str, Value]) -> Numbers:
    try:
        results = meshes.apply_filter(name, **values)
    except pymeshlab.PyMeshLabException:
        _failed[:] = [meshes]
        raise
    return {
        field: float(value) for field, value in results.items() if np.isscalar(value) and not isinstance(value, str)
    }
