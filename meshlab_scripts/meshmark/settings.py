# SPDX-License-Identifier: GPL-3.0-or-later
"""What embedding and detection must agree on besides the key, and what only embedding needs."""

from dataclasses import dataclass
from enum import StrEnum


class Method(StrEnum):
    """The plugin's methods."""

    LAYERED = "Layered"
    WAVES = "Waves"
    LM = "L-M"
    QSP = "QSP"
    CHO = "Cho"
    GEODESIC = "Geodesic"
    SPECTRAL = "Spectral"


class Statistic(StrEnum):
    """What a carrier's values tell."""

    MEAN = "Mean"
    VARIANCE = "Variance"


@dataclass(frozen=True)
class Settings:
    """The recipe of a mark; it need not be secret."""

    method: str = Method.LAYERED
    statistic: str = Statistic.MEAN
    bits: int = 0  # number of carriers; 0: what the message needs
    trim: float = -1

    def values(self) -> dict[str, str | int | float]:
        """As the filters take it."""
        return {"method": str(self.method), "statistic": str(self.statistic), "bits": self.bits, "trim": self.trim}
