# SPDX-License-Identifier: GPL-3.0-or-later
"""How well somebody without the key tells marked meshes of a family from unmarked ones, by method.

Two ways: the published test whether the means of shells of vertex norms lie on two sides, over all numbers of shells
and trims; and a linear classifier of local features, trained on other meshes of the family, marked and unmarked.

    build/venv/bin/python tests/benchmark/adversary/steganalysis.py
"""

import argparse

import numpy as np
from meshmark.errors import Refused
from shapes import METHODS, Array, Shape, deformed, embed, likeliest_shells, opened

FOLDS = 10
RIDGE = 1e-2


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mesh", default="homer", help="that the family is made of")
    parser.add_argument("--number", type=int, default=60, help="of marked meshes, and of unmarked ones")
    parser.add_argument("--methods", nargs="+", default=METHODS)
    options = parser.parse_args()

    base = opened(options.mesh)
    unmarked = [deformed(base, i) for i in range(options.number)]
    plain_features, plain_combs = np.array([features(one) for one in unmarked]), combs(unmarked)
    print(f"{options.mesh}, {options.number} unmarked; AUC .5 is chance; found: of the marked at 5 % false alarms")
    print("| method | marked | two sides: AUC | found | classifier: AUC | found |\n|---|---|---|---|---|---|")
    for method in options.methods:
        marked = []
        for i in range(options.number):
            try:
                marked.append(embed(deformed(base, options.number + i), method, f"key {i}", f"id:{i}"))
            except Refused:
                continue
        if not marked:
            print(f"| {method} | 0 | | | | |")
            continue
        scores = classified(plain_features, np.array([features(one) for one in marked]))
        said = [f"{area_under_curve(*one):.2f} | {found(*one):.0%}" for one in ((plain_combs, combs(marked)), scores)]
        print(f"| {method} | {len(marked)} | " + " | ".join(said) + " |", flush=True)


def combs(shapes: list[Shape]) -> Array:
    return np.array([likeliest_shells(one)[0] for one in shapes])


def features(shape: Shape) -> Array:
    """Moments of what a local predictor leaves: how far each vertex lies from the mean of its neighbours, along the
    normal and across, and likewise of that field itself; angles between neighbouring faces; lengths of edges.
    """
    edges = np.unique(np.sort(shape.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    normals = shape.normals
    field, kept = shape.points / shape.diagonal, []
    for _ in range(3):
        field = _laplacian(field, edges)
        outward = (field * normals).sum(axis=1)
        kept += [outward, np.linalg.norm(field - outward[:, None] * normals, axis=1)]
    face = shape.face_normals
    face /= np.maximum(np.linalg.norm(face, axis=1), 1e-30)[:, None]
    kept.append(np.arccos(np.clip((face[:, None] * normals[shape.faces]).sum(axis=2), -1, 1)).ravel())
    kept.append(np.linalg.norm(shape.points[edges[:, 0]] - shape.points[edges[:, 1]], axis=1) / shape.diagonal)
    return np.concatenate([_moments(np.log(np.abs(one) + 1e-9)) for one in kept])


def classified(plain: Array, marked: Array) -> tuple[Array, Array]:
    """Scores of both by a linear discriminant that was trained on the other folds."""
    values = np.vstack([plain, marked])
    truth = np.repeat([0.0, 1.0], [len(plain), len(marked)])
    fold = np.concatenate([np.arange(len(plain)), np.arange(len(marked))]) % FOLDS
    scores = np.empty(len(values))
    for i in range(FOLDS):
        train = values[fold != i], truth[fold != i]
        middle, spread = train[0].mean(axis=0), train[0].std(axis=0) + 1e-12
        scaled = (train[0] - middle) / spread
        means = [scaled[train[1] == side].mean(axis=0) for side in (0, 1)]
        within = np.cov(scaled - np.where(train[1][:, None] == 1, means[1], means[0]), rowvar=False)
        direction = np.linalg.solve(within + RIDGE * np.eye(len(within)), means[1] - means[0])
        scores[fold == i] = ((values[fold == i] - middle) / spread - (means[0] + means[1]) / 2) @ direction
    return scores[truth == 0], scores[truth == 1]


def area_under_curve(plain: Array, marked: Array) -> float:
    """How often a marked mesh scores higher than an unmarked one."""
    return float((marked[:, None] > plain).mean() + (marked[:, None] == plain).mean() / 2)


def found(plain: Array, marked: Array) -> float:
    """Part of the marked above all but a twentieth of the unmarked."""
    return float((marked > np.quantile(plain, 0.95)).mean())


def _laplacian(field: Array, edges: np.ndarray) -> Array:
    sums, degrees = np.zeros_like(field), np.bincount(edges.ravel(), minlength=len(field))
    for a, b in ((0, 1), (1, 0)):
        np.add.at(sums, edges[:, a], field[edges[:, b]])
    return sums / np.maximum(degrees, 1)[:, None] - field


def _moments(values: Array) -> Array:
    middle, spread = values.mean(), values.std() + 1e-12
    scaled = (values - middle) / spread
    return np.array([middle, spread, (scaled**3).mean(), (scaled**4).mean()])


if __name__ == "__main__":
    main()
