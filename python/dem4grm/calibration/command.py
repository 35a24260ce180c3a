# SPDX-License-Identifier: BSD-3-Clause
"""`python3 -m dem4grm calibrate`: the calibration desk from the shell."""
from __future__ import annotations

import argparse
import shlex
import signal
import sys
import threading
from typing import Any

from ..errors import Error
from . import Calibration, Desk, calibrate


class _Parser(argparse.ArgumentParser):
    def error(self, message: str):
        self.print_usage(sys.stderr)
        self.exit(64, f"{self.prog}: {message}\n")


def _positive(word: str) -> int:
    if not word.isdigit() or int(word) < 1:
        raise argparse.ArgumentTypeError(f"{word} is not a whole number above 0")
    return int(word)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="dem4grm calibrate", description="Fits parameters of a case to laboratory data; the same command goes on with "
                     "a calibration that was stopped.")
    parser.add_argument("desk", metavar="DESK.toml", help="stages, data, parameters: docs/how-to/calibrate.md")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="runs/<name of the desk> by default")
    parser.add_argument("-w", "--workers", type=_positive, default=1, metavar="N", help="trials at a time (1)")
    parser.add_argument("-t", "--threads", type=_positive, default=1, metavar="N", help="threads of each run (1)")
    parser.add_argument("--launcher", type=shlex.split, default=[], metavar="WORDS", help="starts each run elsewhere: \"srun -n1 -c4\"")
    parser.add_argument("--check", action="store_true", help="reads the desk, says how many runs it takes, runs nothing")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress")
    return parser


def _print_plan(desk: Desk) -> None:
    for stage in desk.stages:
        trials = stage.trials * stage.seeds + stage.replicates + stage.seeds * (2 if stage.full is not None else 1) + 2 * len(stage.parameters)
        keys = ", ".join(p.key for p in stage.parameters)
        print(f"{stage.name}: {len(stage.parameters)} parameters ({keys}), {len(stage.y)} values in {len(stage.series)} series, "
              f"{trials * len(stage.experiments)} runs")
    for prediction in desk.predictions:
        print(f"{prediction.name}: predicted, 1 run")


def _print_result(found: Calibration) -> None:
    for stage in found.result["stages"]:
        print(f"{stage['name']}: {stage['runs']} runs, chi-squared over values {stage['misfit_per_value']:.2f}")
        for p in stage["parameters"]:
            verdict = "not identified: " + p["why_not"] if not p["identified"] else f"at its {p['at_bound']} bound" if p["at_bound"] else ""
            interval = f"95 % [{p['interval_low']:.4g}, {p['interval_high']:.4g}]"
            print(f"  {p['key']:<28} {p['best']:10.4g}  {interval} {p['unit']}  {verdict}".rstrip())
    print(f"page  {found.path / 'calibration.html'}")


def main(words: list[str]) -> int:
    """Returns the exit code of the command line for the same mistake (docs/reference/command-line.md)."""
    options = _parser().parse_args(words)
    stop = threading.Event()
    best: dict[str, float] = {}

    def progress(stage: str, record: dict[str, Any], done: int, total: int) -> None:
        best[stage] = min(best.get(stage, float("inf")), record.get("misfit", float("inf")))
        if not options.quiet:
            sys.stderr.write(f"\r{stage}: trial {done} of {total}, smallest misfit {best[stage]:.4g}".ljust(78))
            sys.stderr.write("\n" if done == total else "")
            sys.stderr.flush()

    def end(number: int, _: object) -> None:
        stop.set()
        signal.signal(number, signal.SIG_DFL)  # whoever asks twice does not want to wait for checkpoints

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    try:
        desk = Desk.read(options.desk)
        _print_plan(desk)
        if not options.check:
            _print_result(calibrate(desk, options.output, workers=options.workers, threads=options.threads, progress=progress, stop=stop,
                                    launcher=options.launcher))
        return 0
    except Error as error:
        print(f"\n{error}" if stop.is_set() else error, file=sys.stderr)
        return 75 if error.exit_code == 130 else error.exit_code
