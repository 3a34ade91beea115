# SPDX-License-Identifier: GPL-3.0-or-later
"""The results on disk: one SQLite file, written as they come by one process; killed at any time it is whole."""

import json
import sqlite3
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

from .filters import Numbers
from .jobs import Job


class Store:
    """Results by the job's name. An error is a result too."""

    def __init__(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._connection = sqlite3.connect(path)
        self._connection.execute("PRAGMA journal_mode=WAL")
        self._connection.execute("PRAGMA synchronous=NORMAL")
        self._connection.execute(
            "CREATE TABLE IF NOT EXISTS results"
            " (name TEXT PRIMARY KEY, job TEXT NOT NULL, results TEXT NOT NULL, error TEXT NOT NULL)"
        )

    def add(self, job: Job, results: Numbers, error: str) -> None:
        """Keeps a result. A job that is there already is an error: none is done twice."""
        with self._connection:
            self._connection.execute(
                "INSERT INTO results VALUES (?, ?, ?, ?)",
                (job.name, json.dumps(asdict(job)), json.dumps(results), error),
            )

    def get(self, jobs: Iterable[Job]) -> dict[str, tuple[Numbers, str]]:
        """What there is of these jobs: results and error by name."""
        wanted = {job.name for job in jobs}
        rows = self._connection.execute("SELECT name, results, error FROM results")
        return {name: (json.loads(results), error) for name, results, error in rows if name in wanted}

    def forget_failed(self) -> None:
        """Drops the jobs that failed, so that they are tried again."""
        with self._connection:
            self._connection.execute("DELETE FROM results WHERE error != ''")

    def close(self) -> None:
        """Folds the write-ahead log into the file."""
        self._connection.close()
