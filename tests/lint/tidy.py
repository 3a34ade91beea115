# SPDX-License-Identifier: GPL-3.0-or-later
"""clang-tidy over all our C++, headers too; what was found clean is not read again until it changes.

    build/venv/bin/python tests/lint/tidy.py [FOLDER OR FILE...]

Needs build/compile_commands.json. Most of the time goes into Eigen's and vcglib's headers, so the files of one folder
of vcg_ext are read as one; where that does not compile (two files have something of one name) each by itself. What is
clean has a stamp in build/lint, named by a hash of the files, of our headers that they include, of the command that
compiles them, and of clang-tidy and its settings. A plugin's sources are read for one host, 2020.09.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
STAMPS = BUILD / "lint"
OURS = f"^{re.escape(str(ROOT))}/(vcg_ext|filter_watermark|tests)/"
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
FINDING = re.compile(r"^(/[^:\n]+:\d+:\d+): (?:warning|error): (.*)$", re.MULTILINE)
# GCC's precompiled header, which clang cannot read.
PRECOMPILED = re.compile(r" -Winvalid-pch -include \S+")


@dataclass(frozen=True)
class Job:
    """Files that are read as one, and the options that they compile with."""

    files: tuple[Path, ...]
    options: tuple[str, ...]

    def name(self) -> str:
        """For people: the file, or the folder of several."""
        first = self.files[0].relative_to(ROOT)
        return str(first if len(self.files) == 1 else first.parent)

    def stamp(self, tools: bytes) -> Path:
        """Where the stamp lies of what these files are now."""
        digest = hashlib.sha256(tools + repr(self.options).encode())
        for file in with_headers(self.files):
            digest.update(str(file).encode() + file.read_bytes())
        return STAMPS / f"{self.name().replace('/', '-')}-{digest.hexdigest()[:32]}"

    def alone(self) -> list["Job"]:
        """A job for each file."""
        return [Job((file,), self.options) for file in self.files]


def options_of(command: str) -> tuple[str, ...]:
    """What a compiler is told besides what to read and what to write."""
    words = shlex.split(PRECOMPILED.sub("", command))
    start = next(i for i, word in enumerate(words) if word.startswith("-"))
    return tuple(words[start : words.index("-o")])


def jobs(parts: list[Path]) -> list[Job]:
    """The files below these folders, those of one folder of vcg_ext together."""
    groups: dict[tuple[str, tuple[str, ...]], list[Path]] = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8")):
        path, command = Path(entry["file"]), entry["command"]
        other_host = "filter_watermark-" in command and "/filter_watermark-2020.09.dir/" not in command
        if not any(path.is_relative_to(part) for part in parts) or other_host:
            continue
        if not any(path.is_relative_to(ROOT / folder) for folder in ("vcg_ext", "filter_watermark", "tests")):
            continue
        together = path.parent if path.is_relative_to(ROOT / "vcg_ext") else path
        group = groups.setdefault((str(together), options_of(command)), [])
        if path not in group:
            group.append(path)
    return [Job(tuple(files), options) for (_, options), files in groups.items()]


def with_headers(files: tuple[Path, ...]) -> list[Path]:
    """The files and those of our headers that they include, directly or not."""
    seen = dict.fromkeys(files)
    todo = list(files)
    while todo:
        file = todo.pop()
        for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
            for found in ((file.parent / name).resolve(), ROOT / name, ROOT / "tests" / name):
                if found.is_file() and found.is_relative_to(ROOT) and found not in seen:
                    seen[found] = None
                    todo.append(found)
    return sorted(seen)


def tidy(job: Job) -> str:
    """Reads a job's files: what was said, empty where they are clean."""
    with tempfile.TemporaryDirectory() as folder:
        one = Path(folder, "all.cpp")
        one.write_text("".join(f'#include "{file}"\n' for file in job.files), encoding="utf-8")
        done = subprocess.run(
            ["clang-tidy", "--quiet", f"--config-file={ROOT / '.clang-tidy'}", f"--header-filter={OURS}",
             "--checks=-bugprone-suspicious-include", str(one),
             "--", *job.options],
            cwd=BUILD,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )  # fmt: skip
    return done.stdout if done.returncode else ""


def check(job: Job, tools: bytes) -> dict[str, str]:
    """Reads what has no stamp; returns the findings, by place."""
    stamp = job.stamp(tools)
    if stamp.exists():
        return {}
    said = tidy(job)
    if "[clang-diagnostic-error]" in said and len(job.files) > 1:
        print(f"{job.name()} does not compile as one", file=sys.stderr, flush=True)
        return {where: what for single in job.alone() for where, what in check(single, tools).items()}
    found = {where.removeprefix(f"{ROOT}/"): what for where, what in FINDING.findall(said)}
    for where, what in found.items() or [(job.name(), said.strip() or "clean")]:
        print(f"{where}: {what}", flush=True)
    if not said:
        stamp.touch()
    return found or ({job.name(): said} if said else {})


def main(parts: list[str]) -> int:
    """Prints the findings, and returns whether there is one."""
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE, check=True).stdout
    tools = version + (ROOT / ".clang-tidy").read_bytes()
    STAMPS.mkdir(parents=True, exist_ok=True)
    wanted = jobs([ROOT / part for part in parts] or [ROOT])
    if not wanted:
        raise SystemExit("build/compile_commands.json has no such file.")
    findings: dict[str, str] = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lambda job: check(job, tools), wanted):
            findings |= found
    print(f"{sum(len(job.files) for job in wanted)} files, {len(findings)} findings")
    return int(bool(findings))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
