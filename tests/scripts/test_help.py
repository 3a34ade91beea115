# SPDX-License-Identifier: GPL-3.0-or-later
"""What the dialogs tell, as meshlabserver dumps it: short enough to be seen whole, in the words of the labels."""

import re
from typing import NamedTuple

import pytest
from doors import MeshLabServer

FILTERS = ["Embed", "Detect", "Detect with Original", "Attack", "Measure Distortion"]
LONGEST = 90  # characters, which are two lines beside a parameter in a dialog of its own size


class Help(NamedTuple):
    info: str
    tips: dict[str, str]  # of each label


@pytest.fixture(scope="module")
def dump(tmp_path_factory: pytest.TempPathFactory, display: str) -> dict[str, Help]:
    """The help of each of the plugin's filters."""
    path = tmp_path_factory.mktemp("dump") / "help.txt"
    MeshLabServer().arguments("-d", path)
    sections = re.split(r"\n\\section f\d+ ", path.read_text(encoding="utf-8"))
    found = {}
    for section in sections:
        name, _, rest = section.partition("\n")
        info, _, table = rest.partition("<H2> Parameters </h2>")
        tips = re.findall(r"</TD> <TD> (.*?) </TD> <TD><i> (.*?) -- </i></TD>", table, re.DOTALL)
        found[name.strip()] = Help(info.strip(), dict(tips))
    return found


@pytest.mark.parametrize("name", FILTERS)
def test_tooltips_are_seen_whole(dump: dict[str, Help], name: str) -> None:
    tips = dump[f"Watermark: {name}"].tips
    assert tips
    for label, tip in tips.items():
        assert len(tip) <= LONGEST, f"{label}: {len(tip)} characters: say the rest in the filter's info"
        assert tip.endswith("."), label
        assert "<" not in tip, label


@pytest.mark.parametrize("name", FILTERS)
def test_infos_name_parameters_by_their_labels(dump: dict[str, Help], name: str) -> None:
    info, tips = dump[f"Watermark: {name}"]
    for bold in re.findall(r"<b>(.*?)</b>", info):
        assert bold in tips or bold in dump or bold.startswith('"'), bold


def test_what_cannot_be_taken_back_is_told(dump: dict[str, Help]) -> None:
    assert "duplicate the layer first" in dump["Watermark: Attack"].info
    assert "(usual)" in dump["Watermark: Embed"].tips["Trim"]
    assert "usual" in dump["Watermark: Embed"].tips["Strength"]
