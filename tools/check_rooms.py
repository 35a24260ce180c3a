#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the library to its order of rooms: a file includes only from its own room or from rooms listed earlier.

The order is the one of `set(rooms ...)` in src/dem4grm/CMakeLists.txt and stands nowhere else. Exit code 1 if any
include breaks it; each violation is printed as file:line.
"""
import argparse
import re
import sys
from pathlib import Path

SOURCE_SUFFIXES = {".cpp", ".hpp", ".h", ".cu", ".cuh"}
GENERATED = {"dem4grm/version.hpp"}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^">]+)[">]', re.MULTILINE)


def read_rooms(library: Path) -> list[str]:
    text = re.sub(r"#.*", "", (library / "CMakeLists.txt").read_text(encoding="utf-8"))
    found = re.search(r"\bset\s*\(\s*rooms\s+([^)]*)\)", text)
    rooms = found.group(1).split() if found else []
    if not rooms:
        sys.exit(f"check_rooms: no set(rooms ...) in {library / 'CMakeLists.txt'}")
    return rooms


def blank_comments(text: str) -> str:
    """Replaces block comments by their line breaks, so that line numbers stay."""
    return re.sub(r"/\*.*?\*/", lambda found: "\n" * found.group().count("\n"), text, flags=re.DOTALL)


def judge(room: str, quote: str, path: str, rooms: list[str]) -> str | None:
    """What is wrong with one include of a file in `room`; None if nothing is."""
    if path in GENERATED:
        return None
    parts = path.split("/")
    if parts[0] != "dem4grm":
        if quote == '"':
            return f'"{path}": own headers are written "dem4grm/<room>/...", those of other libraries <...>'
        return None
    if len(parts) < 3:
        return f"{path}: not in any room"
    target = parts[1]
    if target not in rooms:
        return f"{path}: unknown room '{target}'"
    if rooms.index(target) > rooms.index(room):
        return f"{path}: room '{room}' comes before '{target}' and may not include from it"
    return None


def violations(root: Path) -> tuple[list[str], int]:
    library = root / "src" / "dem4grm"
    rooms = read_rooms(library)
    found, n_files = [], 0
    for file in sorted(path for path in library.rglob("*") if path.suffix in SOURCE_SUFFIXES):
        n_files += 1
        name = file.relative_to(root)
        inside = file.relative_to(library).parts
        if len(inside) < 2 or inside[0] not in rooms:
            found.append(f"{name}:1: lies in no room of src/dem4grm/CMakeLists.txt")
            continue
        text = blank_comments(file.read_text(encoding="utf-8"))
        for include in INCLUDE.finditer(text):
            problem = judge(inside[0], include.group(1), include.group(2), rooms)
            if problem:
                line = text.count("\n", 0, include.start()) + 1
                found.append(f"{name}:{line}: {problem}")
    return found, n_files


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root.resolve()
    found, n_files = violations(root)
    for line in found:
        print(line)
    print(f"check_rooms: {n_files} files, {len(found)} violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
