# SPDX-License-Identifier: GPL-3.0-or-later
"""The golden marks of tests/golden, which pin the format of a mark, for the tests of both doors."""

import json
from pathlib import Path

import pytest
from doors import DETECT, Door

FOLDER = Path(__file__).resolve().parent / "golden"
MARKS: list[dict] = json.loads((FOLDER / "golden.json").read_text(encoding="utf-8"))
each_mark = pytest.mark.parametrize("mark", MARKS, ids=[mark["file"] for mark in MARKS])


def check(door: Door, mark: dict) -> None:
    """Detection must read what it read when the mark was made: with its key, and with another."""
    for reading in mark["readings"]:
        found = door.run(
            DETECT, FOLDER / mark["file"], Key=reading["key"], Expected=mark["message"], **mark["settings"]
        )
        assert found["bits"] == reading["bits"]
        assert found["soft"] == pytest.approx(reading["soft"], rel=1e-9)
        assert found["p_value"] == pytest.approx(reading["p_value"], rel=1e-9)
