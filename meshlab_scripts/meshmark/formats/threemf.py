# SPDX-License-Identifier: GPL-3.0-or-later
"""3MF: coordinates of vertices and of textures change; colours, materials, pictures and a slicer's settings stay.

3MF Consortium: Core Specification 1.3 (units, build, components), Production Extension (objects in other parts),
Materials and Properties Extension 1.2 (texture2dgroup).
"""

import re
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from ..errors import FormatError
from .body import Body, Points, Skin, write_whole
from .threemf_texture import Coordinates

_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
_PATH = "{http://schemas.microsoft.com/3dmanufacturing/production/2015/06}path"
_RELATIONS = "_rels/.rels"
_MODEL = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_VERTEX = re.compile(rb"<(?:\w+:)?vertex\s[^>]*>")
_AXES = [re.compile(rb"(\s%b\s*=\s*)(\"[^\"]*\"|'[^']*')" % axis) for axis in (b"x", b"y", b"z")]


@dataclass(frozen=True)
class _Object:
    """An object with a mesh: its first vertex and triangle in the order of its part's text, and its geometry."""

    first: int
    first_triangle: int
    points: Points
    faces: np.ndarray


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

    @staticmethod
    def _objects(root: ElementTree.Element) -> dict[str, ElementTree.Element | _Object]:
        """By id: a mesh, or the element with its components."""
        found: dict[str, ElementTree.Element | _Object] = {}
        count, triangles = 0, 0
        for one in root.iter(f"{_CORE}object"):
            mesh = one.find(f"{_CORE}mesh")
            if mesh is None:
                found[one.get("id", "")] = one
                continue
            points = [[float(v.get(axis, "0")) for axis in "xyz"] for v in mesh.iter(f"{_CORE}vertex")]
            faces = [[int(t.get(corner, "0")) for corner in ("v1", "v2", "v3")] for t in mesh.iter(f"{_CORE}triangle")]
            found[one.get("id", "")] = _Object(
                count, triangles, np.array(points, dtype=float).reshape(-1, 3),
                np.array(faces, dtype=np.int32).reshape(-1, 3),
            )  # fmt: skip
            count += len(points)
            triangles += len(faces)
        return found

    def placed(self, part: str, number: str, matrix: np.ndarray) -> Iterator[tuple[str, _Object, np.ndarray]]:
        """The meshes of an object, each with its matrix."""
        one = self.objects[part][number]
        if isinstance(one, _Object):
            yield part, one, matrix
            return
        for component in one.iter(f"{_CORE}component"):
            other = component.get(_PATH, part).lstrip("/")
            yield from self.placed(other, component.get("objectid", ""), _matrix(component) @ matrix)


def read(path: Path) -> Body:
    """All that the build of the file places."""
    package = _Package(path)
    main = package.roots[package.main]
    placed: list[_Placed] = []
    points, faces, count = [], [], 0
    for item in main.iter(f"{_CORE}item"):
        part = item.get(_PATH, package.main).lstrip("/")
        for where, mesh, matrix in package.placed(part, item.get("objectid", ""), _matrix(item)):
            placed.append(_Placed(where, mesh, matrix, count))
            points.append(mesh.points @ matrix[:3, :3] + matrix[3, :3])
            faces.append(mesh.faces + count)
            count += len(mesh.points)
    if not count:
        raise FormatError(f"'{path}' builds nothing.")

    def write(out: Path, moved: Points, skin: Skin) -> None:
        _write(path, out, package, placed, moved, skin)

    unit = main.get("unit", "millimeter")
    return Body(np.concatenate(points), np.concatenate(faces).astype(np.int32), unit, write, _skin(package, placed))


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


def _write(path: Path, out: Path, package: _Package, placed: list[_Placed], moved: Points, skin: Skin) -> None:
    if len({(one.part, one.mesh.first) for one in placed}) < len(placed):
        raise FormatError(f"'{path}' builds one object several times. Make the copies real ones first, or mark one.")
    texts = dict(package.texts)
    for part in {one.part for one in placed}:
        here = [one for one in placed if one.part == part]
        local: dict[int, Points] = {}
        for one in here:
            points = moved[one.begin : one.begin + len(one.mesh.points)] - one.matrix[3, :3]
            local[one.mesh.first] = np.linalg.solve(one.matrix[:3, :3].T, points.T).T
        new = {first + number: point for first, points in local.items() for number, point in enumerate(points)}
        texts[part] = _rewritten(texts[part], new)
    if skin.texture is not None:
        ends = np.cumsum([len(one.mesh.faces) for one in placed])
        of_placed = np.split(skin.texture, ends[:-1])
        for part, coordinates in package.coordinates.items():
            texture = coordinates.texture.copy()
            for one, new in zip(placed, of_placed, strict=True):
                if one.part == part:
                    texture[one.mesh.first_triangle : one.mesh.first_triangle + len(new)] = new
            texts[part] = coordinates.written(texts[part], texture)
    part_file = out.with_name(f".{out.name}.zip.part")
    try:
        with zipfile.ZipFile(path) as old, zipfile.ZipFile(part_file, "w") as archive:
            for entry in old.infolist():
                contents = texts.get(entry.filename) if entry.filename in texts else old.read(entry)
                archive.writestr(entry, contents, entry.compress_type)
        write_whole(out, part_file.read_bytes())
    finally:
        part_file.unlink(missing_ok=True)


def _rewritten(text: bytes, points: dict[int, Points]) -> bytes:
    """The text with new coordinates for the vertices of these numbers."""
    pieces, end = [], 0
    for number, match in enumerate(_VERTEX.finditer(text)):
        if number in points:
            tag = match.group()
            for axis, value in zip(_AXES, points[number], strict=True):
                tag = axis.sub(rb'\g<1>"%b"' % f"{value:.9g}".encode(), tag, count=1)
            pieces += [text[end : match.start()], tag]
            end = match.end()
    return b"".join([*pieces, text[end:]])
