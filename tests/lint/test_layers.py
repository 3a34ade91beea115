# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes in vcg_ext never look up, and no one but a method's own folder asks which method it is."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "vcg_ext"

# What the files of each folder may include, besides their own folder; from the lowest to the highest.
MAY_INCLUDE: dict[str, set[str]] = {
    "base": set(),
    "key": {"base"},
    "geometry": {"base", "key"},
    "payload": {"base", "key"},
    "carrier": {"base", "key", "geometry", "payload"},
    "placement": {"base", "key", "geometry", "payload", "carrier"},
    "metric": {"base", "key", "geometry"},
    "attack": {"base", "key", "geometry"},
    "method": {"base", "key", "geometry", "payload", "carrier", "placement"},
    "watermark": {"base", "key", "geometry", "payload", "carrier", "placement", "metric", "attack", "method"},
}

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
ONE_METHOD = re.compile(r"\bMethod::\w+")


def sources(*folders: Path) -> Iterator[Path]:
    """All C++ files below these folders."""
    return (path for folder in folders for path in sorted(folder.rglob("*")) if path.suffix in (".h", ".cpp"))


def folder_of(path: Path) -> str:
    """The folder of vcg_ext in which a file lies; empty for vcg_ext itself."""
    parts = path.relative_to(LIBRARY).parts
    return parts[0] if len(parts) > 1 else ""


def included(path: Path) -> Iterator[Path]:
    """The files of vcg_ext that a file includes: named from its own folder, or from the root."""
    for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        found = [where for where in ((path.parent / name).resolve(), ROOT / name) if where.is_file()]
        assert found, f"{path.relative_to(ROOT)} includes {name}, which does not exist"
        if found[0].is_relative_to(LIBRARY):
            yield found[0]


def test_the_order_has_no_circle() -> None:
    seen: set[str] = set()
    for folder, below in MAY_INCLUDE.items():
        assert below <= seen, f"{folder} may include {below - seen}, which stand above it"
        seen.add(folder)


def test_every_file_has_a_folder_of_the_list() -> None:
    strays = [str(path.relative_to(ROOT)) for path in sources(LIBRARY) if folder_of(path) not in MAY_INCLUDE]
    assert not strays, f"Put these into one of {', '.join(MAY_INCLUDE)}, or add their folder to the list"


@pytest.mark.parametrize("folder", MAY_INCLUDE)
def test_no_include_looks_up(folder: str) -> None:
    up = [
        f"{path.relative_to(ROOT)} includes {other.relative_to(ROOT)}"
        for path in sources(LIBRARY / folder)
        for other in included(path)
        if folder_of(other) not in MAY_INCLUDE[folder] | {folder}
    ]
    assert not up, f"{folder}/ may include {', '.join(sorted(MAY_INCLUDE[folder])) or 'nothing'} besides itself"


def test_single_methods_are_named_in_their_folder_only() -> None:
    named = []
    for path in sources(LIBRARY, ROOT / "filter_watermark"):
        text = path.read_text(encoding="utf-8")
        if path.is_relative_to(LIBRARY / "method") or "enum class Method" in text:
            continue
        lines = COMMENT.sub(lambda comment: "\n" * comment.group().count("\n"), text).splitlines()
        named += [
            f"{path.relative_to(ROOT)}:{n}: {m.group()}"
            for n, line in enumerate(lines, 1)
            for m in ONE_METHOD.finditer(line)
        ]
    assert not named, "Let a method's row in method/methods.cpp say what differs, and ask the row"
