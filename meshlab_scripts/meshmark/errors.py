# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, each with its cause and its cure in the text."""


class MeshmarkError(Exception):
    """Anything that meshmark refuses or cannot do."""


class Refused(MeshmarkError):
    """A filter refused: the mesh does not carry the message, a value is out of its range, and so on."""


class Failed(MeshmarkError):
    """A filter failed by itself, for want of memory or by a fault of ours: that says nothing of the mesh."""


class FormatError(MeshmarkError):
    """A file that cannot be read or written with all that is in it."""


class MovesTooMuch(MeshmarkError):
    """The mark would move a vertex further than was allowed. Nothing was written."""


class NotReadBack(MeshmarkError):
    """The written file does not carry the mark, so it was taken away again."""
