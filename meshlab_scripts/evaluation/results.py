# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a protocol as one tidy frame: a row for each case, sorted, the job's fields and then its results."""

from collections.abc import Iterable
from dataclasses import asdict

import numpy as np
import pandas as pd

from .protocol import Case, ProtocolError
from .store import Store

CASE_FIELDS = ["experiment", "series"]
INTERNAL = ["mesh_digest", "plugin_digest", "channel_digest"]
SORT = ["experiment", "mesh", "method", "bits", "strength", "limits", "kind", "series", "amount", "iterations", "key"]


class NoResults(LookupError):
    """The store has no result of any of the jobs."""

    def __init__(self) -> None:
        super().__init__("There are no results of this protocol yet, for these meshes and this plugin. Run it first.")


def limits_in_words(limits: tuple[tuple[str, float], ...]) -> str:
    """For tables and legends; as texts they sort by the first one's number."""
    names = {"mrms_relative": "MRMS", "msdm": "MSDM"}
    return ", ".join(
        f"{names.get(name, name)} at most {np.format_float_positional(limit, trim='-')}" for name, limit in limits
    )


def collect(cases: list[Case], store: Store) -> pd.DataFrame:
    """All cases that the store has; failed ones have an `error`. Raises NoResults where it has none."""
    stored = store.get(case.job for case in cases)
    rows = []
    for case in cases:
        if case.job.name not in stored:
            continue
        results, error = stored[case.job.name]
        inputs = asdict(case.job)
        inputs["limits"] = limits_in_words(case.job.limits)
        row = {"experiment": case.experiment, "series": case.series, **inputs}
        rows.append({**row, "error": error, **{f"used_{k}" if k in row else k: v for k, v in results.items()}})
    if not rows:
        raise NoResults
    frame = pd.DataFrame(rows).drop(columns=INTERNAL)
    given = [*CASE_FIELDS, *(name for name in asdict(cases[0].job) if name not in INTERNAL), "error"]
    measured = sorted({*frame.columns, "detection_ratio", "p_value"} - set(given))
    return frame.reindex(columns=[*given, *measured]).sort_values(SORT, ignore_index=True)


def require(frame: pd.DataFrame, names: Iterable[str], where: str) -> None:
    """:raises ProtocolError: where a figure or table shows what is no result"""
    if missing := sorted(set(names) - set(frame.columns)):
        there = ", ".join(sorted(frame.columns))
        raise ProtocolError(f"{where} shows {', '.join(missing)}, but the results are {there}.")


def split_times(frame: pd.DataFrame) -> tuple[pd.DataFrame, pd.DataFrame]:
    """What is the same in every run, and what is not: the times."""
    times = [name for name in frame.columns if name.startswith("seconds")]
    given = [name for name in [*SORT, "error"] if name in frame.columns]
    timed = frame.loc[frame["kind"] == "embed", [*given, *times]].dropna(axis=1, how="all")
    return frame.drop(columns=times), timed.drop(columns=["error"])


def select(frame: pd.DataFrame, experiment: str, series: str | None = None, where: dict | None = None) -> pd.DataFrame:
    """The rows of an experiment that did not fail; of one attack, or of the marks themselves where none is named."""
    chosen = frame[(frame["experiment"] == experiment) & (frame["error"] == "")]
    chosen = chosen[chosen["kind"] == "embed"] if series is None else chosen[chosen["series"] == series]
    for name, value in (where or {}).items():
        chosen = chosen[chosen[name] == value]
    return chosen
