# SPDX-License-Identifier: GPL-3.0-or-later
"""meshmark as a library: typed reports with texts, refusals that leave all as it was, and no crash after them."""

import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import meshmark
import numpy as np
import pymeshlab
import pytest
from doors import MESHES, PyMeshLab

KEY = "correct horse battery staple"
Marked = tuple[Path, meshmark.EmbedReport]
ELEPHANT, CUBE = MESHES / "elephant.off", MESHES / "cube.off"


@pytest.fixture(scope="module")
def marked(tmp_path_factory: pytest.TempPathFactory) -> Marked:
    out = tmp_path_factory.mktemp("marked") / "elephant.off"
    return out, meshmark.embed(ELEPHANT, out, message="id:17", key=KEY, method="Waves")


def test_reports_are_typed_and_have_texts(marked: Marked) -> None:
    file, embedded = marked
    found = meshmark.detect(file, expected="id:17", key=KEY, method="Waves")
    assert (embedded.message, embedded.carriers, found.message, found.present) == ("id:17", 64, "id:17", True)
    assert "Waves" in embedded.recipe
    assert found.verdict.startswith("present: the mesh carries 'id:17'")
    assert str(found) == found.verdict
    assert meshmark.DetectReport.read(found.json()) == found
    beside = meshmark.detect(file, original=ELEPHANT, expected="id:17", key=KEY, method="Waves", bits=64)
    assert beside.registration["found"] is True
    assert embedded.more | found.more | beside.more == {}  # nothing that the plugin says is without a type


def test_a_list_of_candidates_names_one(marked: Marked) -> None:
    settings = {"key": KEY, "method": "Waves", "bits": 64}
    found = meshmark.detect(marked[0], expected=[f"id:{n}" for n in range(100)], **settings)
    assert (found.candidate, found.found) == (17, True)
    assert meshmark.detect(marked[0], expected="id:18", **settings).found is False
    assert meshmark.detect(ELEPHANT, **settings).found is False


def test_a_mesh_set_is_marked_in_place_and_the_key_is_not_in_its_history(tmp_path: Path) -> None:
    PyMeshLab()
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(ELEPHANT))
    before = meshes.current_mesh().vertex_matrix().copy()
    report = meshmark.embed(meshes, message="id:5", key=KEY, method="Waves")
    assert report.moved_vertices == (meshes.current_mesh().vertex_matrix() != before).any(axis=1).sum() > 0
    assert meshmark.detect(meshes, expected="id:5", key=KEY, method="Waves").found
    meshes.save_filter_script(str(tmp_path / "history.mlx"))
    history = (tmp_path / "history.mlx").read_text()
    assert "Watermark" in history
    assert KEY not in history
    assert not [name for name in os.environ if name.startswith("MESHMARK_KEY")]


def test_too_long_a_move_is_refused_in_the_files_unit(
    tmp_path: Path, marked: tuple[Path, meshmark.EmbedReport]
) -> None:
    moves = marked[1].max_displacement
    for limit in (f"{moves * 0.99:.9f}mm", f"{moves * 990:.6f} um", moves * 0.99):
        with pytest.raises(meshmark.MovesTooMuch, match="strength"):
            meshmark.embed(ELEPHANT, tmp_path / "out.off", message="id:17", key=KEY, method="Waves", max_move=limit)
    assert list(tmp_path.iterdir()) == []
    out = tmp_path / "out.off"
    meshmark.embed(ELEPHANT, out, message="id:17", key=KEY, method="Waves", max_move=f"{moves * 1.01}mm")
    assert out.read_bytes() == marked[0].read_bytes()


@pytest.mark.parametrize("matrix", [np.diag([1, 1, 20, 1]), np.diag([20, 20, 20, 1])])
def test_the_limit_is_of_what_is_seen(matrix: np.ndarray) -> None:
    """The layer's matrix may stretch it, or be a similarity, which the filter leaves alone."""

    def seen(max_move: float | None) -> np.ndarray:
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(ELEPHANT))
        meshes.set_matrix(transformmatrix=matrix, freeze=False)
        with suppress(meshmark.MovesTooMuch):
            meshmark.embed(meshes, message="id:5", key=KEY, method="L-M", max_move=max_move)
        return meshes.current_mesh().transformed_vertex_matrix()

    marked = seen(None)
    plain = seen(1e-9)
    most = np.linalg.norm(marked - plain, axis=1).max()
    assert most > 0
    np.testing.assert_array_equal(seen(most * 0.99), plain)
    np.testing.assert_array_equal(seen(most * 1.01), marked)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"mesh": CUBE}, "as wide in every direction"),
        ({"mesh": "nothere.stl"}, "There is no file 'nothere.stl'"),
        ({"mesh": ELEPHANT, "message": ""}, "message"),
        ({"mesh": ELEPHANT, "key": ""}, "key is empty"),
        ({"mesh": ELEPHANT, "max_move": "5 parsecs"}, "is no length"),
        ({"mesh": ELEPHANT, "out": "marked.stl"}, "another kind"),
        ({"mesh": ELEPHANT, "method": "Magic"}, "Magic"),
    ],
)
def test_what_cannot_be_done_is_said_and_leaves_no_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: dict, words: str
) -> None:
    monkeypatch.chdir(tmp_path)
    out = arguments.pop("out", f"out{Path(arguments['mesh']).suffix}")
    with pytest.raises(meshmark.MeshmarkError, match=words):
        meshmark.embed(**{"out": out, "message": "id:1", "key": KEY, **arguments})
    assert list(tmp_path.iterdir()) == []


LOOP = """
import sys, pymeshlab, meshmark
for name in sys.argv[1:] * 2:
    try:
        print(meshmark.embed(name, "out.off", message="id:1", method="Waves").message)
    except meshmark.MeshmarkError:
        print("refused")
    ms = pymeshlab.MeshSet()
    try:
        ms.load_new_mesh(name)
        print(meshmark.embed(ms, message="id:1", method="Waves").message)
    except (meshmark.MeshmarkError, pymeshlab.PyMeshLabException):
        print("refused")
print("end")
"""


def test_a_plain_loop_over_files_lives_through_refusals(tmp_path: Path) -> None:
    files = [CUBE, ELEPHANT, "nothere.off", CUBE]
    done = subprocess.run(
        [sys.executable, "-c", LOOP, *map(str, files)],
        cwd=tmp_path,
        env={**os.environ, "WATERMARK_KEY": KEY},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    says = [line for line in done.stdout.splitlines() if line in ("refused", "id:1", "end")]
    once = ["refused", "refused", "id:1", "id:1", "refused", "refused", "refused", "refused"]
    assert says == [*once, *once, "end"]


def test_attack_and_measure(tmp_path: Path) -> None:
    report = meshmark.attack(ELEPHANT, tmp_path / "noisy.ply", attack="Noise", amount=0.001, seed=7)
    assert (report.attack, report.amount, report.seed, report.vertices) == ("Noise", 0.001, 7, 2775)
    far = meshmark.measure(tmp_path / "noisy.ply", ELEPHANT)
    assert 0 < far.mean <= far.mrms <= far.hausdorff
    assert meshmark.measure(ELEPHANT, ELEPHANT).hausdorff == pytest.approx(0, abs=1e-12)
    assert np.isfinite(far.snr_db)


def test_a_filter_that_fails_by_itself_says_nothing_of_the_mesh() -> None:
    """In a process of its own, with memory left for the key and no more: the reading fails, and is no refusal."""
    text = f"""
import resource, meshmark, pymeshlab
from meshmark import host, plugin
meshmark.detect({str(ELEPHANT)!r}, key={KEY!r}, method="Waves")
with host.own_meshes() as meshes:
    host.read(meshes, __import__("pathlib").Path({str(ELEPHANT)!r}))
    meshes.meshing_surface_subdivision_midpoint(iterations=5, threshold=pymeshlab.PercentageValue(0))
    used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + (80 << 20), resource.RLIM_INFINITY))
    try:
        meshmark.detect(meshes, key={KEY!r}, method="Waves")
    except meshmark.Failed as error:
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", text], text=True, capture_output=True, check=False)
    assert "Not enough memory" in done.stdout, done.stderr
