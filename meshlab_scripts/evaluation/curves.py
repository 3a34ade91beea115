# SPDX-License-Identifier: GPL-3.0-or-later
"""False positives, false negatives and the equal error rate of a detection ratio as the score."""

import math

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Array = NDArray[np.float64]


def error_rates(marked: Array, unmarked: Array, thresholds: Array) -> tuple[Array, Array]:
    """Rates of false positives and of false negatives, where a score of at least the threshold says `marked`."""
    return _part_from(unmarked, thresholds), 1 - _part_from(marked, thresholds)


def _part_from(scores: Array, thresholds: Array) -> Array:
    """The part of the scores that reaches each threshold."""
    return np.array([(scores >= threshold).mean() for threshold in thresholds])


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


def false_positives(rows: pd.DataFrame, thresholds: Array) -> dict[str, tuple[Array, Array]]:
    """Rates of false positives among searches in unmarked meshes, and what bounds them, by what these are the rates of.

    Methods are taken together where the bound is the same: for as many bits, and the best of as many readings. How many
    these are, the reported p-values say: that many times the tail of the binomial distribution, but never above 1.
    """
    groups: dict[tuple[int, int], list[pd.DataFrame]] = {}
    for (_, bits), found in rows.groupby(["method", "bits"], sort=False):
        tails = np.array([binomial_tail(bits, ratio) for ratio in found["detection_ratio"]])
        tries = int(np.rint((found["p_value"].to_numpy(float) / tails).max()))
        groups.setdefault((int(bits), tries), []).append(found)
    curves = {}
    for (bits, tries), found in groups.items():
        together = pd.concat(found)
        rate = _part_from(together["detection_ratio"].to_numpy(), thresholds)
        bound = np.array([min(1, tries * binomial_tail(bits, threshold)) for threshold in thresholds])
        methods = ", ".join(together["method"].unique())
        curves[f"{methods}, {bits} bits" if len(groups) > 1 else ""] = rate, bound
    return curves


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
