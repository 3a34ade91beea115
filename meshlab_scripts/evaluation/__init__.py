"""The evaluation behind evaluate.py: a protocol's grid of jobs, run through pymeshlab, stored, drawn and tabled."""
