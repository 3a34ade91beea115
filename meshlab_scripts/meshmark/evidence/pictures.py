# SPDX-License-Identifier: GPL-3.0-or-later
"""The found file, the model, and how far they are apart, as one picture."""

import io
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pymeshlab
from matplotlib import pyplot as plt
from numpy.typing import NDArray

from .. import host, plugin
from ..formats import read_body
from ..shape.alignment import laid_on
from .drawing import GREY, draw, rotation

Mesh = tuple[NDArray[np.float64], NDArray[np.int32]]
FAR = 2e-3  # of the diagonal: what the scale of colours ends at


def picture(found: Path, original: Path | None) -> bytes:
    """A PNG: the found file alone, or beside the model that it is laid on, and the distance between the two."""
    mesh = read_body(found).welded()
    if original is None:
        figure, axes = plt.subplots(figsize=(4.5, 4.2), layout="constrained")
        _plain(axes, _upright(mesh), "found")
        return _png(figure)
    model = read_body(original).welded()
    laid = laid_on(*mesh, *model)
    faces = mesh[1] if _same_sense(laid, mesh[1], model) else mesh[1][:, ::-1]
    view = _view(model[0])
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    _plain(axes[0], (laid @ view, faces), "found")
    _plain(axes[1], (model[0] @ view, model[1]), "the model, unmarked")
    diagonal = np.linalg.norm(np.ptp(model[0], axis=0))
    apart = _distances((laid, faces), model) / diagonal
    scale = mpl.cm.ScalarMappable(mpl.colors.Normalize(0, FAR * 1e3), "viridis")
    draw(axes[2], laid @ view, faces, scale.to_rgba(apart[faces].mean(axis=1) * 1e3)[:, :3] * 1.1)
    axes[2].set_title(f"distance from the model\nRMS {np.sqrt((apart**2).mean()):.1e} of the diagonal")
    figure.colorbar(scale, ax=axes[2], label="thousandths of the diagonal", shrink=0.8, extend="max")
    return _png(figure)


def _plain(axes: plt.Axes, mesh: Mesh, title: str) -> None:
    draw(axes, *mesh, np.tile(GREY, (len(mesh[1]), 1)))
    axes.set_title(title)


def _view(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The two longest axes across the page, a little from above: shows most of the body."""
    _, axes = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))
    turned = axes[:, [2, 1, 0]]
    if np.linalg.det(turned) < 0:
        turned[:, 2] *= -1
    return turned @ rotation(25, 15).T


def _upright(mesh: Mesh) -> Mesh:
    return mesh[0] @ _view(mesh[0]), mesh[1]


def _same_sense(points: NDArray[np.float64], faces: NDArray[np.int32], model: Mesh) -> bool:
    """Whether both have their outside on the same side: a mirror turns it."""
    volumes = [np.linalg.det((p - p.mean(axis=0))[f]).sum() for p, f in ((points, faces), model)]
    return volumes[0] * volumes[1] > 0


def _distances(mesh: Mesh, model: Mesh) -> NDArray[np.float64]:
    """Of each vertex to the model's surface."""
    with host.own_meshes() as meshes:
        meshes.add_mesh(pymeshlab.Mesh(*model))
        meshes.add_mesh(pymeshlab.Mesh(mesh[0], np.ascontiguousarray(mesh[1])))
        host.apply(meshes, plugin.MEASURE, reference=0, samples=1)
        return np.abs(meshes.current_mesh().vertex_scalar_array())


def _png(figure: plt.Figure) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=100, metadata={"Software": None})
    plt.close(figure)
    return buffer.getvalue()
