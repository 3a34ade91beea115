# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks of code of a text, run one after the other in one shell, as a reader would."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pymeshlab
from doors import BUILD, MESHES, ROOT

MARK = "-- block"
# Blocks, by their first line, that are not run here, and why.
NOT_RUN = {
    "./meshlab_scripts/quickstart.sh": "set-up and build; the second line is what runs these tests",
    "build/tests/code_rates all >rates.csv": "takes hours",
    "build/venv/bin/python tests/golden/make.py": "overwrites the golden marks; test_golden.py reads what it made",
}


@dataclass(frozen=True)
class Block:
    """What stands between two fences, and the language that the first one names."""

    language: str
    text: str

    @property
    def left_out(self) -> bool:
        return any(self.text.startswith(line) for line in NOT_RUN)


def blocks(markdown: str) -> list[Block]:
    """All blocks with a language, in their order."""
    return [Block(*found) for found in re.findall(r"^```(\w+)\n(.*?)^```$", markdown, re.DOTALL | re.MULTILINE)]


def reader_in(folder: Path) -> Path:
    """A folder as blocks expect it: the checkout around, a model, and nothing else."""
    for name in ("meshlab_scripts", "tests", "build"):
        (folder / name).symlink_to(BUILD if name == "build" else ROOT / name)
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(MESHES / "fandisk.off"))
    meshes.save_current_mesh(str(folder / "bunny.ply"))
    return folder


def run(listed: list[Block], folder: Path) -> list[str]:
    """Runs shell and Python in one session, and returns what each block printed. Fails where one of them does."""
    script = [f"python={sys.executable}"]
    for i, block in enumerate(listed):
        script.append(f"echo '{MARK}'")
        if block.language == "python":
            (folder / f"block-{i}.py").write_text(block.text, encoding="utf-8")
            script.append(f'"$python" block-{i}.py')
        else:
            assert block.language == "sh", f"cannot run {block.language}"
            script.append(block.text)
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", "\n".join(script)], cwd=folder, env={**os.environ, "NO_COLOR": "1"},
        encoding="utf-8", stdout=subprocess.PIPE, check=True,
    )  # fmt: skip
    return done.stdout.split(f"{MARK}\n")[1:]
