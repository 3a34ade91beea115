# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that a shape keeps when it is moved, turned, mirrored, scaled, marked or remeshed.

Moments of the solid and of its surface: roots of the second moments about the principal axes, the size of the third
ones, and area, in units of the radius of the ball of the same volume. B. Mirtich, Fast and accurate computation of
polyhedral mass properties (1996), has the integrals; open surfaces are closed by fans first.
"""

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError
from ..formats import Body

Array = NDArray[np.float64]
Faces = NDArray[np.int32]

# Points and weights of a rule on the triangle that is exact to degree 4 (Dunavant 1985).
_A, _B, _WA, _WB = 0.445948490915965, 0.091576213509771, 0.223381589678011, 0.109951743655322
_RULE = np.array(
    [[_A, _A, 1 - 2 * _A], [_A, 1 - 2 * _A, _A], [1 - 2 * _A, _A, _A],
     [_B, _B, 1 - 2 * _B], [_B, 1 - 2 * _B, _B], [1 - 2 * _B, _B, _B]]
)  # fmt: skip
_WEIGHTS = np.array([_WA] * 3 + [_WB] * 3)

ROUGHNESS = 0  # the place of the area, which noise changes long before the others


def signature(points: Array, faces: Faces) -> Array:
    """Eleven numbers; points and faces of a welded mesh."""
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    areas = np.linalg.norm(normals, axis=1)
    area = areas.sum()
    if not area > 0 or not np.isfinite(area):
        raise FormatError("The mesh has no surface.")
    samples = np.einsum("sk,fkc->fsc", _RULE, corners).reshape(-1, 3)
    on_surface = (areas[:, None] * _WEIGHTS).ravel()

    radius, solid_second, solid_third = _solid(closed(points, faces), points.mean(axis=0), area)
    middle = on_surface @ samples / area
    about = samples - middle
    surface_second = np.einsum("n,na,nb->ab", on_surface, about, about) / area
    surface_third = np.einsum("n,na,nb,nc->abc", on_surface, about, about, about) / area
    size = np.sqrt(np.trace(surface_second))
    spread = np.sqrt(on_surface @ (about**2).sum(axis=1) ** 2 / area) / size**2
    return np.concatenate(
        [
            [np.sqrt(area / (4 * np.pi)) / radius],
            _roots(solid_second) / radius,
            _roots(surface_second) / size,
            [np.cbrt(np.linalg.norm(solid_third)) / radius, np.cbrt(np.linalg.norm(surface_third)) / size],
            [size / radius, spread],
        ]
    )


def body_signature(body: Body) -> Array:
    """The same of a file's body."""
    return signature(*body.welded())


def _solid(corners: Array, origin: Array, area: float) -> tuple[float, Array, Array]:
    """Radius of the ball of as much volume (a flat sheet: area), second and third central moments (a sheet: 0)."""
    cones = corners - origin
    volumes = np.linalg.det(cones) / 6
    volume = volumes.sum()
    if abs(volume) < 1e-6 * area**1.5:
        return float(np.sqrt(area / (4 * np.pi))), np.zeros((3, 3)), np.zeros((3, 3, 3))
    # The tetrahedron from the origin over a face is that face in all sizes t from 0 to 1, weighed by 3 V t^2.
    points = np.einsum("sk,fkc->fsc", _RULE, cones).reshape(-1, 3)
    weights = (volumes[:, None] * _WEIGHTS).ravel() / volume
    centre = 3 / 4 * weights @ points
    second = 3 / 5 * np.einsum("n,na,nb->ab", weights, points, points) - np.outer(centre, centre)
    third = 3 / 6 * np.einsum("n,na,nb,nc->abc", weights, points, points, points)
    return float(np.cbrt(abs(volume) * 3 / (4 * np.pi))), second, _central(third, second, centre)


def closed(points: Array, faces: Faces) -> Array:
    """The corners of the triangles, and of fans that close every loop of the border to its middle."""
    from scipy.sparse import coo_array  # takes longer to load than most commands need
    from scipy.sparse.csgraph import connected_components

    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    count = len(points)
    there, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    border = edges[~np.isin(there, back)]
    corners = points[faces]
    if not len(border):
        return corners
    graph = coo_array((np.ones(len(border)), (border[:, 0], border[:, 1])), shape=(count, count))
    _, loop = connected_components(graph, directed=False)
    of_edge = loop[border[:, 0]]
    starts = points[border[:, 0]]
    number = np.bincount(of_edge, minlength=loop.max() + 1)
    middles = np.stack([np.bincount(of_edge, starts[:, axis], len(number)) for axis in range(3)], axis=1)
    middles /= np.maximum(number, 1)[:, None]
    fans = np.stack([points[border[:, 1]], starts, middles[of_edge]], axis=1)
    return np.concatenate([corners, fans])


def difference(one: Array, other: Array) -> float:
    """The largest relative difference of shape; the area is left out, since noise changes it."""
    scale = np.maximum(np.abs(one), np.abs(other))
    apart = np.abs(one - other) / np.where(scale > 0, np.maximum(scale, 0.1), 1)
    return float(np.delete(apart, ROUGHNESS).max()) if np.isfinite(apart).all() else np.inf


def roughening(found: Array, model: Array) -> float:
    """How much more surface there is than on the model, as a part: noise roughens, smoothing does the opposite."""
    return float((found[ROUGHNESS] / model[ROUGHNESS]) ** 2 - 1)


def _central(third: Array, second: Array, centre: Array) -> Array:
    """Third moments about the centre, from those about the origin."""
    mixed = np.einsum("ab,c->abc", second, centre)
    return (
        third
        - mixed
        - np.transpose(mixed, (0, 2, 1))
        - np.transpose(mixed, (2, 0, 1))
        - np.einsum("a,b,c->abc", centre, centre, centre)
    )


def _roots(moments: Array) -> Array:
    return np.sqrt(np.abs(np.linalg.eigvalsh(moments)))
