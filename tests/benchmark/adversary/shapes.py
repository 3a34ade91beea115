# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as arrays, the filters on them, and what an adversary knows of vertex norms without the key."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pymeshlab
from meshmark import host, plugin
from numpy.typing import NDArray

MESHES = Path(__file__).resolve().parents[3] / "build" / "data" / "meshes"
METHODS = ["Cho", "QSP", "L-M", "Geodesic", "Spectral", "Waves", "Layered"]
CARRIERS = (64, 96, 128)  # what Bits 0 takes for short messages
TRIMS = np.arange(0, 0.1501, 0.0025)  # what the key draws from
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """A triangle mesh."""

    points: Array
    faces: NDArray[np.int32]

    def at(self, points: Array) -> "Shape":
        return Shape(points, self.faces)

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    @property
    def face_normals(self) -> Array:
        """Twice the area long."""
        a, b, c = (self.points[self.faces[:, i]] for i in range(3))
        return np.cross(b - a, c - a)

    def on_vertices(self, of_faces: Array) -> Array:
        """Sums over the faces around each vertex."""
        sums = np.zeros((len(self.points), *of_faces.shape[1:]))
        for i in range(3):
            np.add.at(sums, self.faces[:, i], of_faces)
        return sums

    @property
    def normals(self) -> Array:
        normals = self.on_vertices(self.face_normals)
        return normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]


def opened(name: str) -> Shape:
    """A mesh of libcgal-demo."""
    with host.own_meshes() as meshes:
        host.read(meshes, MESHES / f"{name}.off")
        return _current(meshes)


def deformed(shape: Shape, seed: int) -> Shape:
    """Another of its family: bent and swollen by a few long waves."""
    draws = np.random.default_rng(seed)
    centre = shape.points.mean(axis=0)
    canonical = (shape.points - centre) / (shape.diagonal / 2)
    moves = np.zeros_like(canonical)
    for _ in range(6):
        wave, phase = draws.normal(size=3) * 2, draws.uniform(0, 2 * np.pi)
        moves += np.cos(canonical @ wave + phase)[:, None] * draws.normal(size=3) * 0.03
    return shape.at(shape.points + moves * shape.diagonal / 2)


def embed(shape: Shape, method: str, key: str, message: str = "id:4711", strength: float = 0) -> Shape:
    """:raises Refused: where the mesh cannot carry it"""
    return _filtered(shape, plugin.EMBED, method=method, key=key, message=message, strength=strength)


def attacked(shape: Shape, attack: str, amount: float, iterations: int = -1, seed: int = 1) -> Shape:
    return _filtered(shape, plugin.ATTACK, attack=attack, amount=amount, iterations=iterations, seed=seed)


def log_p(shape: Shape, method: str, key: str, message: str = "id:4711") -> float:
    """log10 of the bound that the message is there by chance."""
    with _layers(shape) as meshes:
        found = host.apply(meshes, plugin.DETECT, method=method, key=key, expected=message)
        return math.log10(max(float(found["p_value"]), 1e-300))


def mrms(shape: Shape, reference: Shape) -> float:
    """Over the diagonal."""
    with _layers(reference, shape) as meshes:
        return float(host.apply(meshes, plugin.MEASURE, reference=0)["mrms_relative"])


# What is public of vertex norms: all but the trim and the number of shells, and both can be tried.


@dataclass(frozen=True)
class Shells:
    """Shells of vertex norms as an adversary tries them."""

    count: int
    trim: float
    number: NDArray[np.int64]  # per vertex; -1 outside
    place: Array  # per vertex, in [0, 1] within its shell
    means: Array  # per shell, in standard errors from 1/2; 0 where it is empty
    width: float


def centre(shape: Shape) -> Array:
    weights = shape.on_vertices(np.linalg.norm(shape.face_normals, axis=1))
    return weights @ shape.points / weights.sum()


def norms_of(shape: Shape) -> Array:
    return np.linalg.norm(shape.points - centre(shape), axis=1)


def shells(norms: Array, count: int, trim: float) -> Shells:
    least, most = norms.min(), norms.max()
    low, high = least + trim * (most - least), most - trim * (most - least)
    place = (norms - low) / (high - low) * count
    number = np.where((place >= 0) & (place < count), np.floor(place), -1).astype(int)
    inside = number >= 0
    samples = np.bincount(number[inside], minlength=count)
    sums = np.bincount(number[inside], weights=(place - number)[inside], minlength=count)
    means = (sums / np.maximum(samples, 1) - 0.5) * np.sqrt(12 * samples)
    return Shells(count, trim, number, place - number, means, (high - low) / count)


def bimodality(means: Array) -> float:
    """How much likelier means are of two Gaussians, one on each side of 0, than of one: log of the ratio.

    The test of Yang, Pintus, Rushmeier and Ivrissimtzis (ICIP 2014), with both weights 1/2.
    """
    power = float(np.mean(means**2))
    if power == 0:
        return 0.0
    at = np.sqrt(power) * np.linspace(0, 0.98, 50)[:, None]
    variance = power - at**2
    ways = [-((means - side * at) ** 2) / (2 * variance) for side in (-1, 1)]
    of_two = (np.logaddexp(*ways) - np.log(2) - np.log(variance) / 2).sum(axis=1)
    return float(of_two.max() - of_two[0])


def likeliest_shells(shape: Shape) -> tuple[float, Shells]:
    """The shells that look the most marked, and how much."""
    tried = (shells(norms_of(shape), count, trim) for count in CARRIERS for trim in TRIMS)
    return max(((bimodality(one.means[one.means != 0]), one) for one in tried), key=lambda found: found[0])


def with_means(shape: Shape, shells: Shells, means: Array, part: float = 1) -> Shape:
    """The shape with other means of its shells, or `part` of the way there. Vertices slide along the surface as far as
    they can, as they do in L-M.
    """
    place = shells.place.copy()
    for number in range(shells.count):
        inside = shells.number == number
        if inside.any():
            place[inside] = _mapped(shells.place[inside], means[number])
    origin, norms = centre(shape), norms_of(shape)
    outward = (shape.points - origin) / norms[:, None]
    change = part * (place - shells.place) * shells.width
    away = shape.points + change[:, None] * _least_move(shape, outward) - origin
    return shape.at(origin + ((norms + change) / np.linalg.norm(away, axis=1))[:, None] * away)


def _mapped(values: Array, mean: float) -> Array:
    """x^beta with that mean."""
    low, high = 0.05, 20.0
    for _ in range(40):
        beta = np.sqrt(low * high)
        low, high = (beta, high) if np.mean(values**beta) > mean else (low, beta)
    return values**beta


def _least_move(shape: Shape, outward: Array) -> Array:
    """Per vertex the move that changes its norm by one and leaves the surface least; no longer than 5."""
    normals = shape.face_normals
    areas = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(areas, 1e-30)[:, None]
    form = shape.on_vertices(areas[:, None, None] * normals[:, :, None] * normals[:, None, :])
    form /= np.maximum(shape.on_vertices(areas), 1e-30)[:, None, None]
    moves = np.linalg.solve(0.98 * form + 0.02 * np.eye(3), outward[:, :, None])[:, :, 0]
    moves /= (moves * outward).sum(axis=1)[:, None]
    length = np.linalg.norm(moves, axis=1)[:, None]
    return np.where(length > 5, outward, moves)


@contextmanager
def _layers(*shapes: Shape) -> Iterator[pymeshlab.MeshSet]:
    """A MeshSet of shapes; the last is the current layer."""
    with host.own_meshes() as meshes:
        for shape in shapes:
            meshes.add_mesh(pymeshlab.Mesh(shape.points, shape.faces))
        yield meshes


def _current(meshes: pymeshlab.MeshSet) -> Shape:
    mesh = meshes.current_mesh()
    return Shape(mesh.vertex_matrix().copy(), mesh.face_matrix().copy())


def _filtered(shape: Shape, name: str, **values: host.Value) -> Shape:
    with _layers(shape) as meshes:
        host.apply(meshes, name, **values)
        return _current(meshes)
