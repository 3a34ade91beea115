# SPDX-License-Identifier: GPL-3.0-or-later
"""Texture coordinates of a part of a 3MF file: groups of them, and of each triangle the group and its places there.

3MF Consortium: Materials and Properties Extension 1.2, texture2dgroup.
"""

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from .body import Corners, triangles
from .corners import shared
from .lines import Edit, patched, text
from .tags import tags, with_values

_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
_MATERIAL = "{http://schemas.microsoft.com/3dmanufacturing/material/2015/02}"
_COORDINATE = re.compile(rb"<((?:\w+:)?tex2coord)\s[^>]*?(?:/>|>\s*</\1\s*>)")
_TRIANGLE = re.compile(rb"<(?:\w+:)?triangle\s[^>]*>")


class Coordinates:
    """All of a part, in the order of its text."""

    def __init__(self, root: ElementTree.Element) -> None:
        self.tables = []
        numbers = {}
        for one in root.iter(f"{_MATERIAL}texture2dgroup"):
            numbers[one.get("id")] = len(self.tables)
            rows = [(float(c.attrib["u"]), float(c.attrib["v"])) for c in one.iter(f"{_MATERIAL}tex2coord")]
            self.tables.append(np.array(rows, dtype=float).reshape(-1, 2))
        groups, places = [], []
        for one in root.iter(f"{_CORE}object"):
            for triangle in one.iter(f"{_CORE}triangle"):
                number = numbers.get(triangle.get("pid", one.get("pid")), -1)
                first = triangle.get("p1", one.get("pindex", "0"))
                groups.append(number)
                places.append([int(triangle.get(name, first)) if number >= 0 else -1 for name in ("p1", "p2", "p3")])
        self.group = np.array(groups, dtype=np.int64)
        self.places = np.array(places, dtype=np.int64).reshape(-1, 3)

    @property
    def texture(self) -> Corners:
        """Of all triangles; 0 where there is none."""
        texture = np.zeros((len(self.group), 3, 2))
        for number, table in enumerate(self.tables):
            here = self.group == number
            texture[here] = table[triangles(self.places[here], len(table))]
        return texture

    def written(self, part: bytes, texture: Corners) -> bytes:
        """The text with these coordinates: in place, and behind the last of a group where triangles shared one."""
        return patched(part, self._edits(part, texture)) if self.tables else part

    def _edits(self, part: bytes, texture: Corners) -> Iterator[Edit]:
        coordinates = tags(_COORDINATE, part, sum(map(len, self.tables)))
        of_triangles = tags(_TRIANGLE, part, len(self.group))
        first = 0
        for number, old in enumerate(self.tables):
            here = np.flatnonzero(self.group == number)
            new, places = shared(self.places[here].ravel(), old, texture[here].reshape(-1, 2))
            for row in np.flatnonzero((new[: len(old)] != old).any(axis=1)):
                tag = coordinates[first + row]
                yield *tag.span(), with_values(tag.group(), u=text(new[row, 0]), v=text(new[row, 1]))
            first += len(old)
            if len(new) > len(old):
                last = coordinates[first - 1]
                added = (with_values(last.group(), u=text(u), v=text(v)) for u, v in new[len(old) :].tolist())
                yield last.end(), last.end(), b"".join(added)
            moved = places.reshape(-1, 3)
            for row in np.flatnonzero((moved != self.places[here]).any(axis=1)):
                tag = of_triangles[here[row]]
                p1, p2, p3 = (b"%d" % place for place in moved[row])
                yield *tag.span(), with_values(tag.group(), p1=p1, p2=p2, p3=p3)
