# SPDX-License-Identifier: GPL-3.0-or-later
"""evaluate.py: the smoke protocol from start to report, killed and resumed, and with jobs that fail."""

import math
import os
import signal
import sqlite3
import subprocess
import sys
import time
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from doors import MESHES, PyMeshLab

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "meshlab_scripts"
sys.path.insert(0, str(SCRIPTS))

from evaluation import work  # noqa: E402
from evaluation.channels import CHANNELS  # noqa: E402
from evaluation.curves import binomial_tail, equal_error_rate, false_positives  # noqa: E402
from evaluation.figures import figure  # noqa: E402
from evaluation.frames import WAYS, frames, shift  # noqa: E402
from evaluation.jobs import Job, Site  # noqa: E402
from evaluation.protocol import ProtocolError, read_protocol  # noqa: E402
from evaluation.results import limits_in_words  # noqa: E402
from evaluation.tables import found, robustness, table, within_limits  # noqa: E402


def command(protocol: str | Path, work: Path) -> list[str]:
    return [sys.executable, str(SCRIPTS / "evaluate.py"), str(protocol), "--work", str(work)]


def evaluate(protocol: str | Path, work: Path) -> pd.DataFrame:
    subprocess.run(command(protocol, work), check=True, timeout=300)
    return pd.read_csv(work / Path(protocol).stem / "results.csv", keep_default_na=False, na_values={"p_value": [""]})


def stored(work: Path) -> list[tuple]:
    if not (work / "results.sqlite").exists():
        return []
    connection = sqlite3.connect(work / "results.sqlite")
    try:
        return connection.execute("SELECT * FROM results").fetchall()
    except sqlite3.OperationalError:  # the table is not there yet
        return []
    finally:
        connection.close()


@pytest.fixture(scope="module")
def smoke(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, pd.DataFrame]:
    work = tmp_path_factory.mktemp("smoke")
    return work, evaluate("smoke", work)


def test_smoke_is_complete(smoke: tuple[Path, pd.DataFrame]) -> None:
    work, results = smoke
    assert (results["error"] == "").all()
    # 2 methods x (2 keys x (itself, 4 attacks) + 5 searches in the unmarked mesh); the layers: 2 attacks, 2 searches;
    # the channels: 5; equal MSDM: 1 attack
    assert len(results) == 2 * (2 * 5 + 5) + (2 * 3 + 2) + 2 * 6 + 2 * 2
    report = (work / "smoke" / "report.md").read_text(encoding="utf-8")
    for heading in ("Table 5.3", "Figure 5.8", "False positives and false negatives", "Detection ratio after every",
                    "log10 p of the message that is known", "log10 p of what the key alone reads", "Found (channels)",
                    "log10 p of what key and original read", "Marks within the limits (equal-msdm)"):  # fmt: skip
        assert f"## {heading}" in report
    for picture in ("figure-5.8", "three-in-a-row", "errors-robustness"):
        assert f"figures/{picture}.png" in report
        assert (work / "smoke" / "figures" / f"{picture}.png").stat().st_size > 5000


def test_smoke_obeys_what_must_hold(smoke: tuple[Path, pd.DataFrame]) -> None:
    _, results = smoke
    unattacked = results[(results["kind"] == "embed") | (results["series"] == "similarity")]
    assert (unattacked["detection_ratio"].astype(float) == 1).all()
    assert (unattacked["log10_p"] < -6).all()
    channels = results[(results["experiment"] == "channels") & (results["kind"] == "attack")]
    for name in ("log10_p", "log10_p_alone", "log10_p_original", "log10_p_alone_original"):
        assert (channels[name].astype(float) < -6).all(), name
    at_limit = results[(results["experiment"] == "equal-msdm") & (results["kind"] == "embed")]
    assert at_limit["msdm"].astype(float).between(0.99 * 0.1, 0.1).all()
    assert (results.loc[results["kind"] == "null", "log10_p"] > -6).all()
    for row in results[results["method"] != "Layered"].itertuples():  # of one layer, and of one way to read it
        exact = binomial_tail(int(row.bits), float(row.detection_ratio))
        assert math.isclose(row.p_value, exact, rel_tol=1e-4), row  # the file has six digits


def test_killed_run_goes_on_where_it_was(smoke: tuple[Path, pd.DataFrame], tmp_path: Path) -> None:
    with subprocess.Popen(command("smoke", tmp_path), stderr=subprocess.DEVNULL) as process:
        deadline = time.monotonic() + 240
        while len(stored(tmp_path)) < 12:
            assert process.poll() is None, "it ended before it could be killed"
            assert time.monotonic() < deadline
            time.sleep(0.05)
        os.kill(process.pid, signal.SIGKILL)
    before = stored(tmp_path)
    assert 12 <= len(before) < len(smoke[1])
    evaluate("smoke", tmp_path)
    # Times are among the results: a job that had been done again would differ.
    assert stored(tmp_path)[: len(before)] == before
    whole, resumed = smoke[0] / "smoke", tmp_path / "smoke"
    compared = [whole / "results.csv", *sorted((whole / "tables").iterdir())]
    assert len(compared) >= 4
    for path in compared:
        assert (resumed / path.relative_to(whole)).read_bytes() == path.read_bytes(), path.name


def test_all_of_what_is_done_runs_nothing(smoke: tuple[Path, pd.DataFrame]) -> None:
    work, _ = smoke
    before = stored(work)
    subprocess.run(
        [*command("all", work), "--only", "smoke", "--only", "texture", "--report-only"], check=True, timeout=300
    )
    assert stored(work) == before
    page = (work / "all.md").read_text(encoding="utf-8")
    assert "- smoke: [report](smoke/report.md)" in page
    assert "## texture: " in page
    assert "not run yet" in page
    assert "thesis-ch5" not in page


def test_job_that_fails_is_recorded_and_the_rest_goes_on(tmp_path: Path) -> None:
    protocol = tmp_path / "failing.toml"
    protocol.write_text(
        """
        title = "A tetrahedron cannot carry 32 bits"
        meshes = ["tetrahedron", "fandisk"]
        keys = 1
        attacks.similarity = { attack = "Similarity" }
        attacks.nonsense = { attack = "Noise", amounts = [7] }
        [[experiments]]
        name = "both"
        methods = ["ChoMean"]
        bits = [32]
        strengths = [0.1]
        attacks = ["similarity", "nonsense"]
        """,
        encoding="utf-8",
    )
    results = evaluate(protocol, tmp_path).set_index(["mesh", "kind", "series"])["error"]
    assert results["fandisk", "embed", ""] == ""
    assert results["fandisk", "attack", "similarity"] == ""
    assert "Amount is 7" in results["fandisk", "attack", "nonsense"]
    assert (results["tetrahedron"] != "").all()
    assert "## Jobs that failed" in (tmp_path / "failing" / "report.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("weakest", "most"), [(0.001, 0.3), (0.03, 0.3), (0.14, 0.3), (0.01, 0.12), (0.01, 0.08)])
@pytest.mark.parametrize("power", [0.1, 0.5, 1, 2])
@pytest.mark.parametrize("first", [None, 0.14, 0.16, 0.02, 0.3])
def test_strength_is_the_strongest_within_the_limits(
    first: float | None, weakest: float, most: float, power: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether the distortion grows as the strength or not, and where marks below a strength do not read back; from
    the top down, or from what another key has.
    """
    asked = []

    def excess(_job: Job, strength: float, _site: Site) -> float:
        asked.append(strength)
        return (strength / 0.15) ** power if weakest <= strength <= most else math.inf

    monkeypatch.setattr(work, "_excess", excess)
    job = Job(kind="embed", mesh="m", mesh_digest="", plugin_digest="", method="L-MMean", limits=(("mrms", 1.0),))
    best = min(most, 0.15)
    found = work._strongest(job, Site(Path(), Path(), Path()), first)
    assert found <= best
    assert found >= 0.98 * best or (found / 0.15) ** power >= 1 - work.CLOSE
    assert len(asked) <= 14


@pytest.mark.parametrize("limit", [0.002, 0.0021, 0.0024, 0.004])
@pytest.mark.parametrize("power", [0.1, 0.3, 0.5, 1, 2])
def test_the_weakest_marks_are_found(power: float, limit: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a line through two stronger marks leads below the least strength, that is tried."""
    monkeypatch.setattr(work, "_excess", lambda _job, strength, _site: (strength / limit) ** power)
    job = Job(kind="embed", mesh="m", mesh_digest="", plugin_digest="", method="L-MMean", limits=(("mrms", 1.0),))
    found = work._strongest(job, Site(Path(), Path(), Path()), None)
    assert found is not None
    assert found <= limit
    assert found >= 0.98 * limit or (found / limit) ** power >= 1 - work.CLOSE


def test_each_key_keeps_the_limits(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Each with a strength of its own, which is the same whichever is sought first."""
    worth = [1.0, 1.4, 0.6]
    monkeypatch.setattr(work, "_excess", lambda job, strength, _: worth[job.key] * strength / 0.1)
    job = Job(kind="embed", mesh="m", mesh_digest="", plugin_digest="", method="L-MMean", limits=(("mrms", 1.0),))
    jobs = [replace(job, key=key) for key in range(3)]
    found = []
    for order in (jobs, jobs[::-1]):
        site = Site(Path(), Path(), tmp_path / str(len(found)))
        site.cache.mkdir()
        found.append({job.key: work._strength(job, site) for job in order})
    assert found[0] == found[1]
    for key, strength in found[0].items():
        assert 0.98 <= worth[key] * strength / 0.1 <= 1


def test_what_is_reported_keeps_the_limit(tmp_path: Path) -> None:
    """MRMS is that between the surfaces, either way, which may be larger than what the embedding knows."""
    protocol = tmp_path / "limit.toml"
    protocol.write_text(
        """
        title = "Waves on bunny00 moves vertices by 1.003e-4 where it reports 1e-4"
        meshes = ["bunny00"]
        keys = 2
        attacks.similarity = { attack = "Similarity" }
        [[experiments]]
        name = "limit"
        methods = ["Waves"]
        bits = [64]
        limits = [{ mrms_relative = 1e-4 }]
        attacks = ["similarity"]
        """,
        encoding="utf-8",
    )
    results = evaluate(protocol, tmp_path)
    marks = results[results["kind"] == "embed"]
    assert len(marks) == 2
    assert marks["mrms_relative"].astype(float).between(0.98e-4, 1e-4).all()


def test_a_mesh_that_does_not_fit_the_original_is_read_as_a_coin() -> None:
    """And its job does not fail, so that what the key alone reads is kept."""
    site = Site(MESHES, PyMeshLab.plugin, Path())
    work.plugin.load(site.plugin)
    job = Job(kind="attack", mesh="homer", mesh_digest="", plugin_digest="", method="L-MMean", original=True)
    with work.opened(MESHES / "fandisk.off") as meshes:
        read = work._read_with_original(meshes, job, site)
    assert read == {"detection_ratio_original": 0.5, "log10_p_original": 0, "log10_p_alone_original": 0}


def test_no_strength_keeps_the_limits_and_is_sought_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    asked = []
    monkeypatch.setattr(work, "_excess", lambda *_: asked.append(1) or math.inf)
    job = Job(kind="embed", mesh="m", mesh_digest="", plugin_digest="", method="L-MMean", limits=(("mrms", 1.0),))
    for _ in range(2):
        with pytest.raises(ValueError, match="No strength"):
            work._strength(job, Site(Path(), Path(), tmp_path))
    assert 0 < len(asked) <= work.STEPS


SMALL = """
title = "t"
meshes = ["fandisk"]
keys = 1
attacks.noise = { attack = "Noise", amounts = [0.001] }
[[experiments]]
name = "e"
methods = ["ChoMean"]
bits = [32]
strengths = [0.1]
attacks = ["noise"]
[[figures]]
name = "f"
title = "t"
experiment = "e"
x = "amount"
y = "detection_ratio"
[[tables]]
name = "t"
title = "t"
experiment = "e"
rows = ["mesh"]
columns = [{ label = "l", method = "ChoMean", value = "mrms" }]
"""


def test_protocols_are_read() -> None:
    for path in sorted((SCRIPTS / "protocols").glob("*.toml")):
        assert read_protocol(path).experiments


def test_a_job_comes_after_the_one_that_it_needs() -> None:
    """So that a mark is made once, and a strength sought once, however many work on them."""
    meshes, plugin = ROOT / "build/data/meshes", ROOT / "build/meshlab-2025.07/libfilter_watermark.so"
    for name in ("smoke", "field"):
        earlier = set()
        for job in (case.job for case in read_protocol(SCRIPTS / f"protocols/{name}.toml").cases(meshes, plugin)):
            if job.kind == "attack" or (job.kind == "embed" and job.limits and job.key):
                assert job.before in earlier
            if job.limits:
                assert job.before.before == replace(job.mark, key=0)
            earlier.add(job)


@pytest.mark.parametrize(
    ("right", "wrong", "texts"),
    [
        ("strengths =", "strength =", ["experiment 'e'", "no strength;", "strengths"]),
        ("strengths = [0.1]", "", ["experiment 'e'", "nothing to do"]),
        ("amounts =", "amount =", ["attacks.noise", "no amount;"]),
        ("keys = 1", "key = 1", ["lacks keys"]),
        ("keys = 1", "keys = 1\nseeds = 1", ["no seeds;"]),
        ('attacks = ["noise"]', 'attacks = ["noises"]', ["experiment 'e'", "'noises'", "noise"]),
        ('methods = ["ChoMean"]', 'methods = ["Cho"]', ["'Cho'", "ChoMean"]),
        ('experiment = "e"\nx', 'experiment = "d"\nx', ["figure 'f'", "'d'"]),
        ('y = "detection_ratio"', "ys = { ours = 'msdm' }", ["figure 'f'", "a label"]),
        ("rows =", "row =", ["table 't'", "lacks rows"]),
        ("value =", "values =", ["column 'l'", "lacks value"]),
        ("columns = [", 'each = { value = "mrms" }\ncolumns = [', ["table 't'", "either columns or each"]),
        (
            "strengths =",
            "published.Cho.noise = [0.1, 0.2]\nstrengths =",
            ["published.Cho.noise", "each of the amounts"],
        ),
        ("keys = 1", "keys = ", ["line 4"]),
    ],
)
def test_a_slip_in_a_protocol_is_refused(tmp_path: Path, right: str, wrong: str, texts: list[str]) -> None:
    path = tmp_path / "slip.toml"
    path.write_text(SMALL, encoding="utf-8")
    assert read_protocol(path).keys == 1
    assert right in SMALL
    path.write_text(SMALL.replace(right, wrong), encoding="utf-8")
    with pytest.raises(ProtocolError) as refused:
        read_protocol(path)
    for text in [str(path), *texts]:
        assert text in str(refused.value)


def test_what_is_no_mesh_and_no_result_is_named(tmp_path: Path) -> None:
    path = tmp_path / "small.toml"
    path.write_text(SMALL.replace("fandisk", "nowhere"), encoding="utf-8")
    with pytest.raises(ProtocolError, match="No mesh 'nowhere'"):
        read_protocol(path).cases(ROOT / "build/data/meshes", path)
    row = {"experiment": ["e"], "error": [""], "kind": ["embed"], "mesh": ["fandisk"], "mrms": [1.0]}
    with pytest.raises(ProtocolError, match="figure 'f' shows detection_ratio, method"):
        figure({**tomllib.loads(SMALL)["figures"][0], "x": "mrms"}, pd.DataFrame(row), tmp_path / "f.png")
    spec = tomllib.loads(SMALL.replace('value = "mrms"', 'value = "msdm"'))["tables"][0]
    with pytest.raises(ProtocolError, match="table 't' shows msdm"):
        table(spec, pd.DataFrame(row))


def test_a_job_of_a_channel_knows_its_code() -> None:
    meshes, plugin = ROOT / "build/data/meshes", ROOT / "build/meshlab-2025.07/libfilter_watermark.so"
    cases = read_protocol(SCRIPTS / "protocols/smoke.toml").cases(meshes, plugin)
    assert {case.job.attack in CHANNELS for case in cases} == {True, False}
    for case in cases:
        assert (case.job.channel_digest != "") == (case.job.attack in CHANNELS)
        assert case.job.mark.channel_digest == ""


def test_published_rates_stand_beside_ours() -> None:
    protocol = read_protocol(SCRIPTS / "protocols" / "smoke.toml")
    assert protocol.published("layers") == {"Cho": {("loop", -1.0, -1): 0.84}}
    rows = [
        {"experiment": "robustness", "kind": "attack", "error": "", "mesh": "m", "method": "L-MMean", "series": name,
         "bits": 64, "strength": 0, "limits": "", "amount": -1.0, "iterations": -1, "detection_ratio": 0.75}
        for name in ("loop", "similarity")
    ]  # fmt: skip
    text = robustness(pd.DataFrame(rows), "robustness", "detection_ratio", 2, protocol.published("layers"))
    assert text.splitlines()[2:] == ["| m | loop |  |  | 0.75 | 0.84 |", "| m | similarity |  |  | 0.75 | – |"]


def test_share_of_marks_that_are_found() -> None:
    row = {
        "experiment": "e",
        "kind": "attack",
        "error": "",
        "mesh": "m",
        "series": "noise",
        "bits": 64,
        "strength": 0.0,
    }
    rows = [
        {**row, "method": method, "limits": limits, "log10_p": p, "log10_p_alone": alone, "log10_p_original": math.nan}
        for method, limits, p, alone in [
            ("Waves", "MSDM at most 0.1", -7.0, -5.0),
            ("Waves", "MSDM at most 0.1", -5.9, 0.0),
            ("Waves", "MSDM at most 0.2", -19.0, -9.0),
            ("L-MMean", "MSDM at most 0.2", 0.0, 0.0),
        ]
    ] + [{**row, "method": "Layered", "limits": "MSDM at most 0.2", "error": "No strength"}]
    text = found(pd.DataFrame(rows), "e", ["log10_p", "log10_p_alone", "log10_p_original"])
    assert text.splitlines() == [
        "| limits | attack | Layered | Waves | L-MMean |",
        "| --- | ---: | ---: | ---: | ---: |",
        "| MSDM at most 0.1 | noise | – | 50 / 0 | – |",
        "| MSDM at most 0.2 | noise | – | 100 / 100 | 0 / 0 |",
    ]
    assert found(pd.DataFrame(rows[-1:]), "e", ["log10_p"]) == ""


def test_marks_within_the_limits_are_counted() -> None:
    row = {"experiment": "e", "kind": "embed", "error": "", "mesh": "m", "method": "Waves"}
    at, beyond = {"limits": "MSDM at most 0.1"}, {"limits": "MSDM at most 0.2"}
    rows = [
        {**row, **at},
        {**row, **at, "error": "No strength"},
        {**row, **beyond, "mesh": "n", "method": "Layered", "error": "No strength"},
        {**row, **beyond, "kind": "attack"},
    ]
    assert within_limits(pd.DataFrame(rows), "e").splitlines() == [
        "| limits | mesh | Layered | Waves |",
        "| --- | ---: | ---: | ---: |",
        "| MSDM at most 0.1 | m | – | 1 of 2 |",
        "| MSDM at most 0.2 | n | 0 of 1 | – |",
    ]
    assert within_limits(pd.DataFrame([{**row, "limits": ""}]), "e") == ""


def test_limits_are_words_and_sort_by_number() -> None:
    limits = [limits_in_words((("mrms_relative", limit), ("msdm", 0.3))) for limit in (4e-5, 1e-4, 2.9e-4, 8e-4, 0.01)]
    assert limits == sorted(limits)
    assert limits[0] == "MRMS at most 0.00004, MSDM at most 0.3"
    assert limits_in_words((("msdm", 1.0),)) == "MSDM at most 1"


def test_a_report_of_nothing_says_so(tmp_path: Path) -> None:
    done = subprocess.run(
        [*command("smoke", tmp_path), "--report-only"], check=False, timeout=300, capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "no results of this protocol" in done.stderr
    assert "Traceback" not in done.stderr


def test_each_method_has_its_own_bound() -> None:
    ratios = [0.5, 0.625, 0.75]
    tails = [binomial_tail(16, ratio) for ratio in ratios]
    rows = pd.DataFrame(
        [
            {"method": method, "bits": 16, "detection_ratio": ratio, "p_value": min(1, tries * tail)}
            for method, tries in (("L-MMean", 1), ("Spectral", 4), ("ChoMean", 1))
            for ratio, tail in zip(ratios, tails, strict=True)
        ]
    )
    found = false_positives(rows, np.array([0.3, 0.7]))
    assert list(found) == ["L-MMean, ChoMean, 16 bits", "Spectral, 16 bits"]
    for (rate, bound), tries in zip(found.values(), (1, 4), strict=True):
        assert rate == pytest.approx([1, 1 / 3])
        assert bound == pytest.approx([min(1, tries * binomial_tail(16, 0.3)), tries * binomial_tail(16, 0.7)])
    assert list(false_positives(rows[rows["method"] != "Spectral"], np.array([0.5]))) == [""]


def test_equal_error_rate() -> None:
    assert equal_error_rate(np.array([0.9, 1.0]), np.array([0.4, 0.5])) == 0
    assert equal_error_rate(np.array([0.4, 0.6]), np.array([0.4, 0.6])) == pytest.approx(0.5)
    # At a threshold of 0.6 one of four is missed and one of four is a false alarm.
    marked, unmarked = np.array([0.5, 0.7, 0.8, 0.9]), np.array([0.2, 0.3, 0.4, 0.6])
    assert equal_error_rate(marked, unmarked) == pytest.approx(0.25)


def test_frames_of_a_box() -> None:
    """A box of 3 x 2 x 1 about (5, 6, 7), with one side split finely: only the vertices' own frame sees that."""
    corners = np.array([[x, y, z] for x in (3.5, 6.5) for y in (5.0, 7.0) for z in (6.5, 7.5)])
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([side for a, b, c, d in sides for side in ((a, b, c), (a, c, d))])
    found = frames(corners, faces)
    for way in WAYS:
        assert found[way][0] == pytest.approx([5, 6, 7])
        assert abs(found[way][1][0]) == pytest.approx(1)
    split = np.vstack([corners, [[6.5, 6, 7]]])
    finer = np.vstack([np.delete(faces, [2, 3], axis=0), [[a, b, 8] for a, b in ((4, 6), (6, 7), (7, 5), (5, 4))]])
    after = frames(split, finer)
    assert shift(found["volume"], after["volume"]) == pytest.approx((0, 0), abs=1e-5)
    assert shift(found["surface"], after["surface"]) == pytest.approx((0, 0), abs=1e-5)
    assert shift(found["vertices"], after["vertices"])[0] == pytest.approx(1.5 / 9)
