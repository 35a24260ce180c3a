#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles every header alone, and twice in a row: each must include what it uses and stand repetition.

Exit code 1 if any header fails; the compiler's first lines are printed. The header that the build generates is
replaced by a stand-in, so that no build is needed first.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FOLDERS = ("src", "apps", "tests", "bench")
FLAGS = ["-std=c++20", "-fsyntax-only", "-fopenmp", "-Wall", "-Wextra", "-Werror", "-Wno-psabi", "-fdiagnostics-color=never"]
LIBRARIES = ("hdf5", "libxxhash", "eigen3")  # the others live in the compiler's own search path


def stand_in(root: Path, folder: Path) -> None:
    """Writes a version.hpp with the names that cmake/WriteVersion.cmake declares."""
    script = root / "cmake" / "WriteVersion.cmake"
    names = re.findall(r"\bk_\w+", script.read_text(encoding="utf-8")) if script.exists() else []
    lines = [f'inline constexpr const char* {name} = "";' for name in dict.fromkeys(names)]
    target = folder / "dem4grm" / "version.hpp"
    target.parent.mkdir(parents=True)
    target.write_text("\n".join(["#pragma once", "namespace dem {", *lines, "}", ""]), encoding="utf-8")


def library_flags() -> list[str]:
    flags = []
    for library in LIBRARIES:
        answer = subprocess.run(["pkg-config", "--cflags", library], capture_output=True, text=True, check=False)
        flags += answer.stdout.split()
    return [flag.replace("-I", "-isystem", 1) if flag.startswith("-I") else flag for flag in flags]


def compile_alone(header: Path, command: list[str]) -> str:
    """The compiler's complaint about one header; empty if there is none."""
    text = f'#include "{header}"\n#include "{header}"\n'
    answer = subprocess.run([*command, "-x", "c++", "-"], input=text, capture_output=True, text=True, check=False)
    return "" if answer.returncode == 0 else answer.stderr or "the compiler failed without a word"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    options = parser.parse_args()
    root = options.root.resolve()
    headers = sorted(file for folder in FOLDERS for file in (root / folder).rglob("*.hpp"))
    with tempfile.TemporaryDirectory() as generated, ThreadPoolExecutor(options.jobs) as pool:
        stand_in(root, Path(generated))
        places = [f"-I{root / 'src'}", f"-I{root / 'tests'}", f"-I{root / 'bench'}", f"-I{root / 'apps' / 'dem4grm'}"]
        names = [f'-DDEM_SOURCE_DIR="{root}"', '-DDEM_PROGRAM="dem4grm"']
        command = [options.compiler, *FLAGS, *places, f"-I{generated}", *library_flags(), *names]
        complaints = list(pool.map(lambda header: compile_alone(header, command), headers))
    n_failed = 0
    for header, complaint in zip(headers, complaints):
        if complaint:
            n_failed += 1
            print(f"{header.relative_to(root)}:1: does not compile alone")
            print("\n".join("    " + line for line in complaint.splitlines()[:6]))
    print(f"check_headers: {len(headers)} headers, {n_failed} violations")
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
