#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the quick verification suite notice wrong laws? `tests/mutation/run_mutations.py [--faults] [--only TEXT] [--list]`.

Copies the sources to a temporary folder, builds them, and demands that `dem4grm verify --quick` passes. Then, one at a
time, puts each wrong version of mutations.toml into the copy, builds, and runs the suite until the first miss. Prints
what killed each; exit code 1 if one survives, 2 if the list does not fit the sources. About half an hour on two cores.
With --faults it does the same for faults.toml, planted in what keeps a run whole and its bits equal, and with the tests named there: a
quarter of an hour.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPIED = ["CMakeLists.txt", "CMakePresets.json", "cmake", "src", "apps", "tests", "cases", "LICENSE", "CITATION.cff"]
SUITE_LIMIT = 600  # s; a suite that hangs counts as killed


def read_mutations(text, name):
    """All edits with their files, in order; exits with 2 when one does not fit."""
    edits, misfits = [], []
    with open(pathlib.Path(__file__).with_name(name), "rb") as file:
        groups = tomllib.load(file)
    for group in groups.values():
        source = (ROOT / group["file"]).read_text(encoding="utf-8")
        for edit in group["edits"]:
            if source.count(edit["old"]) != 1:
                misfits.append(f"{group['file']}: '{edit['name']}': the text to replace occurs {source.count(edit['old'])} times")
            elif text in edit["name"] or text in group["file"]:
                edits.append({**edit, "file": group["file"], "program": group.get("program", "dem4grm"), "tests": group.get("tests", "")})
    if misfits:
        print("\n".join(misfits))
        sys.exit(2)
    return edits


def copy_sources(target):
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, target / name)
        elif (ROOT / name).exists():
            shutil.copy2(ROOT / name, target / name)


FUNCTION = re.compile(r"^(?:template .*\n)?(?:inline|constexpr|DEM_INLINE)[^;(=]*?(\w+)\(", re.MULTILINE)


def users_of(header):
    """Sources that call a function of the header, directly or through another header: the ones to compile again.

    Almost every source includes the laws by way of the simulation, but few call them; the build system cannot know.
    """
    sources = [path for folder in ("src", "apps") for path in (ROOT / folder).rglob("*.[ch]pp")]
    texts = {path: path.read_text(encoding="utf-8") for path in sources}
    headers = {ROOT / header}
    names = set(FUNCTION.findall(texts[ROOT / header]))
    while True:
        mentions = re.compile(r"\b(" + "|".join(names) + r")\b")
        found = {path for path in sources if path.suffix == ".hpp" and mentions.search(texts[path])}
        if found <= headers:
            return {path for path in sources if path.suffix == ".cpp" and mentions.search(texts[path])}
        headers |= found
        for path in found:
            names |= set(FUNCTION.findall(texts[path]))


def drop_objects(target, sources):
    for source in sources:
        for built in (target / "build").rglob(source.name + ".o"):
            built.unlink()


def build(target, program):
    done = subprocess.run(["cmake", "--build", str(target / "build"), "--parallel", str(os.cpu_count()), "--target", program],
                          capture_output=True, text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def failed_test(target, program, tests):
    """The first test that fails; None when all pass."""
    command = [str(target / "build/tests" / program), f"--gtest_filter={tests}", "--gtest_fail_fast"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SUITE_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return f"no end within {SUITE_LIMIT} s"
    if re.search(r"\b0 tests from", done.stdout):
        sys.exit(f"{program} has no test {tests}")
    failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
    return None if done.returncode == 0 else failed.group(1) if failed else f"ended with exit code {done.returncode}"


def first_miss(target, edit):
    """What the suite missed first; None when it passed."""
    if edit["tests"]:
        return failed_test(target, edit["program"], edit["tests"])
    command = [str(target / "build/apps/dem4grm/dem4grm"), "verify", "--quick", "--stop", "--json"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SUITE_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return f"no end within {SUITE_LIMIT} s"
    if done.returncode == 0:
        return None
    if done.returncode != 1:
        return f"ended with exit code {done.returncode}"
    missed = [c for c in json.loads(done.stdout) if not c["passed"]]
    return f"{missed[0]['case']}: {missed[0]['quantity']}"


def mutate(target, edit):
    """Verdict on one wrong version, and whether it survived."""
    path = target / edit["file"]
    right, times = path.read_text(encoding="utf-8"), path.stat()
    path.write_text(right.replace(edit["old"], edit["new"]), encoding="utf-8")
    users = users_of(edit["file"]) if path.suffix == ".hpp" else {path}
    drop_objects(target, users)
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    try:
        built, output = build(target, edit["program"])
        if not built:
            return "does not compile:\n" + output[-2000:], True
        miss = first_miss(target, edit)
        return ("SURVIVED", True) if miss is None else (miss, False)
    finally:
        path.write_text(right, encoding="utf-8")
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        drop_objects(target, users)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", metavar="TEXT", help="only those with this text in name or file")
    parser.add_argument("--list", action="store_true", help="names only; checks that the list fits the sources")
    parser.add_argument("--faults", action="store_true", help="the planted faults of faults.toml in place of the wrong laws")
    options = parser.parse_args()
    edits = read_mutations(options.only, "faults.toml" if options.faults else "mutations.toml")
    if options.list:
        print("\n".join(f"{e['file']}: {e['name']}" for e in edits))
        return 0
    survivors = 0
    with tempfile.TemporaryDirectory(prefix="mutations-") as folder:
        target = pathlib.Path(folder)
        copy_sources(target)
        subprocess.run(["cmake", "-S", folder, "-B", folder + "/build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        f"-DDEM4GRM_BUILD_TESTS={'ON' if options.faults else 'OFF'}", "-DDEM4GRM_WERROR=OFF", "-DDEM4GRM_KERNEL_TARGETS=plain", "-DCMAKE_CXX_FLAGS_RELEASE=-O1"],
                       stdout=subprocess.DEVNULL, check=True)
        for program, tests in sorted({(e["program"], e["tests"]) for e in edits}):
            built, output = build(target, program)
            if not built:
                sys.exit(output)
            miss = first_miss(target, {"program": program, "tests": tests})
            if miss is not None:
                sys.exit(f"the right version misses already: {miss}")
        for number, edit in enumerate(edits, 1):
            start = time.monotonic()
            verdict, survived = mutate(target, edit)
            survivors += survived
            print(f"{number:3} of {len(edits)}  {edit['name']:<44} {verdict}  ({time.monotonic() - start:.0f} s)", flush=True)
    print(f"{len(edits) - survivors} of {len(edits)} wrong versions noticed")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
