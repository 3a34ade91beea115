# SPDX-License-Identifier: GPL-3.0-or-later
"""The README's blocks, run one after the other as they stand there."""

from pathlib import Path

from blocks import NOT_RUN, blocks, reader_in, run
from doors import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_every_block_does_what_the_readme_says(tmp_path: Path) -> None:
    listed = [block for block in blocks(README) if not block.left_out]
    server, python, shell, loop = run(listed, reader_in(tmp_path))
    assert "(c) Jane" in server
    assert python.startswith("True")
    assert shell.count("Jane Doe: it is the copy of 'fandisk.off' for this recipient") == 2
    assert "What would refute it" in (tmp_path / "found.html").read_text(encoding="utf-8")
    marked, other, refused, found = loop.splitlines()
    assert marked.startswith("id:0")
    assert other.startswith("id:1")
    assert "cube.off" in refused
    assert found.startswith("True")


def test_from_a_clean_clone_in_under_ten_commands() -> None:
    shell = next(block.text for block in blocks(README) if "meshmark catalog" in block.text)
    assert 1 + len(shell.splitlines()) < 10  # and quickstart.sh


def test_what_is_not_run_is_still_there() -> None:
    texts = [
        (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "tests/README.md", "vcg_ext/README.md")
    ]
    left_out = [block.text for text in texts for block in blocks(text) if block.left_out]
    assert len(left_out) == len(NOT_RUN)
    programs = {word for text in left_out for word in text.split() if "/" in word and not word.startswith("build/")}
    assert programs
    assert all((ROOT / program).is_file() for program in programs), programs
