# SPDX-License-Identifier: GPL-3.0-or-later
"""The four filters as functions, on files and on MeshSets."""

import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pymeshlab

from . import host, plugin
from .errors import FormatError, MovesTooMuch, NotReadBack
from .formats import Body, Points, Skin, read_body
from .key import Key, find_key
from .layer import Layer
from .length import Length, read_length
from .reports import AttackReport, DetectReport, DistortionReport, EmbedReport
from .settings import Method, Settings, Statistic

File = str | Path
Mesh = File | pymeshlab.MeshSet
Expected = str | Sequence[str] | None


def embed(
    mesh: Mesh,
    out: File | None = None,
    *,
    message: str,
    key: Key | str | None = None,
    method: str = Method.LAYERED,
    statistic: str = Statistic.MEAN,
    bits: int = 0,
    trim: float = -1,
    strength: float = 0,
    max_move: Length | str | float | None = None,
    rehearse: bool = False,
) -> EmbedReport:
    """Hides a message in a file (and writes it to `out`, of the same kind), or in the current layer of a MeshSet.

    A file is read again, and counts only where the message is there. `key` is a passphrase, `file:PATH` or `env:NAME`;
    without one it is that of the environment variable WATERMARK_KEY. `max_move` is how far a vertex may move.

    :raises Refused: where the mesh does not carry the message
    :raises MovesTooMuch: where a vertex would move further
    :raises FormatError: where a file cannot be read or written
    :raises NotReadBack: where the written file does not carry the message; it is gone again
    """
    settings = Settings(method, statistic, bits, trim)
    values = {"message": message, "strength": strength, "rehearse": rehearse, **settings.values()}
    limit = None if max_move is None else read_length(max_move)
    secret = find_key(key)
    if isinstance(mesh, pymeshlab.MeshSet):
        if out is not None:
            raise FormatError("A MeshSet is marked in place: save it yourself, and leave out the file's name.")
        return _embed_layer(mesh, values, secret, limit)
    if out is None:
        raise FormatError("Where to write the marked file is missing.")
    source, target = Path(mesh), Path(out)
    if source.suffix.lower() != target.suffix.lower():
        raise FormatError(
            f"'{target.name}' is of another kind than '{source.name}'. Mark it as {source.suffix}, and convert "
            "it then: the mark outlives that."
        )
    body = read_body(source)
    with host.own_meshes() as meshes:
        layer = Layer.add(meshes, body)
        report = _embed(meshes, values, secret, limit, body.unit)
        moved = layer.moved(meshes.current_mesh())
    found = Settings(method, statistic, report.carriers, trim)
    _write_checked(body, moved, target, message, secret, found)
    return report


def detect(
    mesh: Mesh,
    *,
    key: Key | str | None = None,
    expected: Expected = None,
    original: File | None = None,
    method: str = Method.LAYERED,
    statistic: str = Statistic.MEAN,
    bits: int = 0,
    trim: float = -1,
) -> DetectReport:
    """Reads a mark, with the key alone or with the unmarked original too, and so from parts and slightly bent copies.

    `expected` is a message to look for, or a list of which one may be there.

    :raises Refused: where the filter cannot look at the mesh
    :raises FormatError: where a file cannot be read
    """
    values = Settings(method, statistic, bits, trim).values()
    secret = find_key(key)
    with opened(mesh) as meshes, _candidates(expected) as text, secret.lent() as lent:
        values |= {"key": lent, "expected": text}
        if original is None:
            return DetectReport.read(host.apply_with_report(meshes, plugin.DETECT, **values))
        examined = meshes.current_mesh_id()
        _add(meshes, read_body(Path(original)))
        values["original"] = meshes.current_mesh_id()
        meshes.set_current_mesh(examined)
        try:
            return DetectReport.read(host.apply_with_report(meshes, plugin.DETECT_WITH_ORIGINAL, **values))
        finally:
            meshes.set_current_mesh(values["original"])
            meshes.delete_current_mesh()
            meshes.set_current_mesh(examined)


def attack(
    mesh: Mesh, out: File | None = None, *, attack: str, amount: float = -1, iterations: int = -1, seed: int = 0
) -> AttackReport:
    """Does to a mesh what a user, a format or an adversary might. A file keeps its shape only.

    :raises Refused: where the amount is out of range
    :raises FormatError: where a file cannot be read or written
    """
    values = {"attack": attack, "amount": amount, "iterations": iterations, "seed": seed}
    if not isinstance(mesh, pymeshlab.MeshSet) and out is None:
        raise FormatError("Where to write the attacked file is missing.")
    with opened(mesh) as meshes:
        numbers = host.apply(meshes, plugin.ATTACK, **values)
        if out is not None:
            host.save(meshes, Path(out))
    return AttackReport.read({"attack": attack, "iterations": iterations, **numbers})


def measure(
    mesh: Mesh, reference: File | None = None, *, reference_layer: int | None = None, samples: int = 0, seed: int = 0
) -> DistortionReport:
    """How far a file is from another, or the current layer of a MeshSet from its layer `reference_layer`.

    :raises Refused: where there is nothing to compare
    :raises FormatError: where a file cannot be read
    """
    values = {"samples": samples, "seed": seed}
    if isinstance(mesh, pymeshlab.MeshSet):
        if reference_layer is None:
            raise FormatError("The number of the layer to compare with is missing.")
        json = host.apply_with_report(mesh, plugin.MEASURE, reference=reference_layer, **values)
        return DistortionReport.read(json)
    if reference is None:
        raise FormatError("The file to compare with is missing.")
    with host.own_meshes() as meshes:
        for file in (reference, mesh):
            _add(meshes, read_body(Path(file)))
        json = host.apply_with_report(meshes, plugin.MEASURE, reference=0, **values)
    return DistortionReport.read(json)


@contextmanager
def opened(mesh: Mesh) -> Iterator[pymeshlab.MeshSet]:
    """The MeshSet itself, or one with the body of the file."""
    if isinstance(mesh, pymeshlab.MeshSet):
        yield mesh
        return
    body = read_body(Path(mesh))
    with host.own_meshes() as meshes:
        _add(meshes, body)
        yield meshes


def _add(meshes: pymeshlab.MeshSet, body: Body) -> None:
    """Its shape alone."""
    meshes.add_mesh(pymeshlab.Mesh(*body.welded()))


def _embed(
    meshes: pymeshlab.MeshSet,
    values: dict[str, host.Value],
    key: Key,
    limit: Length | None = None,
    unit: str = "mm",
) -> EmbedReport:
    before = None if limit is None else meshes.current_mesh().transformed_vertex_matrix()
    with key.lent() as lent:
        report = EmbedReport.read(host.apply_with_report(meshes, plugin.EMBED, key=lent, **values))
    if limit is not None:
        moves = np.linalg.norm(meshes.current_mesh().transformed_vertex_matrix() - before, axis=1)
        _check_move(report, float(moves.max()), limit.within(unit), unit)
    return report


def _embed_layer(
    meshes: pymeshlab.MeshSet, values: dict[str, host.Value], key: Key, limit: Length | None
) -> EmbedReport:
    """In place; tried on a copy first where it might move too much."""
    if limit is not None:
        mesh = meshes.current_mesh()
        with host.own_meshes() as copy:
            copy.add_mesh(pymeshlab.Mesh(mesh.vertex_matrix(), mesh.face_matrix()))
            copy.set_matrix(transformmatrix=mesh.transform_matrix(), freeze=False)
            _embed(copy, values, key, limit)
    return _embed(meshes, values, key)


def _check_move(report: EmbedReport, move: float, most: float, unit: str) -> None:
    """Of what is seen: the layer's matrix may stretch or magnify it."""
    if move <= most:
        return
    slides = f"Method {Method.WAVES} slides no vertices along the surface and may fit; or "
    raise MovesTooMuch(
        f"The mark moves a vertex by {move:.3g} {unit}, and {most:.3g} {unit} are allowed. "
        f"{'' if report.method == Method.WAVES else slides}a strength of {report.strength * most / move * 0.9:.2g}, "
        f"with a weaker mark. The file's unit is taken to be {unit}."
    )


def _write_checked(
    body: Body, moved: tuple[Points, Skin], target: Path, message: str, key: Key, settings: Settings
) -> None:
    """Writes beside the target, reads that again, and puts it in the target's place where the message is there."""
    part = target.with_name(f".{os.getpid()}-{target.name}")
    try:
        part.write_bytes(body.written(*moved))
        found = detect(part, key=key, expected=message, **settings.values())
        if not found.present:
            raise NotReadBack(f"'{target}' does not read back: {found.verdict} Nothing was written.")
        part.replace(target)
    except OSError as error:
        raise FormatError(f"'{target}' cannot be written: {error.strerror}.") from error
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def _candidates(expected: Expected) -> Iterator[str]:
    """What the filter takes: a message, or a file of them."""
    if expected is None or isinstance(expected, str):
        yield expected or ""
        return
    with tempfile.TemporaryDirectory(prefix="meshmark-") as folder:
        file = Path(folder) / "candidates"
        file.write_text("\n".join(expected) + "\n", encoding="utf-8")
        yield f"file:{file}"
