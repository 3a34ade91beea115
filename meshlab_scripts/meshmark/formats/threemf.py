# SPDX-License-Identifier: GPL-3.0-or-later
"""3MF: coordinates of vertices and of textures change; colours, materials, pictures and a slicer's settings stay.

3MF Consortium: Core Specification 1.3 (units, build, components), Production Extension (objects in other parts),
Materials and Properties Extension 1.2 (texture2dgroup).
"""

import io
import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..errors import FormatError
from .body import Body, Corners, Faces, Points, Skin, before_matrix, check_places, triangles
from .lines import Edit, patched, text
from .tags import tags, with_values
from .threemf_texture import Coordinates

_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
_PATH = "{http://schemas.microsoft.com/3dmanufacturing/production/2015/06}path"
_RELATIONS = "_rels/.rels"
_MODEL = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_VERTEX = re.compile(rb"<(?:\w+:)?vertex\s[^>]*>")
_SMALL, _DENSE = 1 << 24, 200  # bytes that any entry may have, and how much others may be packed


@dataclass(frozen=True)
class _Object:
    """An object with a mesh: its first vertex and triangle in the order of its part's text, and its geometry."""

    first: int
    first_triangle: int
    points: Points
    faces: Faces


@dataclass(frozen=True)
class _Placed:
    part: str
    mesh: _Object
    matrix: np.ndarray
    begin: int


class _Package:
    """The XML parts of the file that hold models."""

    def __init__(self, path: Path) -> None:
        try:
            with zipfile.ZipFile(path) as archive:
                _check_entries(archive)
                self.texts = {name: archive.read(name) for name in archive.namelist() if name.endswith(".model")}
                relations = ElementTree.fromstring(archive.read(_RELATIONS))
        except (zipfile.BadZipFile, KeyError) as error:
            raise FormatError(f"'{path}' is no 3MF file.") from error
        self.roots = {name: ElementTree.fromstring(text) for name, text in self.texts.items()}
        targets = [one.get("Target", "").lstrip("/") for one in relations if one.get("Type") == _MODEL]
        if not targets or targets[0] not in self.roots:
            raise FormatError(f"'{path}' has no model.")
        self.main = targets[0]
        self.objects = {name: self._objects(root) for name, root in self.roots.items()}
        self.coordinates = {name: Coordinates(root) for name, root in self.roots.items()}
        self.places = 0  # that were asked for

    @staticmethod
    def _objects(root: ElementTree.Element) -> dict[str, ElementTree.Element | _Object]:
        """By id: a mesh, or the element with its components."""
        found: dict[str, ElementTree.Element | _Object] = {}
        count, of_triangles = 0, 0
        for one in root.iter(f"{_CORE}object"):
            mesh = one.find(f"{_CORE}mesh")
            if mesh is None:
                found[one.get("id", "")] = one
                continue
            points = [[float(v.attrib[axis]) for axis in "xyz"] for v in mesh.iter(f"{_CORE}vertex")]
            faces = [[int(t.attrib[corner]) for corner in ("v1", "v2", "v3")] for t in mesh.iter(f"{_CORE}triangle")]
            found[one.get("id", "")] = _Object(
                count, of_triangles, np.array(points, dtype=float).reshape(-1, 3), triangles(faces, len(points))
            )
            count += len(points)
            of_triangles += len(faces)
        return found

    def placed(
        self, part: str, number: str, matrix: np.ndarray, above: tuple[tuple[str, str], ...] = ()
    ) -> Iterator[tuple[str, _Object, np.ndarray]]:
        """The meshes of an object, each with its matrix."""
        if (part, number) in above:
            raise FormatError(f"Object {number} of '{part}' is a component of itself. Take that component away.")
        self.places += 1
        check_places(self.places)
        one = self.objects[part][number]
        if isinstance(one, _Object):
            yield part, one, matrix
            return
        for component in one.iter(f"{_CORE}component"):
            other = component.get(_PATH, part).lstrip("/")
            where = _matrix(component) @ matrix
            yield from self.placed(other, component.get("objectid", ""), where, (*above, (part, number)))


def _check_entries(archive: zipfile.ZipFile) -> None:
    """A few bytes can unpack to more than any memory holds."""
    for entry in archive.infolist():
        if entry.file_size > max(_SMALL, _DENSE * entry.compress_size):
            raise ValueError(f"'{entry.filename}' in it unpacks to {entry.file_size:,} bytes")
    damaged = archive.testzip()
    if damaged:
        raise ValueError(f"'{damaged}' in it is damaged")


def read(path: Path) -> Body:
    """All that the build of the file places."""
    package = _Package(path)
    main = package.roots[package.main]
    placed: list[_Placed] = []
    points, faces, count, shown = [], [], 0, 0
    for item in main.iter(f"{_CORE}item"):
        part = item.get(_PATH, package.main).lstrip("/")
        for where, mesh, matrix in package.placed(part, item.get("objectid", ""), _matrix(item)):
            placed.append(_Placed(where, mesh, matrix, count))
            points.append(mesh.points @ matrix[:3, :3] + matrix[3, :3])
            faces.append(mesh.faces + count)
            count += len(mesh.points)
            shown += len(mesh.faces)
            check_places(len(placed), shown)
    if not count:
        raise FormatError(f"'{path}' builds nothing.")

    own = np.concatenate(points)

    def written(moved: Points, skin: Skin) -> bytes:
        if len({(one.part, one.mesh.first) for one in placed}) < len(placed):
            raise FormatError(
                f"'{path}' builds one object several times. Make the copies real ones first, or mark one."
            )
        texts = _moved(package, placed, own, moved)
        if skin.texture is not None:
            texts |= _shown(package, placed, skin.texture, texts)
        return _packed(path, texts)

    unit = main.get("unit", "millimeter")
    return Body(own, np.concatenate(faces).astype(np.int32), unit, written, _skin(package, placed))


def _skin(package: _Package, placed: list[_Placed]) -> Skin:
    """The texture of what is placed; groups of coordinates of different parts are different pictures."""
    groups = [len(one.tables) for one in package.coordinates.values()]
    first = dict(zip(package.coordinates, np.cumsum([0, *groups]).tolist(), strict=False))
    textures, pictures = [], []
    for one in placed:
        here = slice(one.mesh.first_triangle, one.mesh.first_triangle + len(one.mesh.faces))
        coordinates = package.coordinates[one.part]
        textures.append(coordinates.texture[here])
        group = coordinates.group[here]
        pictures.append(np.where(group < 0, -1, group + first[one.part]))
    picture = np.concatenate(pictures).astype(np.int32)
    if picture.max(initial=-1) < 0:
        return Skin()
    return Skin(texture=np.concatenate(textures), picture=picture)


def _matrix(element: ElementTree.Element) -> np.ndarray:
    """3MF multiplies rows: (x, y, z, 1) times this."""
    matrix = np.eye(4)
    if element.get("transform"):
        matrix[:, :3] = np.array(element.get("transform", "").split(), dtype=float).reshape(4, 3)
    return matrix


def _moved(package: _Package, placed: list[_Placed], own: Points, moved: Points) -> dict[str, bytes]:
    """The parts with new coordinates of the vertices that have moved."""
    texts = dict(package.texts)
    for part in {one.part for one in placed}:
        found = tags(_VERTEX, texts[part], sum(1 for _ in package.roots[part].iter(f"{_CORE}vertex")))
        changes: list[Edit] = []
        for one in placed:
            if one.part != part:
                continue
            before, after = (points[one.begin : one.begin + len(one.mesh.points)] for points in (own, moved))
            rows = np.flatnonzero((after != before).any(axis=1))
            local = before_matrix(after[rows] - one.matrix[3, :3], one.matrix[:3, :3].T) if len(rows) else after[:0]
            for row, (x, y, z) in zip(rows, local.tolist(), strict=True):
                tag = found[one.mesh.first + row]
                changes.append((*tag.span(), with_values(tag.group(), x=text(x), y=text(y), z=text(z))))
        texts[part] = patched(texts[part], changes)
    return texts


def _shown(package: _Package, placed: list[_Placed], texture: Corners, texts: dict[str, bytes]) -> dict[str, bytes]:
    """The parts with other texture coordinates."""
    shown = {part: coordinates.texture for part, coordinates in package.coordinates.items()}
    ends = np.cumsum([len(one.mesh.faces) for one in placed])
    for one, new in zip(placed, np.split(texture, ends[:-1]), strict=True):
        shown[one.part][one.mesh.first_triangle : one.mesh.first_triangle + len(new)] = new
    return {part: package.coordinates[part].written(texts[part], new) for part, new in shown.items()}


def _packed(path: Path, texts: dict[str, bytes]) -> bytes:
    """The package with these texts, and all other entries as they are."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(buffer, "w") as archive:
        archive.comment = old.comment
        for entry in old.infolist():
            contents = texts[entry.filename] if entry.filename in texts else old.read(entry)
            archive.writestr(entry, contents, entry.compress_type)
    return buffer.getvalue()
