# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured. A job is one row of the results, and its name the hash of all that the row depends on."""

import hashlib
import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path

# The thesis' names of the methods, and ours: the plugin's Method and Statistic.
METHODS = {
    "Layered": ("Layered", "Mean"),
    "Waves": ("Waves", "Mean"),
    "L-MMean": ("L-M", "Mean"),
    "L-MVar": ("L-M", "Variance"),
    "QSPMean": ("QSP", "Mean"),
    "QSPVar": ("QSP", "Variance"),
    "ChoMean": ("Cho", "Mean"),
    "ChoVar": ("Cho", "Variance"),
    "ProMean": ("Geodesic", "Mean"),
    "ProVar": ("Geodesic", "Variance"),
    "Spectral": ("Spectral", "Mean"),
}
PAYLOADS = ("bits", "id")


@dataclass(frozen=True)
class Job:
    """Kinds: `embed` marks a mesh and measures the mark; `attack` attacks the marked mesh, or sends it through a
    channel, and reads the mark; `null` looks for the mark in the unmarked mesh; `align` tells how far an attack moves
    the mesh's frame.
    """

    kind: str
    mesh: str
    mesh_digest: str
    plugin_digest: str
    method: str = ""
    bits: int = 64
    strength: float = 0
    limits: tuple[tuple[str, float], ...] = ()  # the strongest mark within these replaces a given strength
    trim: float = -1
    key: int = 0  # number of the key, and seed of the attack
    attack: str = ""
    amount: float = -1
    iterations: int = -1
    original: bool = False  # the mark is also read with the unmarked mesh at hand
    payload: str = "bits"  # the message: as many bits as carriers, or an `id` of 32, which the key alone can prove
    unit: str = ""  # of the amount: the plugin's own, or `mean norm` where it is in distances from the centre
    channel_digest: str = ""  # of the code that a channel is made of; empty where the attack is the plugin's

    @property
    def name(self) -> str:
        """A hash of all fields."""
        return hashlib.sha256(json.dumps(asdict(self), sort_keys=True).encode()).hexdigest()[:20]

    @property
    def mark(self) -> "Job":
        """The job that makes the mesh that this one attacks."""
        return replace(
            self, kind="embed", attack="", amount=-1, iterations=-1, unit="", channel_digest="", original=False
        )

    @property
    def before(self) -> "Job":
        """The job that this one needs: an attack its mark, one within limits that of key 0, whose strength is near."""
        return replace(self, key=0) if self.kind == "embed" and self.limits else self.mark

    @property
    def secret(self) -> str:
        """The key of this number."""
        return f"evaluation key {self.key}"

    @property
    def message(self) -> str:
        """The message that goes with the key, as the plugin takes it."""
        digest = hashlib.shake_256(f"evaluation message {self.key}".encode()).digest(self.bits // 8 + 1)
        if self.payload == "id":
            return f"id:{int.from_bytes(digest[:4])}"
        return "bits:" + "".join(f"{byte:08b}" for byte in digest)[: self.bits]


@dataclass(frozen=True)
class Site:
    """Where a job finds its inputs, and keeps marked meshes for the jobs that follow. No result depends on it."""

    meshes: Path
    plugin: Path
    cache: Path


def digest(*paths: Path) -> str:
    """A hash of a file's bytes, or of several files', one after the other."""
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()[:20]


def mesh_file(folder: Path, mesh: str) -> Path:
    """The file of a mesh, by its name without extension."""
    found = sorted(path for path in folder.glob(f"{mesh}.*") if path.suffix in {".off", ".ply", ".stl", ".obj"})
    if not found:
        raise FileNotFoundError(f"No mesh '{mesh}' in {folder}. Name a folder that has it with --meshes.")
    return found[0]
