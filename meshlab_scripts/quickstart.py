# SPDX-License-Identifier: GPL-3.0-or-later
"""Watermark a mesh and read the mark back, in Python."""

from pathlib import Path

import pymeshlab

build = Path(__file__).resolve().parents[1] / "build"
pymeshlab.load_plugin(str(build / "meshlab-2025.07" / "libfilter_watermark.so"))
meshes = pymeshlab.MeshSet()
meshes.load_new_mesh(str(build / "data" / "meshes" / "bunny00.off"))
embedded = meshes.apply_filter("apply_coord_watermark", message="(c) Jane", key="env:WATERMARK_KEY")
meshes.save_current_mesh(str(build / "quickstart" / "marked-python.ply"))
meshes.load_new_mesh(str(build / "quickstart" / "marked-python.ply"))
found = meshes.apply_filter("get_watermark", expected="(c) Jane", key="env:WATERMARK_KEY")
print(f"MRMS over the diagonal: {embedded['mrms_relative']:.3g}, matching bits: {found['detection_ratio']:.0%}, "
      f"p_value: {found['p_value']:.3g}, present: {found['present']}")  # fmt: skip
