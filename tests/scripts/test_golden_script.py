# SPDX-License-Identifier: GPL-3.0-or-later
"""meshlabserver reads the marks that were made before, and so the format of a mark has not changed."""

import pytest
from doors import MeshLabServer
from golden_marks import check, each_mark

pytestmark = pytest.mark.usefixtures("display")


@each_mark
def test_a_mark_reads_as_it_did(mark: dict) -> None:
    check(MeshLabServer(), mark)
