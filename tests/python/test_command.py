# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `meshmark` as a shell sees it: exit codes, JSON, errors in one line, no key where others can see it."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from doors import MESHES
from meshmark import marking
from meshmark.command.app import main
from meshmark.command.output import show
from meshmark.reports import DetectReport, EmbedReport, Finding

KEY = "correct horse battery staple"
ELEPHANT = MESHES / "elephant.off"
COMMAND = Path(sys.executable).parent / "meshmark"


def run(*arguments: object, cwd: Path, key: str = KEY) -> subprocess.CompletedProcess[str]:
    """In a process of its own."""
    environment = {**os.environ, "WATERMARK_KEY": key, "COLUMNS": "200", "NO_COLOR": "1"}
    return subprocess.run(
        [COMMAND, *map(str, arguments)], cwd=cwd, env=environment, text=True, capture_output=True, check=False
    )


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., int]:
    """Exit code of the same command in this process: starting one takes longer than what it does."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")

    def call(*arguments: object, key: str = KEY) -> int:
        monkeypatch.setenv("WATERMARK_KEY", key)
        monkeypatch.setattr(sys, "argv", ["meshmark", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        return left.value.code

    return call


def test_exit_codes_json_and_key_files(tmp_path: Path, code: Callable[..., int]) -> None:
    (tmp_path / "secret.key").write_text("another key")
    with_file = ("--method", "Waves", "--key-file", "secret.key", "--json")
    embedded = run("embed", ELEPHANT, "out.off", "-m", "id:5", *with_file, cwd=tmp_path, key="")
    assert embedded.returncode == 0, embedded.stderr
    assert json.loads(embedded.stdout)["message"] == "id:5"
    found = run("detect", "out.off", "-e", "id:5", *with_file, cwd=tmp_path, key="")
    assert (found.returncode, json.loads(found.stdout)["present"]) == (0, True)
    assert "another key" not in embedded.stdout + embedded.stderr + found.stdout + found.stderr
    assert code("detect", "out.off", "-e", "id:6", *with_file) == 1
    assert code("detect", "out.off", "-e", "id:5", "--method", "Waves", "--bits", 64) == 1


def test_errors_are_a_line_with_the_cause_and_exit_code_2(
    tmp_path: Path, code: Callable[..., int], capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, words in [
        (("embed", ELEPHANT, "nowhere/out.off", "-m", "id:1", "--method", "Waves"), "cannot be written"),
        (("detect", ELEPHANT, "--key-file", "none.key"), "none.key"),
        (("detect", "nothere.stl"), "There is no file 'nothere.stl'"),
        (("embed", ELEPHANT, "out.off", "-m", "file:list.txt"), "does not begin with 'file:'"),
        (("embed", ELEPHANT, "out.off", "-m", "id:1", "--max-move", "0mm"), "above 0"),
    ]:
        assert code(*arguments) == 2, arguments
        said = capsys.readouterr().err
        assert words in said
        assert "Traceback" not in said
    assert code("detect", ELEPHANT, key="") == 2
    assert code("detect") == 2
    done = run("detect", "nothere.stl", cwd=tmp_path)
    assert (done.returncode, done.stderr.count("\n"), done.stdout) == (2, 1, "")
    assert list(tmp_path.iterdir()) == []


def test_a_fault_of_our_own_is_an_error_and_not_a_missing_mark(
    code: Callable[..., int], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(marking, "detect", lambda *_, **__: 1 // 0)
    assert code("detect", ELEPHANT) == 2
    assert "fault of meshmark: ZeroDivisionError" in capsys.readouterr().err


def test_what_is_shown_of_a_probability_is_rounded_up(capsys: pytest.CaptureFixture[str]) -> None:
    report = DetectReport(
        method="Layered", statistic="Mean", carriers=64, bits="", message="", trim=0, soft=[], samples=[],
        p_message=3.21e-9, verified=True, verdict="Found.", finding=Finding.PRESENT, p_value=1.0001e-12,
        runner_up_p=0.50001,
    )  # fmt: skip
    show(report, as_json=False)
    said = capsys.readouterr().out
    assert "3.3e-9" in said
    assert "1.1e-12" in said
    assert "0.51" in said


def test_what_a_rehearsal_found_is_said_last_with_the_recipe(capsys: pytest.CaptureFixture[str]) -> None:
    report = EmbedReport(
        method="L-M", statistic="Mean", message="id:5", bits="", strength=0.1, trim=0, carriers=64, detection_ratio=1,
        max_displacement=0, mrms=0, mrms_relative=0, moved_vertices=0, change="the surface moves.",
        rehearsal={"noise": 1.122e-17}, survival="survives noise .1 % (p 1e-16); is lost by smoothing .5 x 5.",
        recipe="read it with Method L-M.",
    )  # fmt: skip
    show(report, as_json=False)
    *_, last = capsys.readouterr().out.splitlines()
    assert last == (
        "'id:5' is embedded: the surface moves. The mark survives noise .1 % (p 1e-16); is lost by smoothing .5 x 5. "
        "Read it with Method L-M."
    )
