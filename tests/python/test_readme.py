# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's blocks on meshmark, run one after the other as they stand there."""

import os
import re
import subprocess
import sys
from pathlib import Path

from doors import BUILD, ROOT

SECTION = "## A copy for each recipient"


def blocks() -> list[tuple[str, str]]:
    """Language and text of each block of the section."""
    section = (ROOT / "README.md").read_text(encoding="utf-8").partition(SECTION)[2].partition("\n## ")[0]
    return re.findall(r"```(sh|python)\n(.*?)```", section, re.DOTALL)


def test_every_block_does_what_the_readme_says(tmp_path: Path) -> None:
    (tmp_path / "build").symlink_to(BUILD)
    runs = {"sh": ["bash", "-euo", "pipefail", "-c"], "python": [sys.executable, "-c"]}
    said = {}
    for language, text in blocks():
        done = subprocess.run(
            [*runs[language], text], cwd=tmp_path, env={**os.environ, "NO_COLOR": "1"}, text=True,
            stdout=subprocess.PIPE, check=True,
        )  # fmt: skip
        said[language] = done.stdout
    assert said["sh"].count("Jane Doe: it is the copy of 'fandisk.off' for this recipient") == 2
    assert "What would refute it" in (tmp_path / "found.html").read_text(encoding="utf-8")
    marked, other, refused, found = said["python"].splitlines()
    assert marked.startswith("id:0")
    assert other.startswith("id:1")
    assert "cube.off" in refused
    assert found.startswith("True")


def test_from_a_clean_clone_in_under_ten_commands() -> None:
    shell = next(text for language, text in blocks() if language == "sh")
    assert 1 + len(shell.splitlines()) < 10  # and quickstart.sh
