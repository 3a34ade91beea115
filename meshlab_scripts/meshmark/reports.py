# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters' reports as typed objects. What a newer plugin adds is in `more`."""

from dataclasses import asdict, dataclass, field, fields
from enum import IntEnum
from typing import Self


@dataclass(frozen=True, kw_only=True)
class Report:
    """What all reports have."""

    version: str = ""
    warnings: list[str] = field(default_factory=list)
    more: dict[str, object] = field(default_factory=dict)

    @classmethod
    def read(cls, json: dict[str, object]) -> Self:
        """From the filter's own report."""
        known = {one.name for one in fields(cls)} - {"more"}
        return cls(
            **{name: value for name, value in json.items() if name in known},
            more={name: value for name, value in json.items() if name not in known},
        )

    def json(self) -> dict[str, object]:
        """As the filter wrote it: what it did not say is left out."""
        values = asdict(self)
        return {name: value for name, value in values.items() if name != "more" and value is not None} | self.more


@dataclass(frozen=True, kw_only=True)
class EmbedReport(Report):
    """What was embedded, and what that did to the surface. Lengths are in the mesh's own unit."""

    method: str
    statistic: str
    message: str
    bits: str
    strength: float
    trim: float
    carriers: int
    detection_ratio: float
    max_displacement: float
    mrms: float
    mrms_relative: float
    moved_vertices: int
    layers: list[str] = field(default_factory=list)
    samples_min: float | None = None
    capacity: int | None = None
    rounds: int | None = None
    guarded_vertices: int | None = None
    diagonal: float | None = None
    plane_bend: float | None = None
    change: str = ""
    seconds: dict[str, float] = field(default_factory=dict)
    solver: dict[str, float] | None = None
    moves: dict[str, int] | None = None
    rehearsal: dict[str, float] | None = None
    survival: str | None = None
    recipe: str = ""

    def __str__(self) -> str:
        return f"'{self.message}' is embedded: {self.change} To read it: {self.recipe}"


BOUNDS = ("p_message", "p_value", "p_binomial", "presence", "runner_up_p", "rehearsal")  # of probabilities


class Finding(IntEnum):
    """The verdict's kind."""

    NOT_FOUND = 0
    PRESENT = 1
    ANOTHER_MESSAGE = 2
    ANOTHER_KEY = 3  # or setting
    NO_MESSAGE = 4  # a mark of this key, but its message does not come out


@dataclass(frozen=True, kw_only=True)
class DetectReport(Report):
    """What was read, and what that is worth. Every p is an upper bound of the probability of as good a reading by
    chance.
    """

    method: str
    statistic: str
    carriers: int
    bits: str
    message: str
    trim: float
    soft: list[float]
    samples: list[float]
    p_message: float
    verified: bool
    verdict: str
    finding: int  # a Finding
    detection_ratio: float | None = None
    p_value: float | None = None
    p_binomial: float | None = None
    present: bool | None = None
    presence: float | None = None
    candidate: int | None = None
    runner_up_p: float | None = None
    smoothing_rounds: float | None = None
    orientation: object | None = None
    parts: list[dict[str, object]] | None = None  # of a plate whose whole said nothing: what was read instead
    layers: list[dict[str, object]] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def found(self) -> bool:
        """The expected message is there; without one, any message is, beyond doubt."""
        return self.verified if self.present is None else self.present

    def __str__(self) -> str:
        return self.verdict


@dataclass(frozen=True, kw_only=True)
class AttackReport(Report):
    """What was done to the mesh."""

    attack: str
    amount: float
    iterations: int
    seed: int
    vertices: int
    faces: int

    def __str__(self) -> str:
        return f"{self.attack} {self.amount:g}: {self.vertices:,} vertices and {self.faces:,} faces are left"


@dataclass(frozen=True, kw_only=True)
class DistortionReport(Report):
    """How far two meshes are apart. Lengths are in the reference's unit."""

    mrms: float
    mrms_relative: float
    hausdorff: float
    hausdorff_relative: float
    mean: float
    mean_relative: float
    area_change: float
    samples: int
    snr_db: float | None = None
    msdm: float | None = None
    volume_change: float | None = None

    def __str__(self) -> str:
        return f"MRMS {self.mrms:.3g}, Hausdorff {self.hausdorff:.3g}, {self.mrms_relative:.2g} of the diagonal"
