# SPDX-License-Identifier: GPL-3.0-or-later
"""Whose copy a found file is."""

from .trace import trace
from .verdict import Answer, Trace

__all__ = ["Answer", "Trace", "trace"]
