# SPDX-License-Identifier: GPL-3.0-or-later
"""What mkdocs calls: pages take what is said elsewhere from there, and equations become MathML.

A line {{ kind | argument | ... | option=value, value }} of a page is replaced by what one of DIRECTIVES makes of it.
"""

import re
from collections.abc import Callable
from typing import Any

import excerpts
import reference
from equations import with_mathml
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

DIRECTIVES: dict[str, Callable[..., str]] = {
    "section": excerpts.section,
    "table": excerpts.table,
    "file": excerpts.file,
    "parameters": reference.parameters,
    "results": reference.results,
    "attacks": reference.attacks,
    "strengths": reference.strengths,
    "commands": reference.commands,
}


def assembled(text: str, page: str) -> str:
    """A page's Markdown with its directives replaced. `page` is its path below docs."""

    def replacement(found: re.Match[str]) -> str:
        kind, *words = (word.strip() for word in found[1].split("|"))
        named = [word.partition("=")[::2] for word in words if "=" in word]
        options = {name: value.split(", ") for name, value in named}
        made = DIRECTIVES[kind](*(word for word in words if "=" not in word), **options)
        return excerpts.relinked(made, page)

    return re.sub(r"^\{\{ (.*) \}\}$", replacement, text, flags=re.MULTILINE)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the pictures that stand in READMEs, under their paths in the repository."""
    for picture in excerpts.pictures():
        files.append(File.generated(config, picture, abs_src_path=str(excerpts.ROOT / picture)))
    return files


def on_page_markdown(markdown: str, page: Any, **_: object) -> str:  # noqa: ANN401
    return assembled(markdown, page.file.src_uri)


def on_page_content(html: str, **_: object) -> str:
    return with_mathml(html)
