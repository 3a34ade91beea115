# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel has the plugin in it, and works where there is no checkout. meshlab_scripts/wheel.sh tries a fresh venv."""

import os
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

from doors import MESHES, ROOT

SCRIPT = """
import sys, meshmark
from meshmark import plugin
print(plugin.path())
meshmark.embed(sys.argv[1], "out.off", message="id:17", key="k", method="Waves")
print(meshmark.detect("out.off", expected="id:17", key="k", method="Waves").present)
print([line.split()[-1] for line in open("/proc/self/maps") if "libsodium" in line][0])
"""


def test_the_wheel_works_by_itself(tmp_path: Path) -> None:
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", tmp_path, ROOT / "meshlab_scripts"], check=True)
    (wheel,) = tmp_path.glob("meshmark-*-py3-none-linux_x86_64.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        (about,) = (name for name in names if name.endswith("METADATA"))
        needs = archive.read(about).decode()
        archive.extractall(tmp_path / "alone")  # all that an installer does to a wheel without scripts of its own
    assert {"meshmark/libfilter_watermark.so", "meshmark/libsodium.so.23", "meshmark/command/app.py"} <= set(names)
    assert f"Requires-Dist: pymeshlab=={metadata.version('pymeshlab')}" in needs

    alone = tmp_path / "alone"
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, MESHES / "elephant.off"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(alone)},
        text=True,
        stdout=subprocess.PIPE,
        check=True,
    )
    plugin, present, sodium = done.stdout.split()[-3:]
    assert Path(plugin).is_relative_to(alone)
    assert present == "True"
    assert Path(sodium).is_relative_to(alone)
