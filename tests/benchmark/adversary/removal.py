# SPDX-License-Identifier: GPL-3.0-or-later
"""What it takes to remove a mark without the key, knowing the program: how far the surface must be moved till p > 1e-6.

Each way is tried in steps that double; the cell is the MRMS over the diagonal, against the marked mesh, of the first at
which the mark is lost: the median of some keys, or how many of them outlive the strongest step. What random noise needs
stands beside.

    build/venv/bin/python tests/benchmark/adversary/removal.py --mesh homer
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from statistics import median

import numpy as np
from meshmark.errors import Refused
from shapes import METHODS, Shape, attacked, centre, embed, likeliest_shells, log_p, mrms, opened, with_means

FOUND = -6
NORMS = ("Cho", "QSP", "L-M")
USUAL = {"Waves": 1e-4, "Layered": 1e-4, "Spectral": 15}  # strength; 0.1 for the others
Way = Callable[[Shape, str], Iterator[Shape]]


@dataclass
class Trial:
    """One mark under one way of removing it."""

    most: float  # MRMS of the last step that was tried
    lost: bool
    refusal: str = ""


def main() -> None:
    """Prints a row a method."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", default="homer")
    parser.add_argument("--methods", nargs="+", default=METHODS)
    parser.add_argument("--keys", type=int, default=3)
    parser.add_argument("--ways", nargs="+", default=list(WAYS), choices=WAYS)
    options = parser.parse_args()
    cover = opened(options.mesh)
    print(f"| {options.mesh} | the mark itself | " + " | ".join(options.ways) + " |")
    print("|---" * (len(options.ways) + 2) + "|")
    for method in options.methods:
        marks = {key: embed(cover, method, key) for key in (f"owner {i}" for i in range(options.keys))}
        cells = [cell([tried(WAYS[way], marked, method, key) for key, marked in marks.items()]) for way in options.ways]
        own = median(mrms(marked, cover) for marked in marks.values())
        print(f"| {method} | {own:.1e} | " + " | ".join(cells) + " |", flush=True)


def cell(trials: list[Trial]) -> str:
    """What it took, or how far it was tried in vain."""
    kept = [trial for trial in trials if not trial.lost]
    if not kept:
        return f"{median(trial.most for trial in trials):.1e}"
    if not any(trial.most for trial in trials):
        return ""
    refused = f" (refused: {kept[0].refusal})" if kept[0].refusal else ""
    return f"{len(kept)} of {len(trials)} outlive {median(trial.most for trial in kept):.1e}{refused}"


def tried(way: Way, marked: Shape, method: str, key: str) -> Trial:
    """Steps until the mark is lost."""
    trial = Trial(0, lost=False)
    try:
        for changed in way(marked, method):
            trial = Trial(mrms(changed, marked), log_p(changed, method, key) > FOUND)
            if trial.lost:
                break
    except Refused as error:
        trial.refusal = str(error).partition(".")[0]
    return trial


def noise(marked: Shape, _: str) -> Iterator[Shape]:
    return (attacked(marked, "Noise", amount) for amount in 0.0005 * 2.0 ** np.arange(7))


def smoothing(marked: Shape, _: str) -> Iterator[Shape]:
    """A low-pass of the positions."""
    return (attacked(marked, "Smooth", 0.5, iterations) for iterations in (1, 2, 5, 10, 20, 40))


def waves(marked: Shape, _: str) -> Iterator[Shape]:
    """Random smooth waves, as long as those that carry bits: of 10 to 20 radians over the radius of the ball of equal
    volume, taken as a quarter of the diagonal.
    """
    draws = np.random.default_rng(1)
    canonical = (marked.points - centre(marked)) / (marked.diagonal / 4)
    field = np.zeros(len(canonical))
    for _ in range(64):
        direction = draws.normal(size=3)
        wave = direction / np.linalg.norm(direction) * draws.uniform(10**3, 20**3) ** (1 / 3)
        field += draws.normal() * np.cos(canonical @ wave + draws.uniform(0, 2 * np.pi))
    moves = field[:, None] * marked.normals * marked.diagonal / np.sqrt(np.mean(field**2))
    return (marked.at(marked.points + amount * moves) for amount in 5e-5 * 2.0 ** np.arange(7))


def other_key(marked: Shape, method: str) -> Iterator[Shape]:
    """A mark of the same method under a key of the adversary's, ever stronger."""
    usual = USUAL.get(method, 0.1)
    return (embed(marked, method, "the adversary's", "id:1", usual * part) for part in (1, 2, 4))


def levelling(marked: Shape, method: str) -> Iterator[Shape]:
    """Finds the shells by the test for two sides, and pushes their means to where those of an unmarked mesh lie, one
    standard error about the middle. (At the middle itself, what is left of the signs would still tell all bits.)
    Vertices slide along the surface as far as they can, as they do in L-M.
    """
    if method not in NORMS:
        return
    _, shells = likeliest_shells(marked)
    draws = np.random.default_rng(1)
    samples = np.bincount(shells.number[shells.number >= 0], minlength=shells.count)
    means = 0.5 + draws.normal(size=shells.count) / np.sqrt(12 * np.maximum(samples, 1))
    for part in (0.5, 0.75, 1, 1.5):
        yield with_means(marked, shells, means, part)


WAYS: dict[str, Way] = {
    "noise": noise,
    "waves": waves,
    "smoothing": smoothing,
    "levelling": levelling,
    "another key": other_key,
}

if __name__ == "__main__":
    main()
