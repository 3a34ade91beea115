# SPDX-License-Identifier: GPL-3.0-or-later
"""Watermark: Measure Distortion beside the Hausdorff Distance filter that both MeshLabs come with.

Metro's MRMS is the larger of its RMS in both directions, over points spread over the faces. Both draw as many points,
but others, so they agree up to the draw. Vertices are a separate pass in MeshLab; they count for the maximum only.
"""

import json
import re
from pathlib import Path

import pymeshlab
import pytest
from doors import MESHES, MeshLabServer, PyMeshLab

DIRECTIONS = [(0, 1), (1, 0)]
# Copy -> filter, its values, and points per direction: a mark's distances are uneven, so it takes more of them.
COPIES: dict[str, tuple[str, dict[str, object], int]] = {
    "noisy": ("apply_watermark_attack", {"attack": "Noise", "amount": 0.001, "seed": 1}, 400_000),
    "smoothed": ("apply_watermark_attack", {"attack": "Smooth", "iterations": 5}, 400_000),
    "simplified": ("apply_watermark_attack", {"attack": "Simplify"}, 400_000),
    "marked": (
        "apply_coord_watermark",
        {"message": "(c) 2026", "key": "metro", "method": "L-M", "bits": 64},
        1_500_000,
    ),
}

pytestmark = pytest.mark.usefixtures("display")


@pytest.fixture(scope="module", params=COPIES)
def pair(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, int]:
    """bunny00 and a copy of it, a thousand times as large: meshlabserver logs six decimals."""
    PyMeshLab()
    name, values, samples = COPIES[request.param]
    paths = []
    for copy in (False, True):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(MESHES / "bunny00.off"))
        if copy:
            meshes.apply_filter(name, **values)
        meshes.compute_matrix_from_translation_rotation_scale(scalex=1000, scaley=1000, scalez=1000)
        paths.append(tmp_path_factory.mktemp("metro") / f"{request.param if copy else 'original'}.ply")
        meshes.save_current_mesh(str(paths[-1]))
    return paths[0], paths[1], samples


def compare(ours: dict[str, float], theirs: dict[str, list[float]]) -> None:
    assert ours["mrms"] == pytest.approx(max(theirs["rms"]), rel=0.01)
    assert ours["mean"] == pytest.approx(max(theirs["mean"]), rel=0.01)
    assert ours["hausdorff"] == pytest.approx(max(theirs["max"]), rel=0.05)


def test_beside_pymeshlab(pair: tuple[Path, Path, int], tmp_path: Path) -> None:
    *paths, samples = pair
    meshes = pymeshlab.MeshSet()
    for path in paths:
        meshes.load_new_mesh(str(path))
    report = tmp_path / "report.json"
    meshes.apply_filter("get_watermark_distortion", reference=0, samples=samples, report=str(report))
    theirs: dict[str, list[float]] = {"rms": [], "mean": [], "max": []}
    for source, target in DIRECTIONS:
        for vertices in (False, True):
            found = meshes.get_hausdorff_distance(
                sampledmesh=source,
                targetmesh=target,
                samplevert=vertices,
                sampleface=not vertices,
                samplenum=samples,
                maxdist=pymeshlab.PercentageValue(100),
            )
            theirs["max"].append(found["max"])
            if not vertices:
                theirs["rms"].append(found["RMS"])
                theirs["mean"].append(found["mean"])
    compare(json.loads(report.read_text(encoding="utf-8")), theirs)


def hausdorff_filter(source: int, target: int, vertices: bool, samples: int) -> str:
    values = [
        ("SampledMesh", "RichMesh", source),
        ("TargetMesh", "RichMesh", target),
        ("SaveSample", "RichBool", "false"),
        ("SampleVert", "RichBool", str(vertices).lower()),
        ("SampleEdge", "RichBool", "false"),
        ("SampleFauxEdge", "RichBool", "false"),
        ("SampleFace", "RichBool", str(not vertices).lower()),
        ("SampleNum", "RichInt", samples),
    ]
    lines = [f'<Param name="{name}" type="{kind}" value="{value}"/>' for name, kind, value in values]
    lines.append('<Param name="MaxDist" type="RichAbsPerc" value="1000" min="0" max="10000"/>')
    return f'<filter name="Hausdorff Distance">{"".join(lines)}</filter>'


def test_beside_meshlabserver(pair: tuple[Path, Path, int], tmp_path: Path) -> None:
    *paths, samples = pair
    report = tmp_path / "report.json"
    script = tmp_path / "script.mlx"
    measures = [hausdorff_filter(*layers, vertices, samples) for layers in DIRECTIONS for vertices in (False, True)]
    script.write_text(
        '<!DOCTYPE FilterScript>\n<FilterScript><filter name="Watermark: Measure Distortion">'
        '<Param name="Reference" type="RichMesh" value="0"/>'
        f'<Param name="Samples" type="RichInt" value="{samples}"/><Param name="Seed" type="RichInt" value="0"/>'
        f'<Param name="Report" type="RichSaveFile" value="{report}" ext="*.json"/></filter>'
        f"{''.join(measures)}</FilterScript>\n",
        encoding="utf-8",
    )
    done = MeshLabServer().arguments("-i", *paths, "-s", script)
    assert done.returncode == 0, done.stdout
    # Each distance has a second line, over the diagonal; and the whole log is printed again after every filter.
    lines = re.findall(r"min : \S+ +max (\S+) +mean : (\S+) +RMS : (\S+)", done.stdout)[-2 * len(measures) :: 2]
    assert len(lines) == len(measures), done.stdout
    faces = lines[::2]
    theirs = {
        "rms": [float(line[2]) for line in faces],
        "mean": [float(line[1]) for line in faces],
        "max": [float(line[0]) for line in lines],
    }
    compare(json.loads(report.read_text(encoding="utf-8")), theirs)
