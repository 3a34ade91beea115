# SPDX-License-Identifier: GPL-3.0-or-later
"""What is put before somebody else: a page with the finding, what it is worth, and what would refute it."""

from .page import write_page

__all__ = ["write_page"]
