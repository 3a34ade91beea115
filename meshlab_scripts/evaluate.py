# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluates the watermarks: a protocol's meshes x methods x keys x attacks, through pymeshlab and the plugin.

Writes CSV, tables beside the thesis' figures, plots and one report.md. A stopped run goes on where it was.

    build/venv/bin/python meshlab_scripts/evaluate.py smoke
    build/venv/bin/python meshlab_scripts/evaluate.py thesis-ch5 --keys 3
    build/venv/bin/python meshlab_scripts/evaluate.py all      # every protocol, and the programs of programs.toml
"""

from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer
from evaluation.jobs import Site
from evaluation.programs import read_programs, run_programs, write_summary
from evaluation.protocol import ProtocolError, read_protocol
from evaluation.report import write_report
from evaluation.results import NoResults
from evaluation.schedule import run_missing
from evaluation.store import Store
from meshmark import plugin as loaded
from meshmark.alone import alone
from meshmark.errors import MeshmarkError

ROOT = Path(__file__).resolve().parents[1]
PROTOCOLS = Path(__file__).resolve().parent / "protocols"
NAMES = sorted(path.stem for path in PROTOCOLS.glob("*.toml"))


@dataclass(frozen=True)
class Run:
    """What is the same for every protocol of a run."""

    site: Site
    store: Store
    work: Path
    keys: int | None
    meshes: list[str] | None
    scheduler: str | None
    report_only: bool

    def protocol(self, name: str, report: Path | None = None) -> Path:
        """Runs what is missing of a protocol, and writes its report.

        :raises ProtocolError: where there is no such protocol, or it says what has no meaning
        :raises NoResults: where there is nothing to report
        """
        named = PROTOCOLS / f"{name}.toml"
        protocol = read_protocol(named if named.exists() else Path(name))
        protocol.keys = self.keys or protocol.keys
        protocol.meshes = self.meshes or protocol.meshes
        cases = protocol.cases(self.site.meshes, self.site.plugin)
        if not self.report_only:
            run_missing([case.job for case in cases], self.site, self.store, self.scheduler, protocol.name)
        folder = report or self.work / protocol.name
        write_report(protocol, cases, self.site, self.store, folder)
        return folder / "report.md"

    def everything(self, only: list[str] | None, report: Path | None = None) -> Path:
        """Every protocol, then every program; what cannot be had is named in the page, and the rest goes on."""
        folder = report or self.work
        chosen = [name for name in NAMES if not only or name in only]
        said = {}
        for name in chosen:
            try:
                page = self.protocol(name, folder / name)
                said[name] = f"[report]({page.relative_to(folder)})"
            except (NoResults, ProtocolError) as error:
                said[name] = str(error)
        programs = [program for program in read_programs() if not only or program.name in only]
        outcomes = run_programs(programs, self.site.plugin, folder / "programs", look_only=self.report_only)
        return write_summary(said, outcomes, folder)


def main(
    protocol: Annotated[str, typer.Argument(help=f"a TOML file, one of {', '.join(NAMES)}, or all")],
    keys: Annotated[int | None, typer.Option(help="number of keys, each with its own message and seed")] = None,
    meshes: Annotated[Path, typer.Option(help="folder of the meshes")] = ROOT / "build/data/meshes",
    mesh: Annotated[list[str] | None, typer.Option(help="of these meshes alone, without extension")] = None,
    work: Annotated[Path, typer.Option(help="store and marked meshes")] = ROOT / "build/evaluation",
    report: Annotated[
        Path | None, typer.Option(help="folder of the report; else the protocol's name in --work")
    ] = None,
    plugin: Annotated[Path, typer.Option()] = ROOT / "build/meshlab-2025.07/libfilter_watermark.so",
    scheduler: Annotated[
        str | None,
        typer.Option(help="a dask scheduler; its workers see the same files, and have PYTHONPATH=meshlab_scripts"),
    ] = None,
    only: Annotated[list[str] | None, typer.Option(help="of all, these protocols and programs")] = None,
    retry: Annotated[bool, typer.Option("--retry", help="run again what failed")] = False,
    report_only: Annotated[bool, typer.Option("--report-only", help="run no job; report what is there")] = False,
) -> None:
    """Runs what is missing of a protocol, or of all, and writes the report."""
    unknown = set(only or []) - {*NAMES, *(program.name for program in read_programs())}
    if unknown:
        raise typer.BadParameter(f"there is no {', '.join(sorted(unknown))} among the protocols and programs.")
    site = Site(meshes.resolve(), plugin.resolve(), (work / "marked").resolve())
    try:
        loaded.load(site.plugin)
        site.cache.mkdir(parents=True, exist_ok=True)
        with (
            alone(work / ".lock", f"in '{work}'"),  # two would make the same marks, and one of them for nothing
            closing(Store(work / "results.sqlite")) as store,
        ):
            if retry:
                store.forget_failed()
            run = Run(site, store, work, keys, mesh, scheduler, report_only)
            print(run.everything(only, report) if protocol == "all" else run.protocol(protocol, report))
    except (MeshmarkError, ProtocolError, NoResults) as error:
        typer.echo(f"evaluate.py: {error}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
