# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluates the watermarks: a protocol's meshes x methods x keys x attacks, through pymeshlab and the plugin.

Writes CSV, tables beside the thesis' figures, plots and one report.md. A stopped run goes on where it was.

    build/venv/bin/python meshlab_scripts/evaluate.py smoke
    build/venv/bin/python meshlab_scripts/evaluate.py thesis-ch5 --keys 3
"""

import argparse
from pathlib import Path

from evaluation.jobs import Site
from evaluation.protocol import ProtocolError, read_protocol
from evaluation.report import write_report
from evaluation.results import NoResults
from evaluation.schedule import run_missing
from evaluation.store import Store
from meshmark import plugin

ROOT = Path(__file__).resolve().parents[1]
PROTOCOLS = Path(__file__).resolve().parent / "protocols"


def main() -> None:
    """Runs what is missing and writes the report."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = ", ".join(sorted(path.stem for path in PROTOCOLS.glob("*.toml")))
    parser.add_argument("protocol", help=f"a TOML file, or one of {names}")
    parser.add_argument("--keys", type=int, help="number of keys, each with its own message and attacks' seed")
    parser.add_argument("--meshes", type=Path, default=ROOT / "build/data/meshes", help="folder of the meshes")
    parser.add_argument("--mesh", nargs="+", help="names of meshes, without extension, in place of the protocol's")
    parser.add_argument("--work", type=Path, default=ROOT / "build/evaluation", help="store and marked meshes")
    parser.add_argument("--report", type=Path, help="folder of the report; default: the protocol's name in --work")
    parser.add_argument("--plugin", type=Path, default=ROOT / "build/meshlab-2025.07/libfilter_watermark.so")
    parser.add_argument(
        "--scheduler",
        help="address of a dask scheduler; its workers see the same files, and have PYTHONPATH=meshlab_scripts",
    )
    parser.add_argument("--retry", action="store_true", help="run again what failed")
    parser.add_argument("--report-only", action="store_true", help="run nothing; report what is there")
    arguments = parser.parse_args()

    named = PROTOCOLS / f"{arguments.protocol}.toml"
    try:
        protocol = read_protocol(named if named.exists() else Path(arguments.protocol))
    except ProtocolError as error:
        parser.error(str(error))
    protocol.keys = arguments.keys or protocol.keys
    protocol.meshes = arguments.mesh or protocol.meshes
    site = Site(arguments.meshes.resolve(), arguments.plugin.resolve(), (arguments.work / "marked").resolve())
    plugin.load(site.plugin)
    site.cache.mkdir(parents=True, exist_ok=True)
    store = Store(arguments.work / "results.sqlite")
    if arguments.retry:
        store.forget_failed()
    cases = protocol.cases(site.meshes, site.plugin)
    if not arguments.report_only:
        run_missing([case.job for case in cases], site, store, arguments.scheduler)
    report = arguments.report or arguments.work / protocol.name
    try:
        write_report(protocol, cases, site, store, report)
    except NoResults as error:
        parser.error(str(error))
    finally:
        store.close()
    print(f"{report / 'report.md'}")


if __name__ == "__main__":
    main()
