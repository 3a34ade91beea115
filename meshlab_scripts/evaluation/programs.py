# SPDX-License-Identifier: GPL-3.0-or-later
"""What no protocol shows: programs that print tables or draw pictures. What one has printed is not done again."""

import hashlib
import shlex
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from tqdm import tqdm

from .jobs import digest

ROOT = Path(__file__).resolve().parents[2]
NOT_RUN = "it was not run yet."
LIST = ROOT / "meshlab_scripts" / "programs.toml"
PYTHON = (ROOT / "meshlab_scripts", ROOT / "tests" / "benchmark")


@dataclass(frozen=True)
class Program:
    """One of the list; its `command` still has places to fill in."""

    name: str
    about: str
    command: str

    def words(self, work: Path, printed: dict[str, Path]) -> list[str]:
        """The command, to be run from ROOT."""
        places = {"python": sys.executable, "build": ROOT / "build", "out": work / self.name, **printed}
        return [word.format_map(places) for word in shlex.split(self.command)]


@dataclass(frozen=True)
class Outcome:
    """What a program left behind, or why there is nothing."""

    program: Program
    output: Path
    error: str = ""


def read_programs(path: Path = LIST) -> list[Program]:
    """The list, in its order."""
    with path.open("rb") as file:
        return [Program(**spec) for spec in tomllib.load(file)["programs"]]


def run_programs(programs: list[Program], plugin: Path, work: Path, *, look_only: bool = False) -> list[Outcome]:
    """Runs, one after the other, those that have not printed yet, with this command, program and plugin."""
    work.mkdir(parents=True, exist_ok=True)
    printed: dict[str, Path] = {}
    outcomes = []
    for program in (bar := tqdm(programs, unit="program")):
        bar.set_description(program.name)
        words = program.words(work, printed)
        output = work / f"{program.name}.txt"
        state = _state(words, plugin)
        error = "" if _there(output, state) else NOT_RUN if look_only else _run(words, output, state)
        if error:
            bar.write(f"{program.name}: {error}")
        printed[program.name] = output
        outcomes.append(Outcome(program, output, error))
    return outcomes


def _there(output: Path, state: str) -> bool:
    """Whether there is an output of this state; the state lies beside it."""
    mark = output.with_suffix(".state")
    return output.exists() and mark.exists() and mark.read_text(encoding="utf-8") == state


def _run(words: list[str], output: Path, state: str) -> str:
    """Runs it. Returns why there is no output; empty where there is."""
    if shutil.which(words[0]) is None:
        return f"{Path(words[0]).name} is not built: tests/run.sh builds it."
    mark, part, pictures = output.with_suffix(".state"), output.with_suffix(".part"), output.with_suffix("")
    mark.unlink(missing_ok=True)
    pictures.mkdir(exist_ok=True)
    with part.open("w", encoding="utf-8") as file:
        done = subprocess.run(words, cwd=ROOT, check=False, stdout=file, stderr=subprocess.PIPE, text=True)
    if not any(pictures.iterdir()):
        pictures.rmdir()
    if done.returncode:
        said = done.stderr.strip().splitlines() or ["it said nothing"]
        return f"ended with {done.returncode}: {said[-1]}"
    part.replace(output)
    mark.write_text(state, encoding="utf-8")
    return ""


def _state(words: list[str], plugin: Path) -> str:
    """Changes with the command, with every file of ours that it names, and where one is Python with all of ours."""
    files = [path for word in words if (path := ROOT / word).is_file()]
    if any(path.suffix == ".py" for path in files):
        files += sorted(path for folder in PYTHON for path in folder.rglob("*.py"))
    return hashlib.sha256("\0".join([*words, digest(*files, plugin)]).encode()).hexdigest()


def write_summary(protocols: dict[str, str], outcomes: list[Outcome], folder: Path) -> Path:
    """One page with everything: the protocols' reports, or why there is none, and what the programs printed."""
    parts = ["# Every table and figure", "## Protocols"]
    parts.append("\n".join(f"- {name}: {said}" for name, said in protocols.items()))
    for outcome in outcomes:
        parts.append(f"## {outcome.program.name}: {outcome.program.about}")
        parts.append(f"`{outcome.program.command}`")
        if outcome.error:
            parts.append(f"Not there: {outcome.error}")
            continue
        text = outcome.output.read_text(encoding="utf-8").strip()
        parts.append(text if text.startswith(("|", "#")) else f"```\n{text}\n```" if text else "")
        pictures = sorted(outcome.output.with_suffix("").glob("*.png"))
        parts += [f"![{path.stem}]({path.relative_to(folder)})" for path in pictures]
    page = folder / "all.md"
    page.write_text("\n\n".join(filter(None, parts)) + "\n", encoding="utf-8")
    return page
