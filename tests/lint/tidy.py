"""clang-tidy over all our C++, headers too; a file that was found clean is not read again until it changes.

    build/venv/bin/python tests/lint/tidy.py [FOLDER OR FILE...]

Needs build/compile_commands.json. What is clean has a stamp in build/lint, named by a hash of the file, of our headers
that it includes, of the command that compiles it, and of clang-tidy and its settings. A plugin's sources are read for
one host, 2020.09.
"""

import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
STAMPS = BUILD / "lint"
HEADERS = f"^{re.escape(str(ROOT))}/(vcg_ext|filter_watermark|tests)/"
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
FINDING = re.compile(r"^(/[^:\n]+:\d+:\d+): (?:warning|error): (.*)$", re.MULTILINE)
# GCC's precompiled header, which clang cannot read.
PRECOMPILED = re.compile(r" -Winvalid-pch -include \S+")


def commands() -> dict[Path, str]:
    """Our sources and how each is compiled."""
    entries = json.loads((BUILD / "compile_commands.json").read_text(encoding="utf-8"))
    ours = [ROOT / folder for folder in ("vcg_ext", "filter_watermark", "tests")]
    chosen = {}
    for entry in entries:
        path = Path(entry["file"])
        other_host = (
            "filter_watermark-" in entry["command"] and "/filter_watermark-2020.09.dir/" not in entry["command"]
        )
        if any(path.is_relative_to(folder) for folder in ours) and not other_host:
            chosen[path] = PRECOMPILED.sub("", entry["command"])
    return chosen


def with_headers(path: Path) -> list[Path]:
    """The file and those of our headers that it includes, directly or not."""
    seen = {path: None}
    todo = [path]
    while todo:
        file = todo.pop()
        for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
            for found in ((file.parent / name).resolve(), ROOT / name, ROOT / "tests" / name):
                if found.is_file() and found.is_relative_to(ROOT) and found not in seen:
                    seen[found] = None
                    todo.append(found)
    return sorted(seen)


def stamp(path: Path, command: str, tools: bytes) -> Path:
    """Where the stamp of this file lies, as it is now."""
    digest = hashlib.sha256(tools + command.encode())
    for file in with_headers(path):
        digest.update(file.read_bytes())
    return STAMPS / f"{path.stem}-{digest.hexdigest()[:32]}"


def check(path: Path, command: str) -> tuple[Path, str, bool]:
    """Reads one file: what it was, what was said, and whether it is clean."""
    # The first word compiles, or calls what compiles: clang needs what comes after that.
    words = shlex.split(command)
    start = next(i for i, word in enumerate(words) if word.startswith("-"))
    done = subprocess.run(
        ["clang-tidy", "--quiet", f"--header-filter={HEADERS}", str(path), "--", *words[start:]],
        cwd=BUILD,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    return path, done.stdout, done.returncode == 0


def main(parts: list[str]) -> int:
    """Reads what has no stamp, prints each finding once, and returns how many there are."""
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE, check=True).stdout
    tools = version + (ROOT / ".clang-tidy").read_bytes()
    STAMPS.mkdir(parents=True, exist_ok=True)
    wanted = [ROOT / part for part in parts] or [ROOT]
    chosen = {path: line for path, line in commands().items() if any(path.is_relative_to(part) for part in wanted)}
    if not chosen:
        raise SystemExit("build/compile_commands.json has no such file.")
    stamps = {path: stamp(path, command, tools) for path, command in chosen.items()}
    todo = [path for path in chosen if not stamps[path].exists()]
    findings: dict[str, str] = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for path, said, clean in pool.map(lambda path: check(path, chosen[path]), todo):
            if clean:
                stamps[path].touch()
                continue
            found = FINDING.findall(said)
            findings |= {where.removeprefix(f"{ROOT}/"): what for where, what in found} or {str(path): said}
            print(f"{path.relative_to(ROOT)}: {len(found)} findings", file=sys.stderr, flush=True)
    for where, what in sorted(findings.items()):
        print(f"{where}: {what}")
    print(f"{len(chosen)} files, {len(todo)} read, {len(findings)} findings")
    return len(findings)


if __name__ == "__main__":
    sys.exit(min(main(sys.argv[1:]), 1))
