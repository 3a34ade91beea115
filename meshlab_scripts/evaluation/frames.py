# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a mesh lies: centre and principal axis of its volume, of its surface, and of its vertices (Figure 3.12)."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
WAYS = ("volume", "surface", "vertices")


def frames(points: Array, faces: NDArray[np.int32]) -> dict[str, tuple[Array, Array]]:
    """Centre and principal axis in each of the WAYS."""
    corners = points[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    tetrahedra = np.einsum("ij,ij->i", corners[:, 0], across) / 6
    areas = np.linalg.norm(across, axis=1) / 2
    # A simplex of n corners (the origin is a corner of each tetrahedron): mean of x is sum/n, of xx' is
    # (sum of vv' + sum sum') / (n (n + 1)).
    return {
        "volume": _frame(corners, tetrahedra, 4),
        "surface": _frame(corners, areas, 3),
        "vertices": _frame(points[:, None, :], np.ones(len(points)), 1),
    }


def _frame(corners: Array, weights: Array, simplex: int) -> tuple[Array, Array]:
    sums = corners.sum(axis=1)
    centre = weights @ sums / (simplex * weights.sum())
    second = np.einsum("i,ica,icb->ab", weights, corners, corners) + np.einsum("i,ia,ib->ab", weights, sums, sums)
    covariance = second / (simplex * (simplex + 1) * weights.sum()) - np.outer(centre, centre)
    return centre, np.linalg.eigh(covariance)[1][:, -1]


def shift(before: tuple[Array, Array], after: tuple[Array, Array]) -> tuple[float, float]:
    """Distance of the centres, and angle between the principal axes in degrees."""
    cosine = min(1.0, abs(float(before[1] @ after[1])))
    return float(np.linalg.norm(after[0] - before[0])), float(np.degrees(np.arccos(cosine)))
