"""False positives, false negatives and the equal error rate of a detection ratio as the score."""

import math

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Array = NDArray[np.float64]


def error_rates(marked: Array, unmarked: Array, thresholds: Array) -> tuple[Array, Array]:
    """Rates of false positives and of false negatives, where a score of at least the threshold says `marked`."""
    positive = np.array([(unmarked >= threshold).mean() for threshold in thresholds])
    negative = np.array([(marked < threshold).mean() for threshold in thresholds])
    return positive, negative


def equal_error_rate(marked: Array, unmarked: Array) -> float:
    """Where the two rates meet, on straight lines between the thresholds that occur."""
    thresholds = np.append(np.unique(np.concatenate([marked, unmarked])), np.inf)
    positive, negative = error_rates(marked, unmarked, thresholds)
    gap = negative - positive  # rises from -1 to 1
    after = int(np.argmax(gap >= 0))
    before = after - 1
    part = -gap[before] / (gap[after] - gap[before])
    return float(negative[before] + part * (negative[after] - negative[before]))


def binomial_tail(bits: int, ratio: float) -> float:
    """Chance of at least this part of matching bits without a mark; exact, because the message is masked by the key."""
    least = math.ceil(ratio * bits - 1e-9)
    return sum(math.comb(bits, k) for k in range(max(least, 0), bits + 1)) / 2**bits


def equal_error_rates(frame: pd.DataFrame, experiment: str) -> pd.DataFrame:
    """EER by attack (all amounts) and method; all meshes and keys together."""
    chosen = frame[(frame["experiment"] == experiment) & (frame["error"] == "")]
    unmarked = chosen[chosen["kind"] == "null"].groupby("method")["detection_ratio"]
    rates: dict[str, dict[str, float]] = {}
    for (series, method), marked in chosen[chosen["kind"] == "attack"].groupby(["series", "method"])["detection_ratio"]:
        if method in unmarked.groups:
            rates.setdefault(method, {})[series] = equal_error_rate(
                marked.to_numpy(), unmarked.get_group(method).to_numpy()
            )
    return pd.DataFrame(rates)
