# SPDX-License-Identifier: GPL-3.0-or-later
"""TeX to MathML, which browsers show by themselves."""

import html
import re

from latex2mathml.converter import convert

# As pymdownx.arithmatex leaves them: inline as \(...\), displayed as \[...\].
BAR = '<mo stretchy="false">&#x0007C;</mo>'  # of |v|: as an operator it would stand apart
EQUATION = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)


def with_mathml(page: str) -> str:
    """A page's HTML with each equation as MathML."""

    def replacement(found: re.Match[str]) -> str:
        display = found[2] == "["
        tex = html.unescape(found[3]).strip()
        math = convert(tex, display="block" if display else "inline")
        math = math.replace(BAR, BAR.replace("<mo ", '<mo lspace="0" rspace="0" '))
        return f'<div class="equation">{math}</div>' if display else math

    return EQUATION.sub(replacement, page)
