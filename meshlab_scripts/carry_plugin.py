# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the plugin as built into the wheel of meshmark, and the one library that neither it nor pymeshlab has.

Called by hatchling. An editable install takes the plugin from the build folder when it runs, and needs none yet.
"""

import re
import subprocess
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PLUGIN = Path("build/meshlab-2025.07/libfilter_watermark.so")
SODIUM = "libsodium.so.23"


class CarryPlugin(BuildHookInterface):
    """Adds two files, and names the platform that they are for."""

    def initialize(self, version: str, build_data: dict) -> None:
        if self.target_name != "wheel" or version == "editable":
            return
        plugin = Path(self.root).parent / PLUGIN
        if not plugin.is_file():
            raise SystemExit(f"{plugin} is not built yet. Run meshlab_scripts/quickstart.sh or tests/run.sh first.")
        build_data["force_include"][str(plugin)] = f"meshmark/{plugin.name}"
        build_data["force_include"][str(_library(plugin, SODIUM))] = f"meshmark/{SODIUM}"
        build_data["pure_python"] = False
        build_data["tag"] = "py3-none-linux_x86_64"


def _library(plugin: Path, name: str) -> Path:
    """Where the system's loader finds it."""
    listed = subprocess.run(["ldd", plugin], stdout=subprocess.PIPE, text=True, check=True).stdout
    return Path(re.search(rf"{re.escape(name)} => (\S+)", listed)[1]).resolve()
