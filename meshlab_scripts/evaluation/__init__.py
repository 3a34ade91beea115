# SPDX-License-Identifier: GPL-3.0-or-later
"""The evaluation behind evaluate.py: a protocol's grid of jobs, run through pymeshlab, stored, drawn and tabled."""
