#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills a small test again and again at random moments of all its stages: `tools/kill_study.py PROGRAM [--kills 200]`.

One run goes straight; others are killed by SIGKILL after a random time, again and again, with one or two threads in turn, until
they end. Their state hashes, CSV files and states must be those of the first, and no checkpoint may be lost or unreadable:
a part that could not go on from where the last left off counts as a failure. Prints the stages in which the kills fell. Exit
code 1 after a failure.
"""
import argparse
import collections
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

FILES = ("shear.csv", "micro.csv", "walls.csv", "profiles.csv")


CASE = pathlib.Path(__file__).resolve().parent.parent / "cases/studies/small-box.toml"
SETTINGS = ("specimen.rubber_content=0.05", "shear.displacement=0.4 mm", "recording.frame_interval=0.1 mm")  # some seconds


def words(program, folder, threads):
    settings = [word for setting in SETTINGS for word in ("--set", setting)]
    return [program, "run", CASE, "-q", "-o", folder, "-j", str(threads), *settings]


def hash_of(folder):
    return json.loads((folder / "summary.json").read_text())["state_hash"]


def last_stage(log):
    named = re.findall(r"info: stage (.*?)(?:,|$)", log.read_text(), re.MULTILINE) if log.exists() else []
    return named[-1] if named else "before the first stage"


def one_run(program, folder, rng, mean, stages):
    """Kills until the run ends by itself; the number of kills and what went wrong."""
    kills, problems = 0, []
    while not (folder / "summary.json").exists():
        process = subprocess.Popen(words(program, folder, 1 + kills % 2), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            code = process.wait(rng.expovariate(1.0 / mean))
        except subprocess.TimeoutExpired:
            process.kill()
            code = process.wait()
            kills += 1
            stages[last_stage(folder / "run.log")] += 1
        text = process.stderr.read()
        if code not in (0, -9) or "damaged" in text or "cannot be read" in text:
            problems.append(f"exit code {code}: {text[-300:]}")
        if code not in (0, -9):
            break
    # A kill may fall between the summary and the report: the same command once more writes what is missing, and leaves no draft.
    again = subprocess.run(words(program, folder, 1), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if not problems and again.returncode != 0:
        problems.append(f"once more: exit code {again.returncode}: {again.stderr[-300:]}")
    if not problems and not (folder / "report.html").exists():
        problems.append("once more: no report")
    return kills, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="dem4grm")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng, stages, kills, runs, problems = random.Random(options.seed), collections.Counter(), 0, 0, []
    program = options.program.resolve()
    with tempfile.TemporaryDirectory(prefix="kills-") as place:
        straight = pathlib.Path(place) / "straight"
        start = time.monotonic()
        subprocess.run(words(program, straight, 1), check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        whole = time.monotonic() - start
        while kills < options.kills and not problems:
            folder = pathlib.Path(place) / f"run{runs}"
            # Stages keep a checkpoint at their ends: a mean time far below the longest stage would never get past it.
            more, problems = one_run(program, folder, rng, whole * rng.uniform(0.3, 1.0), stages)
            kills, runs = kills + more, runs + 1
            if problems:
                break
            if hash_of(folder) != hash_of(straight):
                problems.append(f"run {runs}: another state hash")
            problems += [f"run {runs}: another {name}" for name in FILES if (folder / name).read_bytes() != (straight / name).read_bytes()]
            problems += [f"run {runs}: {draft.name} is left" for end in ("*.tmp", "*.part") for draft in folder.rglob(end)]
    print(f"{kills} kills in {runs} runs of {whole:.1f} s: " + ("; ".join(problems) if problems else "all ended with the same bits"))
    print("stages: " + ", ".join(f"{name} {count}" for name, count in stages.most_common()))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
