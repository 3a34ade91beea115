# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole jobs through pymeshlab, beside what MeshLab itself takes in the same run: Markdown for vcg_ext/README.md.

L is MeshLab's load of the same binary PLY, H its Hausdorff filter both ways at equal samples. bunny00 is subdivided by
Loop's scheme: 0, 2 and 3 times are 37,706, 603,266 and 2,413,058 vertices. Each job is a process of its own, so that
its memory is its own; figures are medians.

build/venv/bin/python tests/benchmark/speed.py --subdivisions 2 --methods L-M --methods Waves
"""

import hashlib
import json
import multiprocessing
import os
import resource
import subprocess
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Annotated, Any

import typer

ROOT = Path(__file__).resolve().parents[2]
METHODS = ["L-M", "QSP", "Cho", "Waves", "Geodesic", "Spectral", "Layered"]


@dataclass
class Marking:
    """What one process took to load a mesh, mark it and read it."""

    load: float  # seconds, as all
    embed: float
    detect: float
    memory: int  # most bytes beyond those that the process had with the mesh loaded
    positions: str  # a digest of the marked ones


def main(
    subdivisions: Annotated[list[int], typer.Option(help="Rounds of Loop's scheme; may be given often")] = [0, 2],  # noqa: B006
    methods: Annotated[list[str], typer.Option(help="May be given often")] = METHODS,
    runs: Annotated[int, typer.Option(help="Of each, for the median")] = 3,
    cores: Annotated[bool, typer.Option(help="Once more on one core")] = False,
    distortion: Annotated[bool, typer.Option(help="Measure Distortion beside H")] = False,
    march: Annotated[bool, typer.Option(help="Fast marching beside potpourri3d")] = False,
    mesh: Annotated[Path, typer.Option()] = ROOT / "build/data/meshes/bunny00.off",
    plugin: Annotated[Path, typer.Option()] = ROOT / "build/meshlab-2025.07/libfilter_watermark.so",
) -> None:
    with tempfile.TemporaryDirectory(prefix="speed-") as name:
        paths = {rounds: Path(name) / f"{rounds}.ply" for rounds in sorted(subdivisions)}
        sizes = {rounds: _alone(_subdivide, mesh, rounds, path) for rounds, path in paths.items()}
        _print_methods(paths, sizes, lambda path, method: _runs(runs, _mark, path, plugin, method, None), methods)
        if cores:
            for rounds, path in paths.items():
                _print_cores(path, sizes[rounds], plugin, methods, runs)
        if distortion:
            for rounds, path in paths.items():
                ours, theirs = zip(*_runs(runs, _measure, path, plugin), strict=True)
                print(f"\nMeasure Distortion at {sizes[rounds]:,} vertices and as many samples: "
                      f"{median(ours) / median(theirs):.2f} H (H {median(theirs):.2f} s)")  # fmt: skip
        if march:
            for rounds, path in paths.items():
                print(f"\nFast marching from a vertex, {sizes[rounds]:,} vertices: {_marching(path, rounds, runs)}")


def _alone(job: Callable[..., Any], *arguments: object) -> Any:  # noqa: ANN401
    """What the job returns, run in a new process."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(job, *arguments).result()


def _runs(count: int, job: Callable[..., Any], *arguments: object) -> list[Any]:
    return [_alone(job, *arguments) for _ in range(count)]


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _subdivide(mesh: Path, rounds: int, path: Path) -> int:
    """Saves the mesh; its number of vertices."""
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    if rounds:
        meshes.meshing_surface_subdivision_loop(iterations=rounds, threshold=pymeshlab.PercentageValue(0))
    meshes.save_current_mesh(str(path))
    return meshes.current_mesh().vertex_number()


def _mark(path: Path, plugin: Path, method: str, cores: int | None) -> Marking:
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])
    import pymeshlab

    pymeshlab.load_plugin(str(plugin))
    meshes = pymeshlab.MeshSet()
    load = _seconds(lambda: meshes.load_new_mesh(str(path)))
    loaded = int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()
    options = {"method": method, "key": "speed"}
    embed = _seconds(lambda: meshes.apply_filter("apply_coord_watermark", message="museum", **options))
    detect = _seconds(lambda: meshes.apply_filter("get_watermark", expected="museum", **options))
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    digest = hashlib.sha256(meshes.current_mesh().vertex_matrix().tobytes()).hexdigest()
    return Marking(load, embed, detect, most - loaded, digest)


def _measure(path: Path, plugin: Path) -> tuple[float, float]:
    """Seconds of Measure Distortion, and H."""
    import pymeshlab

    pymeshlab.load_plugin(str(plugin))
    meshes = pymeshlab.MeshSet()
    for _ in range(2):
        meshes.load_new_mesh(str(path))
    meshes.apply_coord_random_displacement(displacement=pymeshlab.PercentageValue(0.01))
    samples = meshes.current_mesh().vertex_number()
    ours = _seconds(lambda: meshes.apply_filter("get_watermark_distortion", reference=0, samples=samples))
    theirs = [
        _seconds(
            lambda one=one, other=other: meshes.get_hausdorff_distance(
                sampledmesh=one, targetmesh=other, samplevert=False, sampleface=True, samplenum=samples
            )
        )
        for one, other in ((0, 1), (1, 0))
    ]
    return ours, sum(theirs)


def _print_methods(
    paths: dict[int, Path],
    sizes: dict[int, int],
    mark: Callable[[Path, str], list[Marking]],
    methods: list[str],
) -> None:
    """A row a method: embedding and detection over L at each size, growth between the last two, memory at the last."""
    results = {method: [mark(path, method) for path in paths.values()] for method in methods}
    loads = [median(run.load for runs in column for run in runs) for column in zip(*results.values(), strict=True)]
    heads = [f"{sizes[rounds]:,} vertices (L {load:.2f} s)" for rounds, load in zip(paths, loads, strict=True)]
    print(f"| embed, detect | {' | '.join(heads)} | growth | bytes a vertex |")
    print("|---" * (len(heads) + 3) + "|")
    for method, columns in results.items():
        embed = [median(run.embed for run in runs) for runs in columns]
        detect = [median(run.detect for run in runs) for runs in columns]
        cells = [f"{e / load:.1f} L, {d / load:.1f} L" for e, d, load in zip(embed, detect, loads, strict=True)]
        growth = f"{embed[-1] / embed[-2]:.1f}, {detect[-1] / detect[-2]:.1f}" if len(embed) > 1 else ""
        memory = median(run.memory for run in columns[-1]) / list(sizes.values())[-1]
        print(f"| {method} | {' | '.join(cells)} | {growth} | {memory:.0f} |")


def _print_cores(path: Path, size: int, plugin: Path, methods: list[str], runs: int) -> None:
    """How much faster all cores are than one, and whether they put all vertices at the same places."""
    print(f"\n| {size:,} vertices, all cores over one | embed | detect | same positions |\n|---|---|---|---|")
    for method in methods:
        pairs = [[_alone(_mark, path, plugin, method, cores) for cores in (1, None)] for _ in range(runs)]
        one, many = zip(*pairs, strict=True)
        embed = median(run.embed for run in one) / median(run.embed for run in many)
        detect = median(run.detect for run in one) / median(run.detect for run in many)
        same = len({run.positions for run in one + many}) == 1
        print(f"| {method} | {embed:.2f} | {detect:.2f} | {'yes' if same else 'NO'} |")


def _marching(path: Path, rounds: int, runs: int) -> str:
    program = ROOT / "build/tests/hot_pieces"
    if not program.exists():
        return f"not measured, since {program.relative_to(ROOT)} is not built (Google Benchmark is missing)."
    command = [program, f"--benchmark_filter=^march/{rounds}(/|$)", f"--benchmark_repetitions={runs}",
               "--benchmark_format=json"]  # fmt: skip
    found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["benchmarks"]
    ours = [run["real_time"] / 1e3 for run in found if run["run_type"] == "iteration"]
    if not ours:
        return f"not measured, since hot_pieces subdivides no {rounds} times."
    try:
        theirs = _runs(runs, _potpourri, path)
    except ModuleNotFoundError:
        return f"{median(ours):.2f} s; potpourri3d is not installed."
    return f"{median(ours):.2f} s, potpourri3d {median(theirs):.2f} s."


def _potpourri(path: Path) -> float:
    import potpourri3d
    import pymeshlab

    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    solver = potpourri3d.MeshFastMarchingDistanceSolver(mesh.vertex_matrix(), mesh.face_matrix())
    return _seconds(lambda: solver.compute_distance([[(0, [])]]))


if __name__ == "__main__":
    typer.run(main)
