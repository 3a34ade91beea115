# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin's filters, and the numbers in their results."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pymeshlab
from meshmark import host
from meshmark.host import Value

Numbers = dict[str, float]


@contextmanager
def opened(*paths: Path) -> Iterator[pymeshlab.MeshSet]:
    """The meshes as layers 0, 1, ...; the last is the current one."""
    with host.own_meshes() as meshes:
        for path in paths:
            host.read(meshes, path)
        yield meshes


@contextmanager
def replaced(path: Path) -> Iterator[Path]:
    """A place of this process' own to write to. What is there at the end becomes the file: whole, or not at all."""
    part = path.with_name(f".{os.getpid()}-{path.name}")
    yield part
    part.replace(path)


def save(meshes: pymeshlab.MeshSet, path: Path) -> None:
    """Saves the current layer."""
    with replaced(path) as part:
        host.save(meshes, part)


def apply(meshes: pymeshlab.MeshSet, name: str, **values: Value) -> Numbers:
    """Applies a filter to the current layer."""
    results = host.apply(meshes, name, **values)
    return {
        field: float(value) for field, value in results.items() if np.isscalar(value) and not isinstance(value, str)
    }
