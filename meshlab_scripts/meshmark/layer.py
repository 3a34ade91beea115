# SPDX-License-Identifier: GPL-3.0-or-later
"""A body as a layer of MeshLab's, and what has become of it there."""

from dataclasses import dataclass
from typing import Self

import numpy as np
import pymeshlab
from numpy.typing import NDArray

from .formats import Body, Corners, Points, Skin, weld


@dataclass(frozen=True)
class Layer:
    """Its vertices are the places of the body, apart where they show different colours or pictures."""

    body: Body
    place_of_point: NDArray[np.int64]
    vertex_of_corner: NDArray[np.int64]  # faces x 3
    held: Skin  # as the host rounds it

    @classmethod
    def add(cls, meshes: pymeshlab.MeshSet, body: Body) -> Self:
        """Makes it the current layer."""
        points, place = weld(body.points)
        vertex = place[body.faces]
        values: dict[str, NDArray[np.float64]] = {}
        skin = body.skin
        told_apart = [vertex.reshape(-1, 1)]
        if skin.colors is not None:
            told_apart.append(np.round(skin.colors.reshape(-1, 4) * 255) / 255)  # the host would round down
        if skin.picture is not None:
            told_apart.append(np.repeat(skin.picture, 3)[:, None])
        if len(told_apart) > 1:
            rows, numbers = np.unique(np.hstack(told_apart), axis=0, return_inverse=True)
            points, vertex = points[rows[:, 0].astype(np.int64)], numbers.reshape(-1, 3)
            if skin.colors is not None:
                values["v_color_matrix"] = rows[:, 1:5]
            if skin.picture is not None:  # as quality, for want of another place
                values["v_scalar_array"] = rows[:, -1]
        if skin.texture is not None:
            values["w_tex_coords_matrix"] = skin.texture.reshape(-1, 2)
        meshes.add_mesh(pymeshlab.Mesh(points, vertex.astype("int32"), **values))
        return cls(body, place, vertex, _skin(meshes.current_mesh(), vertex, skin))

    def moved(self, mesh: pymeshlab.Mesh) -> tuple[Points, Skin]:
        """The body's points, and its skin, as the mesh has them now; where it left them alone as they were."""
        places = np.empty((self.place_of_point.max() + 1, 3))
        places[self.place_of_point] = self.body.points
        places[self.place_of_point[self.body.faces]] = mesh.vertex_matrix()[self.vertex_of_corner]
        now = _skin(mesh, self.vertex_of_corner, self.body.skin)
        own = self.body.skin
        return places[self.place_of_point], Skin(
            _changed(own.texture, self.held.texture, now.texture),
            _changed(own.colors, self.held.colors, now.colors),
            own.picture,
        )


def _skin(mesh: pymeshlab.Mesh, vertex_of_corner: NDArray[np.int64], like: Skin) -> Skin:
    return Skin(
        None if like.texture is None else mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2).copy(),
        None if like.colors is None else mesh.vertex_color_matrix()[vertex_of_corner],
    )


def _changed(own: Corners | None, held: Corners | None, now: Corners | None) -> Corners | None:
    if own is None or held is None or now is None:
        return None
    return np.where((held == now).all(axis=2, keepdims=True), own, now)
