# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input through both doors: an error with cause and cure that changes nothing, or a right result.

The text that each got is written to build/bad_input.md.
"""

import json
import multiprocessing
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pymeshlab
import pytest
from bad_meshes import BAD_MESHES, body, write_ply
from doors import BUILD, DETECT, EMBED, METHODS, ROOT, MeshLabServer, PyMeshLab, Refused

KEY = "swordfish-of-bad-input"
SECONDS = 240  # for all filters on one mesh
ATTACK = "apply_watermark_attack"
MEASURE = "get_watermark_distortion"
DETECT_WITH_ORIGINAL = "get_watermark_with_original"
ATTACKS = len(list((ROOT / "meshlab_scripts" / "attacks").glob("*.mlx")))  # each has a script
Row = tuple[str, str, str, str]  # door, mesh, filter, answer


def said_in(text: str) -> str:
    """The filter's error in what its host printed."""
    found = re.search(r"Error: (.*)", text)
    return (found.group(1) if found else text).strip()


def answer(run: object) -> str:
    """What a call says: "done", or its error."""
    try:
        run()
    except (Refused, pymeshlab.PyMeshLabException) as error:
        return said_in(str(error))
    return "done"


def through_pymeshlab(mesh: str, rows: "multiprocessing.Queue[list[Row]]") -> None:
    """Every filter on one mesh; in a process of its own, so that a crash or a hang is seen."""
    door = PyMeshLab()
    points, faces = BAD_MESHES[mesh]()
    good = pymeshlab.Mesh(*body(16))
    result: list[Row] = []

    def call(title: str, function: str, positions_may_change: bool, **values: object) -> None:
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(good)
        meshes.add_mesh(pymeshlab.Mesh(points, faces) if len(points) else good)
        if not len(points):  # pymeshlab makes no empty mesh
            meshes.set_selection_all()
            meshes.meshing_remove_selected_vertices_and_faces()
        door.failed.append(meshes)
        said = answer(lambda: meshes.apply_filter(function, **values))
        after = meshes.current_mesh()
        if said != "done" or not positions_may_change:
            assert after.vertex_matrix().tobytes() == points.tobytes(), f"{title} changed the mesh: {said}"
            assert np.array_equal(after.face_matrix(), faces), f"{title} changed the faces: {said}"
        elif len(points):
            assert np.isfinite(after.vertex_matrix()).all(), f"{title} leaves coordinates that are not finite"
        result.append((door.name, mesh, title, said))

    for method in METHODS:
        call(f"Embed {method}", "apply_coord_watermark", True, method=method, key=KEY, message="ab", bits=16)
        call(f"Detect {method}", "get_watermark", False, method=method, key=KEY, expected="ab", bits=16)
    call("Detect with Original", DETECT_WITH_ORIGINAL, False, original=0, key=KEY, expected="ab", bits=16)
    for attack in range(ATTACKS):
        amount = 0.05 if attack == 6 else -1.0  # Isosurface, coarsely
        call(f"Attack {attack}", ATTACK, True, attack=attack, amount=amount)
    call("Measure", MEASURE, False, reference=0, samples=1000)
    rows.put(result)


@pytest.fixture(scope="module")
def table() -> Iterator[list[Row]]:
    """Collects what was said, and writes it down at the end."""
    rows: list[Row] = []
    yield rows
    lines = ["# Bad input, and what each filter said", "", "| door | mesh | filter | answer |", "|---|---|---|---|"]
    lines += ["| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in row) + " |" for row in rows]
    (BUILD / "bad_input.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def expect_useful(row: Row) -> None:
    said = row[3]
    if said == "done":
        return
    assert KEY not in said
    assert len(said) > 30, row
    assert "Internal error" not in said, row
    assert re.search(r"\. ?\w.*\.$|, or |first\.$", said), f"no cure in: {row}"


@pytest.mark.parametrize("mesh", BAD_MESHES)
def test_pymeshlab(mesh: str, table: list[Row]) -> None:
    context = multiprocessing.get_context("spawn")
    queue = context.Queue()
    process = context.Process(target=through_pymeshlab, args=(mesh, queue))
    process.start()
    process.join(SECONDS)
    process.kill()
    assert process.exitcode == 0, "it fails, crashes or hangs; see above"
    rows = queue.get(timeout=5)
    table += rows
    for row in rows:
        expect_useful(row)


@pytest.mark.usefixtures("display")
@pytest.mark.parametrize("mesh", BAD_MESHES)
def test_meshlabserver(mesh: str, tmp_path: Path, table: list[Row]) -> None:
    door = MeshLabServer()
    before = tmp_path / "before.ply"
    after = tmp_path / "after.ply"
    write_ply(before, BAD_MESHES[mesh]())
    for title, filter_name, values in (
        ("Embed L-M", EMBED, {"Message": "ab"}),
        ("Embed Spectral", EMBED, {"Message": "ab", "Method": "Spectral"}),
        ("Detect L-M", DETECT, {"Expected": "ab"}),
        ("Detect Geodesic", DETECT, {"Expected": "ab", "Method": "Geodesic"}),
    ):
        after.unlink(missing_ok=True)
        report = tmp_path / "report.json"
        report.unlink(missing_ok=True)
        said = answer(
            lambda f=filter_name, v=values, r=report: door.run(f, before, after, Key=KEY, Bits=16, Report=str(r), **v)
        )
        row = (door.name, mesh, title, said)
        table.append(row)
        expect_useful(row)
        assert after.exists() == (said == "done"), row
        if report.exists():
            assert KEY not in report.read_text(encoding="utf-8")
            json.loads(report.read_text(encoding="utf-8"))
    good = tmp_path / "good.ply"
    write_ply(good, body(16))
    for title, script, inputs in (
        ("Attack Noise", "attacks/noise.mlx", [before]),
        ("Attack Simplify", "attacks/simplify.mlx", [before]),
        ("Measure", "measure.mlx", [good, before]),
    ):
        after.unlink(missing_ok=True)
        arguments = ["-i", *inputs, "-s", ROOT / "meshlab_scripts" / script, "-o", after]
        done = door.arguments(*arguments)
        row = (door.name, mesh, title, "done" if done.returncode == 0 else said_in(done.stdout))
        table.append(row)
        expect_useful(row)
        assert after.exists() == (done.returncode == 0), row
