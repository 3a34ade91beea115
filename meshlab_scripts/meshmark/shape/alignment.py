# SPDX-License-Identifier: GPL-3.0-or-later
"""Lays a found mesh on a model, whatever its size, place and chirality. For pictures only: no reading rests on it."""

from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]
SAMPLES = 4000
STEPS = 30


def laid_on(found: Array, found_faces: Array, model: Array, model_faces: Array) -> Array:
    """The points of `found` moved by the similarity that brings it nearest.

    Starts from the principal axes of the surfaces in their eight senses, goes on by iterated closest points (Besl and
    McKay 1992) with Umeyama's similarity (1991), and from the best of these by distances to planes (Chen and Medioni
    1991), which lets a part slide to its place.
    """
    samples, normals = _samples(model, model_faces)
    target = cKDTree(samples)
    some, _ = _samples(found, found_faces)
    frame, goal = _frame(some), _frame(samples)
    starts = []
    for signs in product((1, -1), repeat=3):
        linear = goal[1] @ np.diag(signs) @ frame[1].T * (goal[2] / frame[2])
        offset = goal[0] - linear @ frame[0]
        for _ in range(STEPS):
            _, nearest = target.query(some @ linear.T + offset)
            linear, offset = _similarity(some, samples[nearest], np.linalg.det(linear) < 0)
        starts.append((float(target.query(some @ linear.T + offset)[0].mean()), linear, offset))
    _, linear, offset = min(starts, key=lambda start: start[0])
    for _ in range(2 * STEPS):
        moved = some @ linear.T + offset
        _, nearest = target.query(moved)
        step, shift = _slide(moved, samples[nearest], normals[nearest])
        linear, offset = step @ linear, step @ offset + shift
    return found @ linear.T + offset


def _samples(points: Array, faces: Array) -> tuple[Array, Array]:
    """Evenly over the surface, the same every time; and the normals there."""
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    rng = np.random.default_rng(0)
    edges = np.cumsum(areas) / areas.sum()
    chosen = np.minimum(np.searchsorted(edges, (np.arange(SAMPLES) + 0.5) / SAMPLES), len(faces) - 1)
    u, v = np.sqrt(rng.random(SAMPLES)), rng.random(SAMPLES)
    weights = np.stack([1 - u, u * (1 - v), u * v], axis=1)
    return np.einsum("nk,nkc->nc", weights, corners[chosen]), normals[chosen] / areas[chosen, None]


def _slide(points: Array, nearest: Array, normals: Array) -> tuple[Array, Array]:
    """A small turn, shift and change of size that brings the points nearest to the planes; far ones count less."""
    apart = np.einsum("na,na->n", nearest - points, normals)
    spread = 1.5 * np.median(np.abs(apart)) + 1e-12
    weights = 1 / (1 + (apart / (2 * spread)) ** 2)
    middle = points.mean(axis=0)
    arms = points - middle
    columns = np.column_stack([np.cross(arms, normals), normals, np.einsum("na,na->n", arms, normals)])
    found, *_ = np.linalg.lstsq(columns * weights[:, None], apart * weights, rcond=None)
    x, y, z = found[:3]
    turn, _ = np.linalg.qr(np.array([[1, -z, y], [z, 1, -x], [-y, x, 1]]))
    turn *= np.sign(np.diag(turn))
    linear = (1 + found[6]) * turn
    return linear, middle - linear @ middle + found[3:6]


def _frame(points: Array) -> tuple[Array, Array, float]:
    """Middle, axes (columns) and size."""
    middle = points.mean(axis=0)
    _, axes = np.linalg.eigh(np.cov((points - middle).T))
    return middle, axes, float(np.sqrt(((points - middle) ** 2).sum(axis=1).mean()))


def _similarity(source: Array, target: Array, mirrored: bool) -> tuple[Array, Array]:
    """The least-squares similarity, of the chirality that is given."""
    a, b = source.mean(axis=0), target.mean(axis=0)
    u, values, vt = np.linalg.svd((target - b).T @ (source - a) / len(source))
    sense = np.ones(3)
    if (np.linalg.det(u @ vt) < 0) != mirrored:
        sense[2] = -1
    scale = (values * sense).sum() / ((source - a) ** 2).sum(axis=1).mean()
    linear = scale * (u * sense) @ vt
    return linear, b - linear @ a
