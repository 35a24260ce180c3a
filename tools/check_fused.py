#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Looks for fused multiply-add instructions in compiled code, where the floating-point rules forbid them.

    check_fused.py FILE...     object files, libraries or programs

A fused a*b + c rounds once, so a build with one gives other bits than a build without (cmake/FloatingPoint.cmake).
Exit code 0: none, 1: some are there and their functions are named, 2: objdump could not read a file.
"""
import re
import subprocess
import sys

FUSED = re.compile(r"\svfn?m(add|sub|addsub|subadd)\d*[ps][sd]\s")
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")


def fused_functions(path):
    """Names of the functions of a file that hold a fused instruction."""
    listing = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", path], capture_output=True, text=True)
    if listing.returncode != 0:
        sys.exit(f"check_fused: {listing.stderr.strip()}" or 2)
    function, found = "", set()
    for line in listing.stdout.splitlines():
        name = FUNCTION.match(line)
        if name:
            function = name.group(1)
        elif FUSED.search(line):
            found.add(function)
    return sorted(found)


def main():
    failures = 0
    for path in sys.argv[1:]:
        for function in fused_functions(path):
            print(f"{path}: fused multiply-add in {function}")
            failures += 1
    print(f"check_fused: {len(sys.argv) - 1} files, {failures} functions with fused instructions")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
