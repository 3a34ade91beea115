# SPDX-License-Identifier: GPL-3.0-or-later
"""A protocol file: experiments, each a grid of jobs, and the tables and figures that show them.

title, about, meshes, keys, trim
[attacks.NAME]   attack: one of the plugin's, or a channel (channels/); lists of amounts, iterations;
                 unit = "mean norm" for amounts in mean distances from the centre
[[experiments]]  name; lists of methods, bits, strengths or limits (the strongest mark that keeps them), attacks;
                 payload = "id": a message of 32 bits, which the key alone can prove, in place of one bit a carrier;
                 original = true: attacked marks are read with the original, too;
                 nulls: how many keys to look for in the unmarked mesh; align = true: frames under the attacks;
                 meshes, trim where they differ from the protocol's;
                 published.WHOSE.ATTACK: the bit error rates that somebody else had, in the order of its amounts
[[figures]]      name, title, experiment; series: an attack's name, or none for the marks themselves;
                 x, y (or ys), panels, lines: columns of the results; where: values of columns
[[tables]]       name, title, experiment, rows; columns: label, value, scale, digits behind the point or significant
                 ones, over (the label of the column that this one is also given relative to) and values of columns,
                 or each: a column like this for each of the experiment's methods; published: rows of the thesis
"""

import itertools
import tomllib
from collections.abc import Collection, Iterable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from .channels import CHANNELS, code_digest
from .jobs import METHODS, PAYLOADS, Job, digest, mesh_file

Spec = dict[str, Any]

FIELDS = {field.name for field in fields(Job)}
# What each part of the file must have, and what it may have.
PROTOCOL = {"title", "meshes", "keys", "experiments"}, {"about", "trim", "attacks", "figures", "tables"}
ATTACK = {"attack"}, {"amounts", "iterations", "unit"}
MARKS = {"name", "methods", "bits"}, {"strengths", "limits", "attacks", "nulls", "meshes", "trim", "published",
                                     "payload", "original"}  # fmt: skip
ALIGNMENT = {"name", "align", "attacks"}, {"meshes"}
FIGURE = {"name", "title", "experiment", "x"}, {"series", "y", "ys", "panels", "lines", "label", "where"}
TABLE = {"name", "title", "experiment", "rows"}, {"columns", "each", "published", "timed"}
COLUMN_OPTIONS = {"label", "value", "scale", "digits", "significant", "over"}
COLUMN = {"label", "value"}, COLUMN_OPTIONS | FIELDS


class ProtocolError(ValueError):
    """The protocol file says something that has no meaning: which, and what would have."""


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
        """All jobs of the protocol, in an order that follows from the file.

        :raises ProtocolError: where there is no such mesh
        """
        plugin_digest = digest(plugin)
        cases = []
        for experiment in self.experiments:
            for mesh in experiment.get("meshes", self.meshes):
                try:
                    mesh_digest = digest(mesh_file(meshes, mesh))
                except FileNotFoundError as error:
                    raise ProtocolError(str(error)) from error
                inputs = {"mesh": mesh, "mesh_digest": mesh_digest, "plugin_digest": plugin_digest}
                for series, job in self._grid(experiment, inputs):
                    cases.append(Case(experiment["name"], series, job))
        return cases

    def _grid(self, experiment: Spec, inputs: Spec) -> list[tuple[str, Job]]:
        attacks = [(name, attack) for name in experiment.get("attacks", []) for attack in _amounts(self.attacks[name])]
        keys = range(self.keys)
        if experiment.get("align"):
            return [(name, Job(kind="align", key=key, **inputs, **attack)) for key in keys for name, attack in attacks]
        inputs = {
            **inputs,
            "trim": float(experiment.get("trim", self.trim)),
            "payload": experiment.get("payload", "bits"),
        }
        attacks = [(name, {**attack, "original": experiment.get("original", False)}) for name, attack in attacks]
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

    def published(self, experiment: str) -> dict[str, dict[tuple[str, float, int], float]]:
        """Whose detection ratio is known after which attack of an experiment: its name, amount and iterations."""
        spec = next(spec for spec in self.experiments if spec["name"] == experiment)
        return {
            whose: {
                (name, attack["amount"], attack["iterations"]): 1 - error
                for name, errors in rates.items()
                for attack, error in zip(_amounts(self.attacks[name]), errors, strict=True)
            }
            for whose, rates in spec.get("published", {}).items()
        }


def _amounts(spec: Spec) -> list[Spec]:
    """What an attack's jobs have of it, for each amount and number of iterations."""
    grid = itertools.product(spec.get("amounts", [-1]), spec.get("iterations", [-1]))
    code = code_digest() if spec["attack"] in CHANNELS else ""
    fixed = {"attack": spec["attack"], "unit": spec.get("unit", ""), "channel_digest": code}
    return [{**fixed, "amount": float(amount), "iterations": iterations} for amount, iterations in grid]


def read_protocol(path: Path) -> Protocol:
    """Reads a protocol file."""
    try:
        with path.open("rb") as file:
            spec = tomllib.load(file)
        _check(spec)
    except FileNotFoundError:
        raise ProtocolError(f"There is no protocol {path}.") from None
    except (tomllib.TOMLDecodeError, ProtocolError) as error:
        raise ProtocolError(f"{path}: {error}") from error
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
        tables=[_with_columns(table, spec["experiments"]) for table in spec.get("tables", [])],
    )


def _with_columns(table: Spec, experiments: list[Spec]) -> Spec:
    """A table whose columns are written out."""
    if "columns" in table:
        return table
    methods = next(spec["methods"] for spec in experiments if spec["name"] == table["experiment"])
    return {**table, "columns": [{"label": method, "method": method, **table["each"]} for method in methods]}


def _check(spec: Spec) -> None:
    _check_keys("the protocol", spec, PROTOCOL)
    for name, attack in spec.get("attacks", {}).items():
        _check_keys(f"attacks.{name}", attack, ATTACK)
    attacks = spec.get("attacks", {})
    for experiment in spec["experiments"]:
        where = f"experiment {experiment.get('name', '?')!r}"
        _check_keys(where, experiment, ALIGNMENT if experiment.get("align") else MARKS)
        _check_names(where, "attack", experiment.get("attacks", []), attacks)
        _check_names(where, "method", experiment.get("methods", []), METHODS)
        _check_names(where, "payload", [experiment.get("payload", "bits")], PAYLOADS)
        for whose, rates in experiment.get("published", {}).items():
            _check_names(f"{where}, published.{whose}", "attack", rates, attacks)
            for name, errors in rates.items():
                if len(errors) != len(_amounts(attacks[name])):
                    raise ProtocolError(f"{where}, published.{whose}.{name} needs one rate for each of the amounts.")
        if not {"align", "strengths", "limits", "nulls"} & experiment.keys():
            raise ProtocolError(f"{where} has nothing to do: give it strengths, limits or nulls.")
    experiments = [experiment["name"] for experiment in spec["experiments"]]
    for figure in spec.get("figures", []):
        where = f"figure {figure.get('name', '?')!r}"
        _check_keys(where, figure, FIGURE)
        _check_names(where, "experiment", [figure["experiment"]], experiments)
        _check_names(where, "attack", [figure["series"]] if "series" in figure else [], attacks)
        if ("y" in figure) == ("ys" in figure):
            raise ProtocolError(f"{where} needs either y or ys.")
        if "ys" in figure and "label" not in figure:
            raise ProtocolError(f"{where} has several ys, and needs a label for their axis.")
    for table in spec.get("tables", []):
        where = f"table {table.get('name', '?')!r}"
        _check_keys(where, table, TABLE)
        _check_names(where, "experiment", [table["experiment"]], experiments)
        if ("columns" in table) == ("each" in table):
            raise ProtocolError(f"{where} needs either columns or each.")
        for column in table.get("columns", []):
            _check_keys(f"{where}, column {column.get('label', '?')!r}", column, COLUMN)


def _check_keys(where: str, spec: Spec, allowed: tuple[set[str], set[str]]) -> None:
    needed, possible = allowed
    if missing := needed - spec.keys():
        raise ProtocolError(f"{where} lacks {_list(missing)}.")
    if unknown := spec.keys() - needed - possible:
        raise ProtocolError(f"{where} has no {_list(unknown)}; it may have {_list(needed | possible)}.")


def _check_names(where: str, kind: str, names: Iterable[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise ProtocolError(f"{where} names the {kind} {name!r}, and there is {_list(known) or 'none'}.")


def _list(names: Iterable[str]) -> str:
    return ", ".join(sorted(names))
