# SPDX-License-Identifier: GPL-3.0-or-later
"""Every source file says its licence, in the form that tools read."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KINDS = ["*.h", "*.cpp", "*.py", "*.sh", "*.cmake", "*CMakeLists.txt", ".ci/run"]
LINE = "SPDX-License-Identifier: GPL-3.0-or-later"


def test_every_source_file_names_its_licence_in_its_first_three_lines() -> None:
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *KINDS],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    ).stdout
    files = [ROOT / name for name in listed.split("\0") if name and (ROOT / name).is_file()]
    assert len(files) > 100, "git lists hardly any file: is this a clone?"
    missing = [
        str(path.relative_to(ROOT))
        for path in files
        if not any(LINE in line for line in path.read_text(encoding="utf-8").splitlines()[:3])
    ]
    assert not missing, f"Write {LINE} in a comment at their top"
