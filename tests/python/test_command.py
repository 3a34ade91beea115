# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `meshmark` as a shell sees it: exit codes, JSON, errors in one line, no key where others can see it."""

import json
import os
import subprocess
import sys
from pathlib import Path

from doors import MESHES

KEY = "correct horse battery staple"
FANDISK = MESHES / "fandisk.off"
COMMAND = Path(sys.executable).parent / "meshmark"


def run(*arguments: object, cwd: Path, key: str = KEY) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "WATERMARK_KEY": key, "COLUMNS": "200", "NO_COLOR": "1"}
    return subprocess.run(
        [COMMAND, *map(str, arguments)], cwd=cwd, env=environment, text=True, capture_output=True, check=False
    )


def test_exit_codes_json_and_key_files(tmp_path: Path) -> None:
    (tmp_path / "secret.key").write_text("another key")
    with_file = ("--method", "Waves", "--key-file", "secret.key", "--json")
    embedded = run("embed", FANDISK, "out.off", "-m", "id:5", *with_file, cwd=tmp_path, key="")
    assert embedded.returncode == 0, embedded.stderr
    assert json.loads(embedded.stdout)["message"] == "id:5"
    found = run("detect", "out.off", "-e", "id:5", *with_file, cwd=tmp_path, key="")
    assert (found.returncode, json.loads(found.stdout)["present"]) == (0, True)
    assert run("detect", "out.off", "-e", "id:6", *with_file, cwd=tmp_path).returncode == 1
    another = run("detect", "out.off", "-e", "id:5", "--method", "Waves", "--bits", 64, cwd=tmp_path)
    assert another.returncode == 1
    assert "another key" not in embedded.stdout + embedded.stderr + found.stdout + found.stderr


def test_errors_are_a_line_with_the_cause_and_exit_code_2(tmp_path: Path) -> None:
    for arguments, words in [
        (("detect", "nothere.stl"), "There is no file 'nothere.stl'"),
        (("embed", FANDISK, "nowhere/out.off", "-m", "id:1", "--method", "Waves"), "cannot be written"),
        (("detect", FANDISK, "--key-file", "none.key"), "none.key"),
    ]:
        done = run(*arguments, cwd=tmp_path)
        assert done.returncode == 2, arguments
        assert words in done.stderr
        assert "Traceback" not in done.stderr
    assert run("detect", FANDISK, cwd=tmp_path, key="").returncode == 2
    assert run("detect", cwd=tmp_path).returncode == 2
    assert list(tmp_path.iterdir()) == []
