#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""clang-tidy over the library, the command line and the Python module: `tools/static_analysis.py BUILD_FOLDER [--jobs N]`.

Reads compile_commands.json of a configured build. Sources that the build joins (cmake/Unity.cmake) are analysed together:
most of the time goes into the headers that they share. A unit is analysed again when one of its sources, any header or the
list of checks is newer than its stamp in build/tidy. The verification cases are left out, as tests are: no run of a
user's case goes through them.

Exit code 0: no finding, 1: findings, which are printed, 2: the build folder does not hold what is needed.
"""
import argparse
import json
import os
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ANALYSED = ("src/dem4grm/", "apps/", "python/src/")
LEFT_OUT = "src/dem4grm/verify/"
INCLUDE = re.compile(r'^#include "(.*\.cpp)"$', re.MULTILINE)
# Flags for g++ that clang does not know are no finding, and what is an error is said by .clang-tidy alone.
OPTIONS = ["--quiet", "--extra-arg=-Wno-error", "--extra-arg=-Wno-unknown-warning-option"]


def flags_of(entry):
    """The compiler's arguments without the compiler, its input, its output and what belongs to the build alone."""
    words, kept = shlex.split(entry["command"]), []
    start = next(n for n, word in enumerate(words) if word.startswith("-"))
    skip = 0
    for word in words[start:]:
        if skip:
            skip -= 1
        elif word in ("-o", "-c", "-MT", "-MF", "-include"):
            skip = 1
        elif word not in ("-MD", "-Winvalid-pch"):
            kept.append(word)
    return kept


def units(build, folder):
    """(name, sources, file to analyse, flags) for everything that the build compiles of the analysed folders."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        file = Path(entry["file"])
        joined = INCLUDE.findall(file.read_text(encoding="utf-8")) if file.suffix == ".cxx" else []
        sources = [Path(source) for source in joined] or [file]
        names = [str(source.relative_to(ROOT)) for source in sources if source.is_relative_to(ROOT)]
        if not names or not names[0].startswith(ANALYSED) or names[0].startswith(LEFT_OUT) or "state_hashes_w" in entry["command"]:
            continue
        if joined:
            file = folder / (re.sub(r"\W", "_", str(file.relative_to(build))) + ".cpp")
            # Only for this line: to include a source is what joins it, and clang-tidy's bugprone-suspicious-include minds
            # that. Findings in the source itself are reported.
            file.write_text("".join(f'#include "{source}"  // NOLINT\n' for source in sources), encoding="utf-8")
        yield names[0], sources, file, flags_of(entry)


def analyse(file, flags):
    answer = subprocess.run(["clang-tidy-14", *OPTIONS, str(file), "--", *flags], cwd=ROOT, capture_output=True, text=True, check=False)
    lines = [line for line in (answer.stdout + answer.stderr).splitlines() if not re.search(r"warnings? generated", line)]
    return answer.returncode == 0, "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    build = options.build.resolve()
    if not (build / "compile_commands.json").exists():
        print(f"static_analysis: {build} is not configured", file=sys.stderr)
        return 2
    folder = ROOT / "build" / "tidy"
    folder.mkdir(parents=True, exist_ok=True)
    common = [path for name in ANALYSED for path in (ROOT / name).rglob("*.hpp")] + [ROOT / ".clang-tidy", Path(__file__)]
    newest = max(path.stat().st_mtime for path in common)
    todo, n_sources = [], 0
    for name, sources, file, flags in units(build, folder):
        n_sources += len(sources)
        stamp = folder / (name + ".passed")
        # The stamp holds what was analysed and how, so that a file that moved to another unit is looked at again.
        key = "\n".join([*map(str, sources), *flags])
        changed = max(newest, *(source.stat().st_mtime for source in sources))
        if not stamp.exists() or stamp.stat().st_mtime <= changed or stamp.read_text(encoding="utf-8") != key:
            todo.append((stamp, key, file, flags))
    expected = {str(path) for name in ANALYSED for path in (ROOT / name).rglob("*.cpp")}
    expected = {path for path in expected if not path.startswith(str(ROOT / LEFT_OUT))}
    print(f"clang-tidy: {n_sources} files, {len(todo)} units to analyse", flush=True)
    if n_sources < len(expected):
        print(f"static_analysis: {build} compiles {n_sources} files, the tree holds {len(expected)}", file=sys.stderr)
        return 2

    def run(unit):
        stamp, key, file, flags = unit
        passed, text = analyse(file, flags)
        if passed:
            stamp.parent.mkdir(parents=True, exist_ok=True)
            stamp.write_text(key, encoding="utf-8")
        else:
            print(text, flush=True)
        return passed

    with ThreadPoolExecutor(options.jobs) as pool:
        results = list(pool.map(run, todo))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
