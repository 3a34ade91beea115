# SPDX-License-Identifier: GPL-3.0-or-later
"""pymeshlab reads the marks that were made before, and so the format of a mark has not changed."""

from doors import PyMeshLab
from golden_marks import check, each_mark


@each_mark
def test_a_mark_reads_as_it_did(mark: dict) -> None:
    check(PyMeshLab(), mark)
