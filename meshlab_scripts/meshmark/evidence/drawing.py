# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaded pictures of meshes by matplotlib alone."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from numpy.typing import NDArray

mpl.use("Agg")
Array = NDArray[np.float64]

LIGHT = np.array([-0.4, 0.5, 0.77])
GREY = np.array([0.82, 0.82, 0.82])


def rotation(yaw: float, pitch: float) -> Array:
    """The view: turns about the vertical axis, then about the horizontal one; angles in degrees."""
    a, b = np.radians([yaw, pitch])
    about_y = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    about_x = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    return about_x @ about_y


def draw(axes: Axes, points: Array, faces: NDArray[np.int32], colors: Array) -> None:
    """Faces that look at us, from back to front, shaded by a lamp at the viewer's left."""
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    shade = 0.35 + 0.65 * np.clip(normals @ LIGHT, 0, 1)
    front = normals[:, 2] > 0
    order = np.argsort(corners[front, :, 2].mean(axis=1))
    shaded = np.clip(colors[front] * shade[front, None], 0, 1)[order]
    triangles = corners[front][order, :, :2]
    axes.add_collection(PolyCollection(triangles, facecolors=shaded, edgecolors=shaded, linewidths=0.2))
    axes.set_xlim(points[:, 0].min(), points[:, 0].max())
    axes.set_ylim(points[:, 1].min(), points[:, 1].max())
    axes.set_aspect("equal")
    axes.axis("off")
