# SPDX-License-Identifier: GPL-3.0-or-later
"""Channels of the evaluation: a file that goes through them is the same shape, but for what each is there to change."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "meshlab_scripts"))

from evaluation import work  # noqa: E402
from evaluation.channels import CHANNELS, Shape, ToolMissing, chain, formats, tools  # noqa: E402
from evaluation.channels.shape import Passage  # noqa: E402
from evaluation.jobs import Job, Site  # noqa: E402
from meshmark.formats import weld  # noqa: E402

RADIUS = 3.0
CENTRE = np.array([1, 2, 3])
EXTERNAL = {name: program for program, names in {
    "draco_encoder": ["Draco"],
    "prusa-slicer": ["PrusaSlicer STL", "PrusaSlicer 3MF"],
    "blender": ["Blender remesh", "Blender decimate"],
}.items() for name in names}  # fmt: skip


def ball() -> Shape:
    mesh = trimesh.creation.icosphere(4, RADIUS)
    return Shape(np.asarray(mesh.vertices) + CENTRE, np.asarray(mesh.faces, dtype=np.int32))


def volume(shape: Shape) -> float:
    corners = shape.points[shape.faces]
    return float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def through(name: str, shape: Shape, *, amount: float = -1, iterations: int = -1) -> Shape:
    program = EXTERNAL.get(name)
    if program and not shutil.which(program):
        pytest.skip(f"{program} is not installed")
    return CHANNELS[name](shape, Passage(amount, iterations))


@pytest.mark.parametrize("kind", formats.FORMATS)
def test_a_format_keeps_the_shape(kind: str) -> None:
    sent = ball()
    got = through(kind, sent)
    points, number = weld(got.points)
    factor = 1000 if np.ptp(points) > 1000 else 1  # GLB is in metres
    assert len(points) == len(sent.points)
    assert len(got.faces) == len(sent.faces)
    corners = points[number[got.faces]] / factor
    # Three writers in single precision round a number below 8 by 2^-22 each; 3MF has six decimals.
    precision = 3e-6 if kind == "3MF" else 3 * 2**-22
    assert np.abs(np.sort(corners.ravel()) - np.sort(sent.points[sent.faces].ravel())).max() < precision
    assert volume(got) / factor**3 == pytest.approx(volume(sent), rel=1e-6)


def test_units_scale() -> None:
    sent = ball()
    assert volume(through("Units", sent, amount=25.4)) == pytest.approx(25.4**3 * volume(sent), rel=1e-5)


def test_a_hollow_ball_has_a_wall_of_its_thickness() -> None:
    sent = ball()
    wall = 0.05 * sent.diagonal
    got = through("Hollow", sent, amount=0.05)
    assert (got.points[: len(sent.points)] == sent.points).all()
    distances = np.linalg.norm(got.points[len(sent.points) :] - CENTRE, axis=1)
    assert np.abs(distances - (RADIUS - wall)).max() < 0.02
    expected = volume(sent) * (1 - (1 - wall / RADIUS) ** 3)  # the inner wall looks inwards
    assert volume(got) == pytest.approx(expected, rel=0.02)


def test_no_room_for_a_wall() -> None:
    slab = trimesh.creation.box((10, 10, 0.2))
    with pytest.raises(ValueError, match="Nothing is left inside"):
        through("Hollow", Shape(np.asarray(slab.vertices), np.asarray(slab.faces, dtype=np.int32)), amount=0.02)


def test_steps_of_the_chain_follow_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    assert len(chain.STEPS) == 10
    seen = []
    steps = tuple((name, lambda shape, _, name=name: seen.append(name) or shape) for name, _ in chain.STEPS)
    monkeypatch.setattr(chain, "STEPS", steps)
    for count in (0, 3, 10):
        seen.clear()
        through("Ten", ball(), iterations=count)
        assert seen == [name for name, _ in steps][:count]


def test_a_missing_program_is_named_with_its_package(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    for name, program in EXTERNAL.items():
        with pytest.raises(ToolMissing, match=f"{program}.*apt-get install {tools.PACKAGES[program]}"):
            CHANNELS[name](ball(), Passage(10))
    monkeypatch.setattr(work, "_marked", lambda *_: ROOT / "build/data/meshes/elk.off")
    job = Job(kind="attack", mesh="elk", mesh_digest="", plugin_digest="", method="Waves", attack="Draco", amount=10)
    results, error = work.run(job, Site(tmp_path, ROOT / "build/meshlab-2025.07/libfilter_watermark.so", tmp_path))
    assert results == {}
    assert "apt-get install draco" in error


def test_a_program_that_fails_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    program = tmp_path / "blender"
    program.write_text("#!/bin/sh\necho no such modifier >&2\nexit 3\n", encoding="utf-8")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    with pytest.raises(RuntimeError, match="blender ended with 3: no such modifier"):
        tools.run("blender")


@pytest.mark.parametrize("bits", [8, 12])
def test_draco_moves_no_point_by_more_than_half_a_step(bits: int) -> None:
    sent = ball()
    got = through("Draco", sent, amount=bits)
    step = np.ptp(sent.points, axis=0).max() / (2**bits - 1)
    nearest = np.abs(got.points[:, None] - sent.points).max(axis=2).min(axis=1)
    assert nearest.max() <= step / 2 * 1.001
    assert nearest.max() > step / 4


@pytest.mark.parametrize("kind", ["STL", "3MF"])
def test_the_slicer_keeps_the_shape(kind: str) -> None:
    sent = ball()
    got = through(f"PrusaSlicer {kind}", sent)
    assert len(got.faces) == len(sent.faces)
    assert volume(got) == pytest.approx(volume(sent.as_print()), rel=1e-5)


def test_blender_remeshes_and_decimates() -> None:
    sent = ball()
    fewer = through("Blender decimate", sent, amount=0.5)
    assert len(fewer.faces) == pytest.approx(len(sent.faces) / 2, rel=0.01)
    voxels = through("Blender remesh", sent, amount=0.01)
    assert volume(voxels) == pytest.approx(volume(sent.as_print()), rel=0.02)
