# SPDX-License-Identifier: GPL-3.0-or-later
"""Run by Blender, on its own Python: an STL file with one modifier applied. SOURCE TARGET MODIFIER AMOUNT."""

import sys

import bpy

source, target, kind, amount = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_mesh.stl(filepath=source)
modifier = bpy.context.object.modifiers.new("modifier", kind)
if kind == "REMESH":
    modifier.mode = "VOXEL"
    modifier.voxel_size = float(amount)
else:
    modifier.ratio = float(amount)
bpy.ops.export_mesh.stl(filepath=target, use_mesh_modifiers=True)
