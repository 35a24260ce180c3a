#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What running a case from Python costs over the command line: `bench/python_overhead.py BUILD_FOLDER [--case CASE] [--repeats N]`.

Runs the case by `dem4grm run` and by `dem4grm.run` with a progress callback in turn, each in a process of its own, and compares the
processor time that the processes took (user and system, of all threads): on a machine with other work it says more than the clock.
The time of Python holds its start and all imports. Also compares the state hashes. The decision 0028-python-package.md quotes it.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CODE = """import dem4grm, sys
calls = []
dem4grm.run(sys.argv[1], sys.argv[2], threads=int(sys.argv[3]), progress=calls.append, message=None)
print(len(calls))
"""


def processor_time(command, environment):
    """(seconds of processor time, what was printed)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    answer = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, answer.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--case", type=Path, default=ROOT / "cases" / "quick.toml")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=1)
    options = parser.parse_args()
    package = options.build.resolve() / "python"
    environment = {**os.environ, "PYTHONPATH": str(package)}
    totals, hashes = {"command line": 0.0, "Python": 0.0}, set()
    with tempfile.TemporaryDirectory() as folder:
        for k in range(options.repeats):
            out = {name: Path(folder) / f"{name[0]}{k}" for name in totals}
            threads = str(options.threads)
            commands = {
                "command line": [package / "dem4grm" / "dem4grm", "run", options.case, "-o", out["command line"], "-q", "-j", threads],
                "Python": [sys.executable, "-c", CODE, options.case, out["Python"], threads],
            }
            for name, command in commands.items():
                seconds, printed = processor_time([str(word) for word in command], environment)
                totals[name] += seconds
                hashes.add(json.loads((out[name] / "summary.json").read_text(encoding="utf-8"))["state_hash"])
                print(f"{name:<13} {seconds:8.2f} s{f', {printed.strip()} calls of the callback' if printed else ''}", flush=True)
    print(f"Python over command line: {100 * (totals['Python'] / totals['command line'] - 1):+.2f} % of processor time")
    print(f"state hashes: {', '.join(sorted(hashes))}")
    return 0 if len(hashes) == 1 else 1


if __name__ == "__main__":
    sys.exit(main())
