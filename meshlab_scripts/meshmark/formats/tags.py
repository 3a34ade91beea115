# SPDX-License-Identifier: GPL-3.0-or-later
"""Tags in the text of an XML file, and the same tags with other values."""

import re
from functools import cache

from ..errors import FormatError


def tags(pattern: re.Pattern[bytes], text: bytes, count: int) -> list[re.Match[bytes]]:
    """Those of a kind, of which a parser has found so many.

    :raises FormatError: where the text has others, in comments or in another encoding
    """
    found = list(pattern.finditer(text))
    if len(found) != count:
        raise FormatError("The file is written in a way that meshmark does not know. Save it anew, and try again.")
    return found


def with_values(tag: bytes, **values: bytes) -> bytes:
    """A tag with other values of some attributes."""
    for name, value in values.items():
        tag = _attribute(name).sub(rb"\g<1>%b\g<3>" % value, tag, count=1)
    return tag


@cache
def _attribute(name: str) -> re.Pattern[bytes]:
    return re.compile(rb"""(\s%b\s*=\s*(["']))[^"']*(\2)""" % name.encode())
