# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks copies of 3D models, one for each recipient, and tells from a found copy whose it was.

import meshmark
meshmark.embed("dragon.stl", "for-jane.stl", message="id:17", key="file:secret.key")
print(meshmark.detect("found.stl", expected="id:17", key="file:secret.key"))
"""

from .errors import Failed, FormatError, MeshmarkError, MovesTooMuch, NotReadBack, Refused
from .key import Key
from .length import Length
from .marking import attack, detect, embed, measure
from .reports import AttackReport, DetectReport, DistortionReport, EmbedReport
from .settings import Method, Settings, Statistic

__all__ = [
    "AttackReport", "DetectReport", "DistortionReport", "EmbedReport", "Failed", "FormatError", "Key", "Length",
    "MeshmarkError", "Method", "MovesTooMuch", "NotReadBack", "Refused", "Settings", "Statistic", "attack", "detect",
    "embed", "measure",
]  # fmt: skip
