# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth closed bodies of our own, without symmetry, small and quick to mark."""

from pathlib import Path

import numpy as np
import trimesh


def body(number: int, level: int = 4) -> trimesh.Trimesh:
    """A bumpy ellipsoid, another for each number; 2,562 vertices at level 4."""
    ball = trimesh.creation.icosphere(level)
    x, y, z = ball.vertices.T
    a, b, c = np.random.default_rng(number).uniform(2, 4, 3)
    radius = 1 + 0.15 * x - 0.1 * y * z + 0.12 * y**3 + 0.08 * z**2 * x
    radius += 0.06 * np.sin(a * x + 1) * np.cos(b * y) + 0.05 * np.sin(c * z - b * y + 2)
    ball.vertices = ball.vertices * radius[:, None] * [50, 50 * (0.6 + 0.02 * (number % 7)), 25]
    return ball


def write_bodies(folder: Path, numbers: range) -> list[Path]:
    """Binary STL files of them."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"body{number}.stl" for number in numbers]
    for number, path in zip(numbers, paths, strict=True):
        body(number).export(path)
    return paths
