# SPDX-License-Identifier: GPL-3.0-or-later
"""What a shape is, whatever its size and place: by which a found file is told to be a copy of a model."""
