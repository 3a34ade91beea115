# SPDX-License-Identifier: GPL-3.0-or-later
"""Every parameter and result, as the plugin and the command themselves describe them."""

import inspect
import re
import tempfile
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import typer
from excerpts import ROOT
from meshmark import host, plugin
from meshmark.command.app import app
from meshmark.errors import Refused

MESH = ROOT / "tests" / "golden" / "l-m-mean.ply"  # any that takes a mark
FILTERS: dict[str, dict[str, host.Value]] = {
    plugin.EMBED: {"message": "id:1", "key": "a key", "method": "L-M"},
    plugin.DETECT: {"key": "a key", "method": "L-M", "bits": 64},
    plugin.DETECT_WITH_ORIGINAL: {"key": "a key", "method": "L-M", "bits": 64, "original": 0},
    plugin.ATTACK: {"attack": "Reorder"},
    plugin.MEASURE: {"reference": 0},
}
TYPES = {
    "RichString": "text", "RichInt": "whole number", "RichFloat": "number", "RichBool": "yes or no",
    "RichMesh": "layer", "RichOpenFile": "file", "RichSaveFile": "file",
}  # fmt: skip


def parameters(name: str) -> str:
    """A table of a filter's parameters: what MeshLab writes of them into a script.

    :param name: in pymeshlab
    """
    script, defaults = _described()[name]
    rows = [
        f"| {one.get('description')} | `{one.get('name')}` | {_kind(one)} "
        f"| {_default(one, defaults[str(one.get('name')).lower()])} | {one.get('tooltip')} |"
        for one in script
    ]
    return "\n".join(["| in the window | name | takes | default | |", "|---|---|---|---|---|", *rows])


def results(header: str, struct: str) -> str:
    """A table of what a report says: the fields of a struct that reach the report, with its comments.

    :raises LookupError: where a field has no comment
    """
    text = (ROOT / "vcg_ext" / header).read_text(encoding="utf-8")
    found = re.search(rf"struct {struct} {{\n(.*?)\n}};", text, re.DOTALL)
    if not found:
        raise LookupError(f"{header} has no struct {struct}.")
    told = set(re.findall(r'"(\w+)"', (ROOT / "filter_watermark" / "report.cpp").read_text(encoding="utf-8")))
    rows, above = [], ""
    for line in found[1].splitlines():
        if comment := re.match(r"    /// (.*)", line):
            above = f"{above} {comment[1]}".strip()
        elif field := re.match(r"    [^=;]* (\w+)(?:\{\}| = [^;]+)?;(?: +///< (.*))?$", line):
            meaning = field[2] or above
            if field[1] in told and not meaning:
                raise LookupError(f"{struct}::{field[1]} has no comment in {header}.")
            if field[1] in told:
                rows.append(f"| `{field[1]}` | {_sentence(meaning)} |")
            above = ""
    return "\n".join(["| result | |", "|---|---|", *rows])


def attacks() -> str:
    """A table of the attacks: what the filter answers where it is asked for too much."""
    choices = next(one for one in _described()[plugin.ATTACK][0] if one.get("name") == "Attack")
    rows = []
    for attack in _choices(choices):
        amount = re.search(r"it is the (.*) and must be (.*), or -1 for (.*)\.", _refusal(attack=attack, amount=1e9))
        often = re.search(r"it must be between 1 and (.*), or -1 for (.*)\.", _refusal(attack=attack, iterations=10**6))
        said = f"{amount[1]} | {amount[3]} | {amount[2]}" if amount else " | | "
        rows.append(f"| {attack} | {said} | {f'{often[2]}, up to {often[1]}' if often else ''} |")
    head = "| attack | `Amount` is the | usual | may be | `Iterations` |"
    return "\n".join([head, "|---|---|---|---|---|", *rows])


def strengths() -> str:
    """A table of the methods' strengths: what the filter answers where it is asked for too much."""
    choices = {str(one.get("name")): _choices(one) for one in _described()[plugin.EMBED][0]}
    rows = []
    for method in choices["Method"]:
        limits = dict.fromkeys(
            re.search(
                r"above (.*) and up to (.*), or be 0 for the default of (.*)\.", _too_strong(method, one)
            ).groups()
            for one in choices["Statistic"]
        )
        above, most, usual = (" or ".join(dict.fromkeys(values)) for values in zip(*limits, strict=True))
        rows.append(f"| {method} | {usual} | above {above}, up to {most} |")
    return "\n".join(["| method | usual | may be |", "|---|---|---|", *rows])


def commands() -> str:
    """What `meshmark` takes, command by command."""
    group = typer.main.get_command(app)
    parts = [inspect.cleandoc(str(group.help)).partition("\n\n")[2]]
    for name, command in sorted(group.commands.items()):
        lines = [f"## meshmark {name}", "", command.help.strip(), "", "| | default | |", "|---|---|---|"]
        for one in command.params:
            option = one.param_type_name == "option"
            label = (
                ", ".join(f"`{text}`" for text in one.opts) if option else f"`{one.metavar or str(one.name).upper()}`"
            )
            lines.append(f"| {label} | {_usual(one.default)} | {getattr(one, 'help', '') or ''} |")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


@cache
def _described() -> dict[str, tuple[list[ElementTree.Element], dict[str, object]]]:
    """Per filter its parameters as they stand in a script, and their defaults."""
    with host.own_meshes() as meshes, tempfile.TemporaryDirectory() as folder:
        for _ in range(2):
            host.read(meshes, MESH)
        for name, values in FILTERS.items():
            host.apply(meshes, name, **values)
        defaults = [meshes.filter_parameter_values(name) for name in FILTERS]
        script = Path(folder) / "script.mlx"
        meshes.save_filter_script(str(script))
        filters = ElementTree.parse(script).getroot()
        return {name: (list(one), values) for name, one, values in zip(FILTERS, filters, defaults, strict=True)}


def _refusal(name: str = plugin.ATTACK, **values: host.Value) -> str:
    """What a filter says against these values; nothing where it has nothing against them."""
    with host.own_meshes() as meshes:
        host.read(meshes, MESH)
        try:
            host.apply(meshes, name, **values)
        except Refused as error:
            return str(error)
        return ""


def _too_strong(method: str, statistic: str) -> str:
    return _refusal(plugin.EMBED, message="id:1", key="a key", method=method, statistic=statistic, strength=1e9)


def _choices(parameter: ElementTree.Element) -> list[str]:
    return [str(parameter.get(f"enum_val{i}")) for i in range(int(parameter.get("enum_cardinality", 0)))]


def _kind(parameter: ElementTree.Element) -> str:
    return ", ".join(_choices(parameter)) or TYPES[str(parameter.get("type"))]


def _default(parameter: ElementTree.Element, value: object) -> str:
    choices = _choices(parameter)
    return _code(choices[int(str(value))] if choices else f"{value:g}" if isinstance(value, float) else value)


def _code(value: object) -> str:
    return "" if value == "" else f"`{value}`"


def _usual(default: object) -> str:
    """A command's default; nothing where leaving the option out says it all."""
    if isinstance(default, list):
        return ", ".join(_usual(one) for one in default)
    return "" if default is None or isinstance(default, bool) else _code(getattr(default, "value", default))


def _sentence(text: str) -> str:
    plain = "_" not in text.partition(" ")[0]
    return text[:1].upper() + text[1:] if plain else f"`{text.partition(' ')[0]}` {text.partition(' ')[2]}"
