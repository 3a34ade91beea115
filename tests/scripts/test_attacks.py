# SPDX-License-Identifier: GPL-3.0-or-later
"""Watermark: Attack and Watermark: Measure Distortion through meshlabserver, by the scripts that users get."""

import re
from pathlib import Path

import pytest
from doors import MESHES, ROOT, MeshLabServer

SCRIPTS = ROOT / "meshlab_scripts"
ATTACKS = sorted((SCRIPTS / "attacks").glob("*.mlx"))
FANDISK = MESHES / "fandisk.off"

pytestmark = pytest.mark.usefixtures("display")


def logged(log: str, name: str) -> float:
    found = re.search(rf"^LOG: 2 {name}: (\S+)$", log, re.MULTILINE)
    assert found, log
    return float(found[1])


@pytest.mark.parametrize("script", ATTACKS, ids=lambda path: path.stem)
def test_each_attack_has_a_script_that_runs(tmp_path: Path, script: Path) -> None:
    output = tmp_path / "attacked.ply"
    done = MeshLabServer().arguments("-i", FANDISK, "-s", script, "-o", output)
    assert done.returncode == 0, done.stdout
    assert f"attack: {script.stem.capitalize()}" in done.stdout
    vertices, faces = int(logged(done.stdout, "vertices")), int(logged(done.stdout, "faces"))
    assert f"saved as {output} ({vertices} vn {faces} fn)" in done.stdout


def test_no_attack_lacks_its_script() -> None:
    """The table of the library has a row for each."""
    rows = re.findall(r"\{Attack::(\w+),", (ROOT / "vcg_ext" / "attack" / "attack.cpp").read_text(encoding="utf-8"))
    assert sorted(name.lower() for name in rows) == [path.stem for path in ATTACKS]


def test_distortion_against_the_first_layer(tmp_path: Path) -> None:
    noisy = tmp_path / "noisy.ply"
    door = MeshLabServer()
    assert door.arguments("-i", FANDISK, "-s", SCRIPTS / "attacks" / "noise.mlx", "-o", noisy).returncode == 0
    done = door.arguments("-i", FANDISK, noisy, "-s", SCRIPTS / "measure.mlx")
    assert done.returncode == 0, done.stdout
    mrms, hausdorff = logged(done.stdout, "mrms"), logged(done.stdout, "hausdorff")
    assert 0 < logged(done.stdout, "mean") < mrms < hausdorff
    same = door.arguments("-i", FANDISK, FANDISK, "-s", SCRIPTS / "measure.mlx")
    assert same.returncode == 0, same.stdout
    assert logged(same.stdout, "hausdorff") == pytest.approx(0, abs=1e-9)
