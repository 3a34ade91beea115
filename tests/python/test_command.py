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
from meshmark.command.app import main

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
