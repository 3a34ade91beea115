# SPDX-License-Identifier: GPL-3.0-or-later
"""One answer through every door: the library is the same in both hosts, and so must the bits be."""

from pathlib import Path

import pytest
from doors import DETECT, DOORS, EMBED, MESHES, METHODS, STATISTICS, WITHOUT_STATISTIC, Value

KEY = "correct horse battery staple"
MESSAGE = "(c) 2026"

pytestmark = pytest.mark.usefixtures("display")


@pytest.mark.parametrize("mesh", ["bunny00", "fandisk", "armadillo"])
@pytest.mark.parametrize("statistic", STATISTICS)
@pytest.mark.parametrize("method", METHODS)
def test_what_one_door_embeds_each_door_reads(tmp_path: Path, mesh: str, statistic: str, method: str) -> None:
    if method in WITHOUT_STATISTIC and statistic != STATISTICS[0]:
        return  # the same again
    carriers: dict[str, Value] = {"Method": method, "Statistic": statistic, "Key": KEY}
    embedded, found = {}, {}
    for name, door in DOORS.items():
        output = tmp_path / f"{name}.ply"
        embedded[name] = door().run(EMBED, MESHES / f"{mesh}.off", output, Message=MESSAGE, **carriers)
        for reader, other in DOORS.items():
            report = other().run(DETECT, output, Expected=MESSAGE, **carriers)
            assert report["message"] == MESSAGE, (name, reader)
            assert report["detection_ratio"] == 1, (name, reader)
            assert report["present"] is True, (name, reader)
            found[name, reader] = report["soft"]
    # The doors store other scalars (float, double), but embed the same thing and read one file alike.
    first, second = DOORS
    assert embedded[first]["bits"] == embedded[second]["bits"]
    assert embedded[first]["mrms"] == pytest.approx(embedded[second]["mrms"], rel=0.02)
    assert found[first, first] == pytest.approx(found[first, second], rel=1e-9)


def test_numbers_typed_alike_are_alike(tmp_path: Path) -> None:
    """0.1 is not the same number in float and in double; the report says what was used."""
    used = [
        door().run(EMBED, MESHES / "fandisk.off", Message=MESSAGE, Key=KEY, Method="L-M", Trim=0.1, Strength=0.07)
        for door in DOORS.values()
    ]
    assert [report["trim"] for report in used] == [0.1, 0.1]
    assert [report["strength"] for report in used] == [0.07, 0.07]
