# SPDX-License-Identifier: GPL-3.0-or-later
"""The site: it is built without a warning, loads nothing from elsewhere, names everything, and its blocks run."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from blocks import Block, blocks, reader_in, run
from doors import BUILD, ROOT

SITE = ROOT / "meshlab_scripts" / "site"
sys.path.insert(0, str(SITE))
import excerpts  # noqa: E402
import hooks  # noqa: E402
import reference  # noqa: E402
from equations import with_mathml  # noqa: E402
from meshmark import host, plugin  # noqa: E402
from meshmark.command import single  # noqa: E402
from meshmark.settings import Method  # noqa: E402

README_BLOCKS = blocks((ROOT / "README.md").read_text(encoding="utf-8"))  # test_readme.py runs these
LOADING = {("script", "src"), ("img", "src"), ("link", "href"), ("source", "src"), ("iframe", "src")}


class Links(HTMLParser):
    """What a page loads, what it links to, and the places in it that can be linked to."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.loads, self.links, self.ids = set(), set(), set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if (tag, name) in LOADING and ("rel", "canonical") not in attrs:
                self.loads.add(value)
            elif name == "href":
                self.links.add(value)
            elif name == "id":
                self.ids.add(value)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [BUILD / "venv/bin/mkdocs", "build", "--strict", "--quiet", "-f", SITE / "mkdocs.yml", "--site-dir", folder],
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "")
    return folder


def page(name: str) -> str:
    return hooks.assembled((SITE / "docs" / name).read_text(encoding="utf-8"), name)


def pages() -> Iterator[str]:
    for path in sorted((SITE / "docs").rglob("*.md")):
        yield path.relative_to(SITE / "docs").as_posix()


def blocks_to_run() -> dict[str, list[Block]]:
    """Per page its blocks, without those of the README, those that say why not, and whole files, which are built."""
    by_page = {
        name: [one for one in blocks(page(name)) if one not in README_BLOCKS and one.language not in ("cpp", "cmake")]
        for name in pages()
    }
    return {name: kept for name, listed in by_page.items() if (kept := [one for one in listed if not one.left_out])}


def test_a_page_loads_nothing_but_what_is_in_the_folder(built: Path) -> None:
    every = {path: Links(path) for path in built.rglob("*.html")}
    assert len(every) > 20
    for path, one in every.items():
        assert one.loads, path
        here = [link for link in one.loads | one.links if path.name != "404.html" and not urlsplit(link).scheme]
        assert not [link for link in one.loads if urlsplit(link).scheme or link.startswith("//")], path
        for link in here:
            parts = urlsplit(link)
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            assert target.is_file(), f"{path.name} links to {link}"
            if parts.fragment and target in every:
                assert unquote(parts.fragment) in every[target].ids | {"__skip"}, f"{path.name} links to {link}"
        # What the theme's script would fetch, were there any: diagrams, and comments.
        assert not re.search(r'class="[^"]*mermaid|giscus', path.read_text(encoding="utf-8")), path
    for style in built.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*[\"']?(https?:)?//", style.read_text(encoding="utf-8")), style


def test_every_equation_is_mathml(built: Path) -> None:
    texts = [path.read_text(encoding="utf-8") for path in built.rglob("*.html")]
    assert sum(text.count("<math ") for text in texts) > 60
    assert not any("arithmatex" in text or r"\frac" in text for text in texts)


def test_mathml_says_what_the_equation_says() -> None:
    made = with_mathml('<p><span class="arithmatex">\\(a_k &lt; |b|\\)</span></p>')
    assert re.sub("<[^>]*>", "", made) == "ak&#x0003C;&#x0007C;b&#x0007C;"
    assert '<math xmlns="http://www.w3.org/1998/Math/MathML" display="inline">' in made


def test_filters_page_has_every_parameter_and_every_result() -> None:
    text = page("filters.md")
    with host.own_meshes() as meshes:
        for _ in range(2):
            host.read(meshes, reference.MESH)
        reports = [
            host.apply_with_report(meshes, plugin.EMBED, message="id:1", key="k", method="L-M", rehearse=True),
            host.apply_with_report(meshes, plugin.DETECT, expected="id:1", key="k", method="L-M"),
            host.apply_with_report(meshes, plugin.DETECT_WITH_ORIGINAL, key="k", method="L-M", bits=64, original=0),
            host.apply_with_report(meshes, plugin.MEASURE, reference=0),
        ]
        names = {name for one in reference.FILTERS for name in meshes.filter_parameter_values(one)}
    fields = {field for report in reports for field in report}
    fields |= {field for report in reports for field in report.get("registration", {})}
    assert {"recipe", "p_value", "overlap", "snr_db"} <= fields
    told = set(re.findall(r"`(\w+)`", text))
    assert fields <= told, fields - told
    assert names <= {name.lower() for name in told}


def test_attacks_are_told_with_what_the_filter_takes() -> None:
    rows = reference.attacks().splitlines()[2:]
    assert len(rows) == len(list((ROOT / "meshlab_scripts" / "attacks").iterdir()))
    assert "| Quantize | bits per axis | 8 | a whole number between 2 and 24 |  |" in rows
    assert tuple(row.split(" | ")[0].removeprefix("| ") for row in rows) == single.ATTACKS


def test_strengths_are_told_with_what_the_filter_takes() -> None:
    rows = reference.strengths().splitlines()[2:]
    assert [row.split(" | ")[0].removeprefix("| ") for row in rows] == list(Method)
    assert "| Cho | 0.1 | above 0, up to 0.45 or 0.3 |" in rows


def test_the_command_page_tells_exit_codes_and_every_command() -> None:
    text = page("command.md")
    assert "Exit codes: 0 found" in text
    assert text.count("\n## meshmark ") == 7


def test_an_excerpt_that_is_not_there_is_an_error() -> None:
    with pytest.raises(LookupError, match="no section 'Two command'"):
        excerpts.section("README.md", "Two command")
    with pytest.raises(LookupError, match="Nothing is left"):
        excerpts.table("vcg_ext/README.md", "The methods of vertex norms", rows=["Nobody"])
    with pytest.raises(LookupError, match="no struct"):
        reference.results("watermark/report.h", "Report")


def test_a_table_keeps_the_rows_and_columns_that_are_asked_for() -> None:
    assert excerpts.table(
        "vcg_ext/README.md", "The methods of vertex norms", rows=["Waves"], head=["first"], columns=["L-M", "Cho"]
    ).splitlines()[::2] == ["| first | L-M | Cho |", "| Waves | -18 | -7, -14 |"]


@pytest.mark.parametrize("name", sorted(blocks_to_run()))
def test_every_block_runs(name: str, tmp_path: Path) -> None:
    printed = run(blocks_to_run()[name], reader_in(tmp_path))
    if name == "first-mark.md":
        first, second, third = printed
        assert first.count("(c) Jane") >= 3
        assert "present: the mesh carries '(c) Jane'" in second
        assert "not found: no mark of this key" in third


def test_paths_that_pages_name_are_there() -> None:
    """In code spans: what begins with a folder of the repository, unless part of it stands for something."""
    named = {
        (name, path)
        for name in pages()
        for path in re.findall(r"`\.?/?((?:tests|meshlab_scripts|filter_watermark)/[\w./-]+)[^`]*`", page(name))
    }
    assert len(named) > 10
    missing = [one for one in named if not (ROOT / one[1]).exists() and not re.search("NAME|VERSION", one[1])]
    assert not [one for one in missing if not list(ROOT.glob(f"{one[1]}.*"))], missing
