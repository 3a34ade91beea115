"""A protocol file: experiments, each a grid of jobs, and the tables and figures that show them.

title, about, meshes, keys, trim
[attacks.NAME]   attack, and lists of amounts, iterations; unit = "mean norm" for amounts in mean distances
                 from the centre
[[experiments]]  name; lists of methods, bits, strengths or limits (the strongest mark that keeps them), attacks;
                 nulls: how many keys to look for in the unmarked mesh; align = true: frames under the attacks;
                 meshes, trim where they differ from the protocol's
[[figures]]      name, title, experiment; series: an attack's name, or none for the marks themselves;
                 x, y (or ys), panels, lines: columns of the results; where: values of columns
[[tables]]       name, title, experiment, rows; columns: label, value, scale, digits, over (the label of the column
                 that this one is also given relative to) and values of columns; published: rows of the thesis
"""

import itertools
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .jobs import Job, digest, mesh_file

Spec = dict[str, Any]


@dataclass(frozen=True)
class Case:
    """A job, and what the protocol calls the experiment and the attack that it belongs to."""

    experiment: str
    series: str
    job: Job


@dataclass
class Protocol:
    """A protocol file, read."""

    name: str
    title: str
    about: str
    meshes: list[str]
    keys: int
    trim: float
    attacks: dict[str, Spec]
    experiments: list[Spec]
    figures: list[Spec]
    tables: list[Spec]

    def cases(self, meshes: Path, plugin: Path) -> list[Case]:
        """All jobs of the protocol, in an order that follows from the file."""
        plugin_digest = digest(plugin)
        cases = []
        for experiment in self.experiments:
            for mesh in experiment.get("meshes", self.meshes):
                inputs = {
                    "mesh": mesh,
                    "mesh_digest": digest(mesh_file(meshes, mesh)),
                    "plugin_digest": plugin_digest,
                }
                for series, job in self._grid(experiment, inputs):
                    cases.append(Case(experiment["name"], series, job))
        return cases

    def _grid(self, experiment: Spec, inputs: Spec) -> list[tuple[str, Job]]:
        attacks = [(name, attack) for name in experiment.get("attacks", []) for attack in self._amounts(name)]
        keys = range(self.keys)
        if experiment.get("align"):
            return [(name, Job(kind="align", key=key, **inputs, **attack)) for key in keys for name, attack in attacks]
        inputs = {**inputs, "trim": float(experiment.get("trim", self.trim))}
        strengths = [{"strength": float(strength)} for strength in experiment.get("strengths", [])]
        strengths += [{"limits": tuple(sorted(limits.items()))} for limits in experiment.get("limits", [])]
        jobs = []
        for method, bits, strength in itertools.product(experiment["methods"], experiment["bits"], strengths):
            mark = {**inputs, "method": method, "bits": bits, **strength}
            for key in keys:
                jobs.append(("", Job(kind="embed", key=key, **mark)))
                jobs += [(name, Job(kind="attack", key=key, **mark, **attack)) for name, attack in attacks]
        for method, bits in itertools.product(experiment["methods"], experiment["bits"]):
            mark = {**inputs, "method": method, "bits": bits}
            jobs += [("null", Job(kind="null", key=key, **mark)) for key in range(experiment.get("nulls", 0))]
        return jobs

    def _amounts(self, name: str) -> list[Spec]:
        spec = self.attacks[name]
        grid = itertools.product(spec.get("amounts", [-1]), spec.get("iterations", [-1]))
        fixed = {"attack": spec["attack"], "unit": spec.get("unit", "")}
        return [{**fixed, "amount": float(amount), "iterations": iterations} for amount, iterations in grid]


def read_protocol(path: Path) -> Protocol:
    """Reads a protocol file."""
    with path.open("rb") as file:
        spec = tomllib.load(file)
    return Protocol(
        name=path.stem,
        title=spec["title"],
        about=spec.get("about", ""),
        meshes=spec["meshes"],
        keys=spec["keys"],
        trim=spec.get("trim", -1),
        attacks=spec.get("attacks", {}),
        experiments=spec["experiments"],
        figures=spec.get("figures", []),
        tables=spec.get("tables", []),
    )
