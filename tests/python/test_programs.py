# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs that `evaluate.py all` runs: each once, unless it or its command changed, and all that there are."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BENCHMARK = ROOT / "tests" / "benchmark"
sys.path.insert(0, str(ROOT / "meshlab_scripts"))

from evaluation.programs import Program, read_programs, run_programs, write_summary  # noqa: E402

# Programs that fail where something is wrong are tests; the others of these are parts of others, or built by hand.
NO_TABLES = {"attack_sweep", "mesh_sweep", "geodesic_distances", "shop", "shapes", "msdm2", "compare"}
COUNT = "import sys; from pathlib import Path; file = Path({file!r}); file.open('a').write('x'); print('| table |')"


def test_the_list_has_every_program_of_the_benchmark() -> None:
    commands = [program.command for program in read_programs()]
    named = {Path(word).stem for command in commands for word in command.split()}
    there = {path.stem for path in BENCHMARK.rglob("*") if path.suffix in {".cpp", ".py"}}
    assert there - named == NO_TABLES
    for command in commands:
        for script in re.findall(r"\S+\.py", command):
            assert (ROOT / script).is_file(), script
    for built in re.findall(r"{build}/tests/(\w+)", "\n".join(commands)):
        assert (BENCHMARK / f"{built}.cpp").is_file(), built


@pytest.fixture
def script(tmp_path: Path) -> Path:
    path = tmp_path / "script.py"
    path.write_text(COUNT.format(file=str(tmp_path / "runs")), encoding="utf-8")
    return path


def test_a_program_is_run_once_until_it_changes(tmp_path: Path, script: Path) -> None:
    runs = tmp_path / "runs"
    programs = [Program("counting", "counts", f"{{python}} {script}")]
    for expected in ("x", "x"):
        (outcome,) = run_programs(programs, script, tmp_path / "work")
        assert outcome.error == ""
        assert outcome.output.read_text(encoding="utf-8") == "| table |\n"
        assert runs.read_text(encoding="utf-8") == expected
    script.write_text(script.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    (outcome,) = run_programs(programs, tmp_path / "script.py", tmp_path / "work", look_only=True)
    assert "not run yet" in outcome.error
    run_programs(programs, script, tmp_path / "work")
    assert runs.read_text(encoding="utf-8") == "xx"


def test_what_fails_or_is_missing_is_said_and_the_rest_goes_on(tmp_path: Path, script: Path) -> None:
    bad, draws, reads = (tmp_path / f"{name}.py" for name in ("bad", "draws", "reads"))
    bad.write_text("raise SystemExit('no such mesh')", encoding="utf-8")
    draws.write_text("import sys; open(sys.argv[1] + '/a.png', 'w').close()", encoding="utf-8")
    reads.write_text("import sys; print(open(sys.argv[1]).read())", encoding="utf-8")
    programs = [
        Program("bad", "fails", f"{{python}} {bad}"),
        Program("gone", "is not there", "{build}/tests/no_such_program"),
        Program("draws", "a picture", f"{{python}} {draws} {{out}}"),
        Program("counting", "counts", f"{{python}} {script}"),
        Program("reads", "what another printed", f"{{python}} {reads} {{counting}}"),
    ]
    outcomes = run_programs(programs, script, tmp_path / "work")
    assert [bool(outcome.error) for outcome in outcomes] == [True, True, False, False, False]
    text = write_summary({"smoke": "done"}, outcomes, tmp_path).read_text(encoding="utf-8")
    for part in (
        "ended with 1: no such mesh",
        "no_such_program is not built",
        "![a](work/draws/a.png)",
        "- smoke: done",
    ):
        assert part in text
    assert text.count("| table |") == 2
