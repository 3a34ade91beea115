# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run leaves behind: results.csv, times.csv, errors.csv, tables, figures, and report.md with all in order."""

import platform
from importlib.metadata import version
from pathlib import Path

import pandas as pd

from . import curves, figures, tables
from .jobs import Site, digest, mesh_file
from .protocol import Case, Protocol
from .results import collect, split_times
from .store import Store

ROBUSTNESS = {
    "detection_ratio": ("Detection ratio", 2),
    "log10_p": ("log10 p of the message that is known", 1),
    "log10_p_alone": ("log10 p of what the key alone reads", 1),
    "log10_p_original": ("log10 p of the message that is known, with the original", 1),
    "log10_p_alone_original": ("log10 p of what key and original read", 1),
}


def write_report(protocol: Protocol, cases: list[Case], site: Site, store: Store, folder: Path) -> None:
    """Writes into the folder. All but times.csv, the timed tables and so report.md is the same in every run."""
    frame = collect(cases, store)
    for part in ("tables", "figures"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    untimed, times = split_times(frame)
    failed = untimed.loc[untimed["error"] != "", :"error"]
    for name, rows in {"results": untimed, "times": times, "errors": failed}.items():
        rows.to_csv(folder / f"{name}.csv", index=False, float_format="%.6g")

    parts = [f"# {protocol.title}", protocol.about.strip(), _provenance(protocol, cases, site, frame)]
    for spec in protocol.tables:
        text = f"{spec['title']}\n\n{tables.table(spec, frame)}"
        if not spec.get("timed"):
            _write(folder / "tables" / f"{_file(spec['name'])}.md", text)
        parts.append(f"## {spec['name']}\n\n{text}")
    for spec in protocol.figures:
        path = folder / "figures" / f"{_file(spec['name'])}.png"
        if figures.figure(spec, frame, path):
            parts.append(f"## {spec['name']}: {spec['title']}\n\n![{spec['title']}](figures/{path.name})")
    for experiment in dict.fromkeys(experiment["name"] for experiment in protocol.experiments):
        parts += _errors_of_detection(experiment, frame, folder)
        parts += _robustness(protocol, experiment, frame, folder)
    if not failed.empty:
        counts = failed.groupby(["kind", "mesh", "method", "error"]).size()
        lines = [["kind", "mesh", "method", "error", "jobs"], *([*map(str, at), str(n)] for at, n in counts.items())]
        parts.append(f"## Jobs that failed\n\n{tables.grid(lines)}")
    _write(folder / "report.md", "\n\n".join(filter(None, parts)))


def _errors_of_detection(experiment: str, frame: pd.DataFrame, folder: Path) -> list[str]:
    there = frame.loc[(frame["experiment"] == experiment) & (frame["error"] == ""), "kind"]
    if not {"attack", "null"} <= set(there):
        return []
    name = f"errors-{experiment}"
    figures.error_curves(frame, experiment, folder / "figures" / f"{name}.png")
    text = tables.rates(curves.equal_error_rates(frame, experiment))
    _write(folder / "tables" / f"{name}.md", text)
    return [
        f"## False positives and false negatives ({experiment})",
        f"![False positives and false negatives](figures/{name}.png)",
        "Equal error rate of the detection ratio as the score; all amounts of an attack, meshes and keys together:",
        text,
    ]


def _robustness(protocol: Protocol, experiment: str, frame: pd.DataFrame, folder: Path) -> list[str]:
    parts = []
    if text := tables.within_limits(frame, experiment):
        _write(folder / "tables" / f"within-limits-{experiment}.md", text)
        parts += [f"## Marks within the limits ({experiment})", text]
    values = [value for value in ROBUSTNESS if value.startswith("log10")]
    if text := tables.found(frame, experiment, values):
        _write(folder / "tables" / f"found-{experiment}.md", text)
        parts += [
            f"## Found ({experiment})",
            "Per cent of the attacked marks with p < 1e-6, over meshes, keys and amounts: the message known / the key "
            "alone, and the same two with the original where that was tried.",
            text,
        ]
    for value, (title, digits) in ROBUSTNESS.items():
        published = protocol.published(experiment) if value == "detection_ratio" else {}
        if text := tables.robustness(frame, experiment, value, digits, published):
            _write(folder / "tables" / f"robustness-{experiment}-{_file(value)}.md", text)
            parts += [f"## {title} after every attack ({experiment}), mean over the keys", text]
    return parts


def _provenance(protocol: Protocol, cases: list[Case], site: Site, frame: pd.DataFrame) -> str:
    packages = ("pymeshlab", "numpy", "pandas", "matplotlib", "dask")
    failed = int((frame["error"] != "").sum())
    meshes = sorted({case.job.mesh for case in cases})
    lines = [
        f"- {len(frame)} of {len(cases)} jobs were run, {failed} of them failed. Keys: {protocol.keys}.",
        f"- Plugin {digest(site.plugin)}; Python {platform.python_version()}, "
        + ", ".join(f"{package} {version(package)}" for package in packages),
        "- Meshes: " + ", ".join(f"{mesh} ({digest(mesh_file(site.meshes, mesh))})" for mesh in meshes),
        "- ± and bars: standard deviation over the keys. In brackets: the thesis.",
    ]
    return "\n".join(lines)


def _file(name: str) -> str:
    return name.lower().replace(" ", "-").replace("_", "-")


def _write(path: Path, text: str) -> None:
    path.write_text(text + "\n", encoding="utf-8")
