# SPDX-License-Identifier: GPL-3.0-or-later
"""Probabilities that are bounds, written so that they stay bounds."""

from decimal import ROUND_CEILING, Context
from fractions import Fraction

DIGITS = 2


def rounded_up(p: float) -> str:
    """Such as 3.2e-9: never below p."""
    rounded = Context(prec=DIGITS, rounding=ROUND_CEILING).create_decimal(repr(float(p)))
    return f"{rounded.normalize():g}" if rounded < 1 else "1"


def odds(p: float) -> str:
    """In words, such as 1 in 3 million: never less probable than p."""
    if p > 0.1:
        return rounded_up(p)
    number = int(1 / Fraction(repr(float(p))))
    if number >= 10**12:
        return f"1 in 10^{len(str(number)) - 1}"
    for size, name in ((10**9, "thousand million"), (10**6, "million"), (10**3, "thousand")):
        if number >= size:
            return f"1 in {number // size:,} {name}"
    return f"1 in {number}"
