# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose copy a found file is."""

from .trace import Answer, Trace, trace

__all__ = ["Answer", "Trace", "trace"]
