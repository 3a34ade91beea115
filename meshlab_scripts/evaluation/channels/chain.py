# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten in a row: what a file may meet on its way through ten hands, none of which means any harm."""

from collections.abc import Callable
from dataclasses import replace

import pymeshlab
from meshmark import host, plugin

from .formats import round_trip
from .shape import Channel, Passage, Shape
from .tools import draco


def attacked(name: str, amount: float = -1, iterations: int = -1) -> Channel:
    """One of the plugin's attacks as a step."""

    def step(shape: Shape, passage: Passage) -> Shape:
        values = {"attack": name, "amount": amount, "iterations": iterations, "seed": passage.seed}
        with host.own_meshes() as meshes:
            meshes.add_mesh(pymeshlab.Mesh(shape.points, shape.faces))
            host.apply(meshes, plugin.ATTACK, **values)
            mesh = meshes.current_mesh()
            return Shape(mesh.vertex_matrix().copy(), mesh.face_matrix().copy())

    return step


def at(channel: Channel, amount: float) -> Channel:
    """A channel with an amount of its own as a step."""
    return lambda shape, passage: channel(shape, replace(passage, amount=amount))


STEPS: tuple[tuple[str, Callable[[Shape, Passage], Shape]], ...] = (
    ("quantized to 12 bits", attacked("Quantize", 12)),
    ("turned, moved and scaled", attacked("Similarity")),
    ("reordered", attacked("Reorder")),
    ("smoothed after Taubin, 5 rounds", attacked("Taubin", 0.5, 5)),
    ("noise of .05 %", attacked("Noise", 0.0005)),
    ("30 % of the faces removed", attacked("Simplify", 0.3)),
    ("through STL", round_trip("STL")),
    ("Draco at 12 bits", at(draco, 12)),
    ("edges split at their midpoints", attacked("Subdivide")),
    ("through 3MF", round_trip("3MF")),
)


def ten_in_a_row(shape: Shape, passage: Passage) -> Shape:
    """The first `iterations` of the STEPS, or all."""
    for _, step in STEPS[: passage.iterations if passage.iterations >= 0 else None]:
        shape = step(shape, passage)
    return shape
