# SPDX-License-Identifier: BSD-3-Clause
"""Runs a whole desk in its folder: stages in order, predictions, files of the result."""
from __future__ import annotations

import fcntl
import json
import os
import socket
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy
import pandas

from ..errors import FolderInUseError, IoError, Stopped, UsageError
from .desk import Desk, Prediction, Stage, with_changes
from .figures import draw_stage
from .fitting import Fit, fit_stage
from .page import write_page
from .result import Calibration, stage_result, trial_table
from .trials import Bench, Simulator, StopOf, TrialStore, run_program


class _Lock:
    """One process at a time works in a folder; the lock goes with the process, however it ends."""

    def __init__(self, folder: Path):
        path = folder / "calibration.lock"
        self._file = open(path, "a+", encoding="utf-8")  # noqa: SIM115  # pylint: disable=consider-using-with
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.seek(0)
            holder = self._file.read().strip()
            self._file.close()
            raise FolderInUseError(f"{folder}: another calibration works here ({holder})") from None
        self._file.truncate(0)
        self._file.write(f"host {socket.gethostname()}, process {os.getpid()}")
        self._file.flush()

    def __enter__(self) -> _Lock:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _claim(folder: Path, desk: Desk) -> None:
    """The folder belongs to one desk: trials of another must not be taken for its own."""
    record = folder / "desk.json"
    if record.exists():
        known = json.loads(record.read_text(encoding="utf-8"))
        if known["digest"] != desk.digest:
            raise UsageError(f"{folder}: holds the calibration of another desk, or of this one before it, its cases or its data were "
                             "changed; give another folder with -o")
    else:
        record.write_text(json.dumps({"name": desk.name, "digest": desk.digest}, indent=1) + "\n", encoding="utf-8")


def folder_name(number: int, name: str) -> str:
    return f"{number + 1}-" + "".join(c if c.isalnum() else "-" for c in name.lower()).strip("-")


class DeskRun:
    """Carries a desk out. `tell` gets (stage, record, trials done, trials in all) after each trial."""

    def __init__(self, desk: Desk, folder: Path, workers: int, threads: int, simulator: Simulator | None, stop: StopOf,
                 tell: Callable[[str, dict[str, Any], int, int], bool | None], with_page: bool = True, launcher: Sequence[str] = ()):
        self._with_page, self._launcher = with_page, launcher
        self._desk, self._folder, self._workers, self._threads = desk, folder, workers, threads
        self._simulator, self._stop, self._tell = simulator, stop, tell

    def run(self) -> Calibration:
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            with _Lock(self._folder):
                _claim(self._folder, self._desk)
                return self._run()
        except OSError as error:
            if isinstance(error, (FolderInUseError, IoError)) or error.errno is None:
                raise
            raise IoError(f"{error.filename or self._folder}: {error.strerror}") from None

    def _run(self) -> Calibration:
        found: dict[str, Any] = {}
        fits: list[Fit] = []
        stages = []
        for number, stage in enumerate(self._desk.stages):
            folder = self._folder / folder_name(number, stage.name)
            folder.mkdir(exist_ok=True)
            fit = self._fit(stage, {key: found[key] for key in stage.given}, folder)
            found.update(fit.values)
            fits.append(fit)
            trial_table(fit).to_csv(folder / "trials.csv", index=False)
            columns = {p.key: p.value(fit.points[:, k]) for k, p in enumerate(stage.parameters)}
            pandas.DataFrame(columns).to_csv(folder / "samples.csv", index=False)
            if self._with_page:
                draw_stage(fit, folder)
            stages.append({"folder": folder.name, **stage_result(fit)})
        predictions = [self._predict(p, found) for p in self._desk.predictions]
        result = {"name": self._desk.name, "digest": self._desk.digest, "stages": stages, "predictions": predictions}
        temporary = self._folder / "result.json.part"
        temporary.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
        temporary.replace(self._folder / "result.json")
        if self._with_page:
            write_page(self._folder, result, fits)
        return Calibration(self._folder)

    def _fit(self, stage: Stage, given: dict[str, Any], folder: Path) -> Fit:
        store = TrialStore(folder / "trials.jsonl")
        total = stage.trials * stage.seeds + stage.replicates + stage.seeds * (2 if stage.full is not None else 1) + 2 * len(stage.parameters)

        def tell(record: dict[str, Any]) -> bool | None:
            return self._tell(stage.name, record, len(store.records), total)

        bench = Bench(stage, given, store, folder / "runs", self._workers, self._threads, self._simulator, self._stop, tell,
                      self._launcher)
        return fit_stage(stage, given, bench, store, folder)

    def _predict(self, prediction: Prediction, found: dict[str, Any]) -> dict[str, Any]:
        """Runs a test with what was found. Keys that its case does not have, or sets itself, are left out by the case's own rules."""
        if self._stop.is_set():
            raise Stopped("the calibration was stopped; the same command goes on")
        base = prediction.experiment.case
        case = with_changes(base, {key: value for key, value in found.items() if key in base and key not in base.changes})
        folder = self._folder / "predictions" / folder_name(0, prediction.name).removeprefix("1-")
        if self._simulator is None:
            curves, _ = run_program(case, folder, prediction.series, self._threads, self._stop, True, self._launcher)
        else:
            curves = list(self._simulator(case, int(case.si("seed") or 0) if "seed" in case else 0, prediction.series))
        data = []
        for series, curve in zip(prediction.series, curves):
            error = numpy.hypot(series.error, series.common)
            finite = numpy.isfinite(curve)
            misfit = float((((curve - series.y) / error)[finite]**2).mean()) if finite.any() else None
            data.append({"name": series.name, "quantity": series.quantity, "x_quantity": series.abscissa, "x": series.x.tolist(),
                         "measured": series.y.tolist(), "error": error.tolist(),
                         "predicted": [float(v) if ok else None for v, ok in zip(curve, finite)], "misfit_per_value": misfit})
        return {"name": prediction.name, "folder": str(folder.relative_to(self._folder)), "data": data}
