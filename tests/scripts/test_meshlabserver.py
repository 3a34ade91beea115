# SPDX-License-Identifier: GPL-3.0-or-later
"""Regression through meshlabserver scripts: embed, write a file, detect from the file."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from doors import DETECT, EMBED, MESHES, ROOT, STATISTICS, MeshLabServer, Refused, Value, script

KEY = "correct horse battery staple"
MESSAGE = "(c) 2026"
BUNNY = MESHES / "bunny00.off"
MARK: dict[str, Value] = {"Method": "Cho", "Key": KEY}

pytestmark = pytest.mark.usefixtures("display")


@pytest.fixture(scope="session")
def marked(tmp_path_factory: pytest.TempPathFactory, display: str) -> Path:
    """bunny00 with MESSAGE."""
    output = tmp_path_factory.mktemp("marked") / "bunny.ply"
    MeshLabServer().run(EMBED, BUNNY, output, Message=MESSAGE, **MARK)
    return output


@pytest.mark.parametrize("extension", ["ply", "off", "stl"])
@pytest.mark.parametrize("statistic", STATISTICS)
def test_every_bit_is_read_back_from_the_file(tmp_path: Path, extension: str, statistic: str) -> None:
    output = tmp_path / f"marked.{extension}"
    door = MeshLabServer()
    embedded = door.run(EMBED, BUNNY, output, Message=MESSAGE, Statistic=statistic, **MARK)
    found = door.run(DETECT, output, Expected=MESSAGE, Statistic=statistic, **MARK)
    assert embedded["detection_ratio"] == 1
    assert found["message"] == MESSAGE
    assert found["bits"] == embedded["bits"]
    assert found["detection_ratio"] == 1
    assert found["p_binomial"] == 2.0**-127  # 128 carriers, and half of the doubt is for other numbers of them
    assert found["present"] is True


def test_distortion_is_that_of_the_published_method(tmp_path: Path) -> None:
    report = MeshLabServer().run(
        EMBED, BUNNY, tmp_path / "m.ply", Message=MESSAGE, Trim=0.1, Strength=0.1, Bits=64, **MARK
    )
    assert 2.5e-4 < report["mrms_relative"] < 3.3e-4


def test_without_an_expected_message_the_key_alone_reads_it(marked: Path) -> None:
    found = MeshLabServer().run(DETECT, marked, **MARK)
    assert found["message"] == MESSAGE
    assert found["verified"] is True
    assert found["p_message"] < 1e-6
    assert not {"p_value", "present", "detection_ratio"} & found.keys()


def test_a_wrong_key_finds_nothing(marked: Path) -> None:
    found = MeshLabServer().run(DETECT, marked, Method="Cho", Key="another", Expected=MESSAGE)
    assert found["present"] is False
    assert found["p_value"] > 1e-3


def test_an_unmarked_mesh_has_no_mark() -> None:
    found = MeshLabServer().run(DETECT, BUNNY, Expected=MESSAGE, **MARK)
    assert found["present"] is False
    assert found["p_value"] > 1e-3


@pytest.mark.parametrize("bits", [128, 1025])  # works, fails
def test_a_key_from_a_file_or_the_environment_reaches_neither_log_nor_report(
    tmp_path: Path, marked: Path, bits: int
) -> None:
    (tmp_path / "key").write_text(KEY)
    report = tmp_path / "report.json"
    for key in (f"file:{tmp_path}/key", "env:WATERMARK_KEY"):
        values = {"Method": "Cho", "Key": key, "Expected": MESSAGE, "Bits": bits, "Report": str(report)}
        (tmp_path / "detect.mlx").write_text(script(DETECT, values))
        log = tmp_path / "log"
        arguments = ("-l", log, "-i", marked, "-s", tmp_path / "detect.mlx")
        done = MeshLabServer().arguments(*arguments, WATERMARK_KEY=KEY)
        assert (done.returncode == 0) == (bits == 128)
        for text in (done.stdout, *(path.read_text() for path in (log, report) if path.exists())):
            assert KEY not in text
        assert report.exists() == (bits == 128)
    if bits == 128:
        assert json.loads(report.read_text())["present"] is True


def test_the_scripts_for_users(tmp_path: Path) -> None:
    door = MeshLabServer()
    scripts = ROOT / "meshlab_scripts"
    environment = {"WATERMARK_KEY": KEY}
    output = tmp_path / "marked.ply"
    embedded = door.arguments("-i", BUNNY, "-s", scripts / "embed.mlx", "-o", output, **environment)
    assert embedded.returncode == 0, embedded.stdout
    detected = door.arguments("-i", output, "-s", scripts / "detect.mlx", **environment)
    assert detected.returncode == 0, detected.stdout
    assert "present: true" in detected.stdout
    beside = door.arguments("-i", BUNNY, output, "-s", scripts / "detect_with_original.mlx", **environment)
    assert beside.returncode == 0, beside.stdout
    assert "present: true" in beside.stdout
    assert KEY not in embedded.stdout + detected.stdout + beside.stdout


def test_a_matrix_that_stretches_is_in_the_file_that_is_written(tmp_path: Path) -> None:
    """MeshLab writes points without the layer's matrix: Embed applies it, so that what was seen is what is saved."""
    matrix = np.diag([1, 1, 1.5, 1])
    entries = " ".join(f'val{i}="{value}"' for i, value in enumerate(matrix.ravel()))
    stretch = (
        f'<filter name="Matrix: Set/Copy Transformation"><Param name="TransformMatrix" type="RichMatrix44f" {entries}/>'
        '<Param name="compose" type="RichBool" value="false"/><Param name="Freeze" type="RichBool" value="false"/>'
        '<Param name="allLayers" type="RichBool" value="false"/></filter>'
    )
    embed = script(EMBED, {**MARK, "Message": MESSAGE})
    (tmp_path / "embed.mlx").write_text(embed.replace("<FilterScript>", f"<FilterScript>{stretch}"))
    door, output = MeshLabServer(), tmp_path / "marked.ply"
    done = door.arguments("-i", BUNNY, "-s", tmp_path / "embed.mlx", "-o", output)
    assert done.returncode == 0, done.stdout
    assert "The layer's matrix stretches it" in done.stdout
    assert door.run(DETECT, output, Expected=MESSAGE, **MARK)["present"] is True
    sizes = [np.ptp(np.array(trimesh.load(path, process=False).vertices), axis=0) for path in (BUNNY, output)]
    np.testing.assert_allclose(sizes[1] / sizes[0], [1, 1, 1.5], rtol=0.01)


FAILURES: list[tuple[str, dict[str, Value], str]] = [
    (EMBED, {"Key": ""}, "key is empty"),
    (EMBED, {"Key": "file:/no/such/key"}, "key"),
    (EMBED, {"Key": "env:NO_SUCH_VARIABLE_AT_ALL"}, "NO_SUCH_VARIABLE_AT_ALL"),
    (EMBED, {"Message": ""}, "message"),
    (EMBED, {"Message": "far too long for sixty-four bits", "Bits": 64}, "64"),
    (EMBED, {"Message": "hex:XYZ"}, "hex"),
    (EMBED, {"Message": "bits:012"}, "only 0 and 1"),
    (EMBED, {"Bits": 1025}, "1024"),
    (EMBED, {"Bits": -1}, "1024"),
    (EMBED, {"Trim": 0.6}, "0.45"),
    (EMBED, {"Strength": 0.7}, "must lie above 0"),
    (EMBED, {"Report": "/no/such/folder/report.json"}, "/no/such/folder/report.json"),
    (DETECT, {"Key": ""}, "key is empty"),
    (DETECT, {"Bits": -2}, "1024"),
    (DETECT, {"Trim": 0.6}, "0.45"),
    (DETECT, {"Expected": "far too long for sixty-four bits", "Bits": 64}, "64"),
    (DETECT, {"Report": "/no/such/folder/report.json"}, "/no/such/folder/report.json"),
]


@pytest.mark.parametrize(("filter_name", "values", "text"), FAILURES)
def test_a_failure_says_why_and_writes_no_mesh(
    tmp_path: Path, filter_name: str, values: dict[str, Value], text: str
) -> None:
    output = tmp_path / "out.ply"
    message: dict[str, Value] = {"Message": MESSAGE} if filter_name == EMBED else {}
    with pytest.raises(Refused) as refused:
        MeshLabServer().run(filter_name, MESHES / "fandisk.off", output, **{**MARK, **message, **values})
    log = str(refused.value)
    assert refused.value.exit_code == 255
    assert f"Problem with filter: {filter_name}" in log
    reason = next(line for line in log.splitlines() if line.startswith("LOG: 1 Error: "))
    assert text.lower() in reason.lower()
    assert KEY not in log
    assert not output.exists()


def test_a_mesh_too_small_for_the_bits_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Refused) as refused:
        MeshLabServer().run(EMBED, MESHES / "tetrahedron.off", tmp_path / "out.ply", Message=MESSAGE, **MARK)
    assert refused.value.exit_code == 255
    assert "LOG: 1 Error: " in str(refused.value)


def test_a_point_cloud_is_refused(tmp_path: Path) -> None:
    cloud = tmp_path / "cloud.off"
    cloud.write_text("OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
    for filter_name, message in ((EMBED, {"Message": MESSAGE}), (DETECT, {})):
        with pytest.raises(Refused) as refused:
            MeshLabServer().run(filter_name, cloud, **message, **MARK)
        assert refused.value.exit_code == 255
        assert "face" in str(refused.value)
