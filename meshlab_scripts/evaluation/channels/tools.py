# SPDX-License-Identifier: GPL-3.0-or-later
"""Through programs of others. Where one is not installed, its rows say so, with the name of Debian's package."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .shape import Channel, Passage, Shape

PACKAGES = {"draco_encoder": "draco", "draco_decoder": "draco", "prusa-slicer": "prusa-slicer", "blender": "blender"}
MODIFY = Path(__file__).with_name("blender_modify.py")
SECONDS = 900  # no tool takes that long for a mesh of a protocol


class ToolMissing(RuntimeError):
    """A program that is not installed."""


def run(program: str, *arguments: object) -> None:
    """Runs one of the PACKAGES' programs.

    :raises ToolMissing: where it is not there
    :raises RuntimeError: where it fails, with its last words
    """
    path = shutil.which(program)
    if path is None:
        raise ToolMissing(f"{program} is not installed: apt-get install {PACKAGES[program]}, then run with --retry.")
    done = subprocess.run(
        [path, *map(str, arguments)], check=False, capture_output=True, text=True, errors="replace", timeout=SECONDS
    )
    if done.returncode:
        said = (done.stderr + done.stdout).strip().splitlines() or [""]
        raise RuntimeError(f"{program} ended with {done.returncode}: {said[-1]}")


@contextmanager
def _scratch() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="channel-") as folder:
        yield Path(folder)


def draco(shape: Shape, passage: Passage) -> Shape:
    """Compressed with so many bits a coordinate, and unpacked."""
    with _scratch() as folder:
        shape.write(folder / "plain.ply")
        run("draco_encoder", "-i", folder / "plain.ply", "-o", folder / "packed.drc", "-qp", int(passage.amount))
        run("draco_decoder", "-i", folder / "packed.drc", "-o", folder / "unpacked.ply")
        return Shape.read(folder / "unpacked.ply")


def exported(kind: str) -> Channel:
    """Opened, repaired and exported by PrusaSlicer."""

    def channel(shape: Shape, _passage: Passage) -> Shape:
        with _scratch() as folder:
            shape.as_print().write(folder / "model.stl")
            out = folder / f"exported.{kind.lower()}"
            run("prusa-slicer", f"--export-{kind.lower()}", "--repair", "--datadir", folder / "settings",
                "--output", out, folder / "model.stl")  # fmt: skip
            return Shape.read(out)

    return channel


def remeshed(shape: Shape, passage: Passage) -> Shape:
    """Blender's voxel remesh, with voxels of this part of the diagonal."""
    print_ = shape.as_print()
    return _by_blender(print_, "REMESH", passage.amount * print_.diagonal)


def decimated(shape: Shape, passage: Passage) -> Shape:
    """Blender's decimation, until this part of the faces is left."""
    return _by_blender(shape.as_print(), "DECIMATE", passage.amount)


def _by_blender(shape: Shape, modifier: str, amount: float) -> Shape:
    with _scratch() as folder:
        source, target = folder / "model.stl", folder / "modified.stl"
        shape.write(source)
        run("blender", "--background", "--factory-startup", "--threads", 1, "--python-exit-code", 1,
            "--python", MODIFY, "--", source, target, modifier, amount)  # fmt: skip
        return Shape.read(target)
