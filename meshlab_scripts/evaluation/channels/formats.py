# SPDX-License-Identifier: GPL-3.0-or-later
"""Through files: written by trimesh, rewritten by MeshLab where it can, rewritten by meshmark, read."""

import tempfile
from pathlib import Path

from meshmark import host
from meshmark.formats import read_body

from .shape import Channel, Passage, Shape

FORMATS = ("STL", "PLY", "OBJ", "OFF", "3MF", "GLB")
MESHLAB_READS_ONLY = {"GLB"}


def round_trip(kind: str) -> Channel:
    """The channel of a format: three programs hand the file on."""

    def channel(shape: Shape, _passage: Passage) -> Shape:
        with tempfile.TemporaryDirectory(prefix="channel-") as folder:
            first, second, third = (Path(folder) / f"{number}.{kind.lower()}" for number in range(3))
            shape.write(first)
            if kind in MESHLAB_READS_ONLY:
                second = first
            else:
                with host.own_meshes() as meshes:
                    host.read(meshes, first)
                    host.save(meshes, second)
            body = read_body(second)
            third.write_bytes(body.written(body.points, body.skin))
            return Shape.read(third)

    return channel
