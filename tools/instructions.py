#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reads compiled code of x86-64 for three properties that no source shows and no result of a test does.

    instructions.py fused FILE...          no fused multiply-add, which the floating-point rules forbid
    instructions.py lanes FILE NAME...     functions that work in vector registers, as their loops over lanes ask for
    instructions.py own SPACE FILE...      object files whose code all belongs to the namespace SPACE

FILE is an object file, library or program. A fused a*b + c rounds once, so a build with one gives other bits than a build
without (cmake/FloatingPoint.cmake). A loop over lanes that the compiler leaves scalar, in silence, is three to five times
slower: of the double arithmetic of every function whose name contains NAME at least two thirds must be on vectors.
Functions with fewer than 50 such instructions, which only lead to a loop, are passed over. An inline function of a
common header that the compiler did not inline into a file for a newer processor is a weak symbol there; the linker may
take it for the whole program, which then ends with an illegal instruction on an older processor.

Exit code 0: as it should be, 1: not, and the functions are named, 2: a file cannot be read, 64: wrong usage.
"""
import re
import subprocess
import sys
from collections import Counter

FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")
FUSED = re.compile(r"\svfn?m(add|sub|addsub|subadd)\d*[ps][sd]\s")
ARITHMETIC = re.compile(r"\sv?(?:add|sub|mul|div|sqrt)([sp])d\s")
LEAST_IN_VECTORS = 2.0 / 3.0
FEWEST = 50


def functions(path):
    """Pairs (name, instruction lines) of a file."""
    try:
        listing = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", path], capture_output=True, text=True)
    except OSError as error:
        print(f"instructions: {error}", file=sys.stderr)
        sys.exit(2)
    if listing.returncode != 0:
        print(f"instructions: {listing.stderr.strip()}", file=sys.stderr)
        sys.exit(2)
    name, lines = "", []
    for line in listing.stdout.splitlines():
        head = FUNCTION.match(line)
        if head:
            yield name, lines
            name, lines = head.group(1), []
        else:
            lines.append(line)
    yield name, lines


def report_fused(paths):
    found = [(path, name) for path in paths
             for name in sorted({name for name, lines in functions(path) if any(map(FUSED.search, lines))})]
    for path, name in found:
        print(f"{path}: fused multiply-add in {name}")
    print(f"instructions: {len(paths)} files, {len(found)} functions with fused instructions")
    return 1 if found else 0


def report_lanes(path, names):
    failures = 0
    seen = Counter()
    for function, lines in functions(path):
        for name in names:
            if name not in function:
                continue
            kinds = Counter(hit.group(1) for hit in map(ARITHMETIC.search, lines) if hit)
            if kinds.total() < FEWEST:
                continue
            seen[name] += 1
            if kinds["p"] < LEAST_IN_VECTORS * (kinds["p"] + kinds["s"]):
                print(f"{path}: {kinds['s']} operations on single numbers, {kinds['p']} on vectors in {function}")
                failures += 1
    for name in names:
        if seen[name] == 0:
            print(f"{path}: no function with arithmetic has '{name}' in its name")
            failures += 1
    print(f"instructions: {sum(seen.values())} functions looked at, {failures} complaints")
    return 1 if failures else 0


def report_own(space, paths):
    found = []
    for path in paths:
        listing = subprocess.run(["nm", "-C", "--defined-only", path], capture_output=True, text=True)
        if listing.returncode != 0:
            print(f"instructions: {listing.stderr.strip()}", file=sys.stderr)
            sys.exit(2)
        for line in listing.stdout.splitlines():
            _, kind, name = line.split(maxsplit=2)
            if kind in "TWi" and space not in name:
                found.append(f"{path}: {name}")
    print("\n".join(found + [f"instructions: {len(paths)} files, {len(found)} functions outside {space}"]))
    return 1 if found else 0


def main():
    words = sys.argv[1:]
    if len(words) >= 2 and words[0] == "fused":
        return report_fused(words[1:])
    if len(words) >= 3 and words[0] == "lanes":
        return report_lanes(words[1], words[2:])
    if len(words) >= 3 and words[0] == "own":
        return report_own(words[1], words[2:])
    print(__doc__, file=sys.stderr)
    return 64


if __name__ == "__main__":
    sys.exit(main())
