# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections, tables and files of the repository as parts of pages, so that each thing is said once."""

import posixpath
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = Path(__file__).resolve().parent / "docs"
# READMEs, and the page that their links lead to.
READMES = {
    "README.md": "index.md",
    "meshlab_scripts/README.md": "security.md",
    "meshlab_scripts/results/README.md": "evaluation.md",
    "tests/README.md": "extend.md",
    "vcg_ext/README.md": "methods/index.md",
}
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
HEADING = re.compile(r"(#+) (.*)")


def section(source: str, heading: str, part: Iterable[str] = ()) -> str:
    """What stands under a heading of a file; `part` "own" leaves its subsections out.

    :raises LookupError: where there is no such heading
    """
    level, lines = 0, []
    for line, is_heading in _lines(source):
        depth, title = HEADING.fullmatch(line).groups() if is_heading else ("", "")
        if level and is_heading and (len(depth) <= level or "own" in part):
            break
        if level:
            lines.append(line)
        elif title == heading:
            level = len(depth)
    if not level:
        raise LookupError(f"{source} has no section '{heading}'.")
    text = re.sub(r"\n(?=\*\*[A-Z])", "\n\n", "\n".join(lines).strip())  # a bold lead begins a paragraph
    return _from_root(text, source)


def table(
    source: str,
    heading: str,
    head: Iterable[str] = (),
    number: Iterable[str] = ("1",),
    rows: Iterable[str] = (),
    columns: Iterable[str] = (),
) -> str:
    """A table of a section: of those with a head that begins with the words of `head` the one of this number. Of its
    rows those with a cell, of its columns those with a head, that begins with one of the given words. The first column
    stays always.

    :raises LookupError: where there is no such table, or nothing is left of it
    """
    found = [_cells(one) for one in re.findall(r"(?:^\|.*\n?)+", section(source, heading), re.MULTILINE)]
    found = [one for one in found if all(any(cell.startswith(word) for cell in one[0]) for word in head)]
    if len(found) < int(*number):
        raise LookupError(f"Section '{heading}' of {source} has no such table.")
    names, line, *body = found[int(*number) - 1]
    starts, heads = tuple(rows), tuple(columns)
    body = [row for row in body if not starts or any(cell.startswith(starts) for cell in row)]
    kept = [i for i, cell in enumerate(names) if i == 0 or not heads or cell.startswith(heads)]
    if not body or (len(kept) == 1 and heads):
        raise LookupError(f"Nothing is left of a table of '{heading}' in {source}.")
    return "\n".join("| " + " | ".join(row[i] for i in kept) + " |" for row in (names, line, *body))


def file(path: str, language: str) -> str:
    """A file as a block of code, without its licence line."""
    text = (ROOT / path).read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if "SPDX-License-Identifier" not in line]
    return f"```{language}\n" + "\n".join(lines) + "\n```"


def pictures() -> list[str]:
    """The pictures of all READMEs, as paths in the repository."""
    texts = (_from_root((ROOT / source).read_text(encoding="utf-8"), source) for source in READMES)
    return sorted({link for text in texts for mark, _, link in LINK.findall(text) if mark})


def relinked(text: str, page: str) -> str:
    """Links from the repository's root as links of a page: to pictures, and to the pages that show READMEs, which are
    called by their titles. What is no part of the site is named, not linked.
    """

    def replacement(found: re.Match[str]) -> str:
        mark, words, link = found.groups()
        target = link if mark else READMES.get(link)
        if not target:
            return words if words != link else f"`{words}`"
        if words == link:
            words = (DOCS / target).read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ")
        return f"{mark}[{words}]({posixpath.relpath(target, posixpath.dirname(page) or '.')})"

    return _outside_code(LINK, replacement, text)


def _cells(table: str) -> list[list[str]]:
    return [[cell.strip() for cell in row.removeprefix("|").removesuffix("|").split("|")] for row in table.splitlines()]


def _lines(source: str) -> Iterator[tuple[str, bool]]:
    """Lines of a file, and whether each is a heading."""
    fenced = False
    for line in (ROOT / source).read_text(encoding="utf-8").splitlines():
        fenced ^= line.startswith("```")
        yield line, not fenced and HEADING.fullmatch(line) is not None


def _from_root(text: str, source: str) -> str:
    """A file's text with its links as paths from the root."""
    folder = posixpath.dirname(source)

    def replacement(found: re.Match[str]) -> str:
        mark, words, link = found.groups()
        path = link if ":" in link else posixpath.normpath(posixpath.join(folder, link))
        return f"{mark}[{words}]({path})"

    return _outside_code(LINK, replacement, text)


def _outside_code(pattern: re.Pattern[str], replacement: object, text: str) -> str:
    """`re.sub`, but not within fences and code spans."""
    parts = re.split(r"(^```.*?^```$|`[^`\n]+`)", text, flags=re.DOTALL | re.MULTILINE)
    return "".join(part if i % 2 else pattern.sub(replacement, part) for i, part in enumerate(parts))
