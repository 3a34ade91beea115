# SPDX-License-Identifier: GPL-3.0-or-later
"""Where values stand in a JSON text, so that single ones can be replaced and the rest stays as it was written."""

import json
import re

_SPACE = re.compile(r"[ \t\r\n]*")
_decode = json.JSONDecoder().raw_decode


def members(text: str, begin: int = 0) -> dict[str | int, tuple[int, int]]:
    """From where to where the values of the object or array that begins here stand, by their name or number."""
    begin = _after_space(text, begin)
    named = text[begin] == "{"
    at = _after_space(text, begin + 1)
    found: dict[str | int, tuple[int, int]] = {}
    while text[at] not in "]}":
        name: str | int = len(found)
        if named:
            name, colon = _decode(text, at)
            at = _after_space(text, _after_space(text, colon) + 1)
        _, end = _decode(text, at)
        found[name] = at, end
        at = _after_space(text, end)
        if text[at] == ",":
            at = _after_space(text, at + 1)
    return found


def _after_space(text: str, at: int) -> int:
    return _SPACE.match(text, at).end()
