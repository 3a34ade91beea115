# SPDX-License-Identifier: GPL-3.0-or-later
"""The doors to the filters that can be scripted: meshlabserver (2020.09, float) and pymeshlab (2025.07, double).

Both take the same parameters and answer with the filter's report, so that a test can be run through either.
"""

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import ClassVar
from xml.etree import ElementTree

import pymeshlab

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build"
MESHES = BUILD / "data" / "meshes"

METHODS = ["Layered", "Waves", "L-M", "QSP", "Cho", "Geodesic", "Spectral"]
STATISTICS = ["Mean", "Variance"]
WITHOUT_STATISTIC = ["Layered", "Waves", "Spectral"]

EMBED = "Watermark: Embed"
DETECT = "Watermark: Detect"
DETECT_WITH_ORIGINAL = "Watermark: Detect with Original"

Value = str | int | float | bool
Report = dict[str, object]

CARRIERS: dict[str, tuple[str, Value]] = {
    "Method": ("RichEnum", "Layered"),
    "Statistic": ("RichEnum", "Mean"),
    "Key": ("RichString", ""),
    "Bits": ("RichInt", 0),
    "Trim": ("RichFloat", -1),
}
# Filter -> name in pymeshlab, and its parameters: name -> type in .mlx and default, in the filter's order.
FILTERS: dict[str, tuple[str, dict[str, tuple[str, Value]]]] = {
    EMBED: (
        "apply_coord_watermark",
        {
            "Message": ("RichString", ""),
            **CARRIERS,
            "Strength": ("RichFloat", 0),
            "Rehearse": ("RichBool", False),
            "Certificate": ("RichSaveFile", ""),
            "Report": ("RichSaveFile", ""),
        },
    ),
    DETECT: (
        "get_watermark",
        {
            **CARRIERS,
            "Expected": ("RichString", ""),
            "ShowCarriers": ("RichBool", False),
            "Report": ("RichSaveFile", ""),
        },
    ),
    DETECT_WITH_ORIGINAL: (
        "get_watermark_with_original",
        {
            **CARRIERS,
            "Original": ("RichMesh", 0),
            "Certificate": ("RichOpenFile", ""),
            "Expected": ("RichString", ""),
            "Report": ("RichSaveFile", ""),
        },
    ),
}
CHOICES = {"Method": METHODS, "Statistic": STATISTICS}


class Refused(Exception):
    """The filter failed: its text, and meshlabserver's exit code."""

    def __init__(self, text: str, exit_code: int | None = None) -> None:
        super().__init__(text)
        self.exit_code = exit_code


def script(filter_name: str, values: dict[str, Value]) -> str:
    """An .mlx of one filter; it names every parameter, because MeshLab 2020.09 aborts where one is left out."""
    root = ElementTree.Element("FilterScript")
    element = ElementTree.SubElement(root, "filter", name=filter_name)
    for name, (kind, default) in FILTERS[filter_name][1].items():
        value = values.get(name, default)
        attributes = {"name": name, "type": kind}
        if name in CHOICES:
            value = CHOICES[name].index(str(value))
            attributes["enum_cardinality"] = str(len(CHOICES[name]))
        if kind == "RichOpenFile":
            attributes["exts_cardinality"] = "0"
        attributes["value"] = str(value).lower() if isinstance(value, bool) else str(value)
        ElementTree.SubElement(element, "Param", attributes)
    return "<!DOCTYPE FilterScript>\n" + ElementTree.tostring(root, encoding="unicode")


class MeshLabServer:
    """Debian's meshlabserver, staged with the plugin. Needs a display (fixture `display`)."""

    name = "meshlabserver"
    program = BUILD / "stage" / "bin" / "meshlabserver"

    def arguments(self, *arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
        """Runs it as a user would in a shell."""
        return subprocess.run(
            [str(self.program), *map(str, arguments)],
            env={**os.environ, **environment},
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=120,
            check=False,
        )

    def run(
        self, filter_name: str, mesh: Path, output: Path | None = None, before: Path | None = None, **values: Value
    ) -> Report:
        """Opens a mesh, after the one `before` where given (layer 0), applies one filter to it, saves it where `output`
        is given, and returns the report."""
        with tempfile.TemporaryDirectory() as folder:
            values = {"Report": f"{folder}/report.json", **values}
            Path(folder, "script.mlx").write_text(script(filter_name, values), encoding="utf-8")
            save = ["-o", output] if output else []
            meshes = [before, mesh] if before else [mesh]
            done = self.arguments("-i", *meshes, "-s", f"{folder}/script.mlx", *save)
            if done.returncode != 0:
                raise Refused(done.stdout, done.returncode)
            return json.loads(Path(str(values["Report"])).read_text(encoding="utf-8"))


class PyMeshLab:
    """pymeshlab with the plugin loaded."""

    name = "pymeshlab"
    plugin = BUILD / "meshlab-2025.07" / "libfilter_watermark.so"
    # pymeshlab keeps a pointer to the log of the MeshSet whose filter failed, and writes to it: these must live on.
    failed: ClassVar[list[pymeshlab.MeshSet]] = []

    def __init__(self) -> None:
        if FILTERS[EMBED][0] not in pymeshlab.filter_list():
            pymeshlab.load_plugin(str(self.plugin))

    def apply(self, meshes: pymeshlab.MeshSet, filter_name: str, **values: Value) -> Report:
        """Applies one filter to the current layer and returns the report."""
        with tempfile.TemporaryDirectory() as folder:
            values = {"Report": f"{folder}/report.json", **values}
            lowered = {name.lower(): value for name, value in values.items()}
            try:
                meshes.apply_filter(FILTERS[filter_name][0], **lowered)
            except pymeshlab.PyMeshLabException as error:
                self.failed.append(meshes)
                raise Refused(str(error)) from error
            return json.loads(Path(str(values["Report"])).read_text(encoding="utf-8"))

    def run(
        self, filter_name: str, mesh: Path, output: Path | None = None, before: Path | None = None, **values: Value
    ) -> Report:
        """Opens a mesh, after the one `before` where given (layer 0), applies one filter to it, saves it where `output`
        is given, and returns the report."""
        meshes = pymeshlab.MeshSet()
        for path in [before, mesh] if before else [mesh]:
            meshes.load_new_mesh(str(path))
        report = self.apply(meshes, filter_name, **values)
        if output:
            meshes.save_current_mesh(str(output))
        return report


DOORS = {door.name: door for door in (MeshLabServer, PyMeshLab)}
Door = MeshLabServer | PyMeshLab
