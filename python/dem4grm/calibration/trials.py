# SPDX-License-Identifier: BSD-3-Clause
"""Trials: run several at a time, kept one by one on disk, so that a killed calibration goes on without repeating any."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from ..cases import Case
from ..errors import CaseError, IoError, MissedError, PhysicsError, Stopped, error_of
from ..folders import Test
from ..program import program
from ..runs import StopFlag, run
from .data import Series, at
from .desk import Experiment, Stage, with_changes

Simulator = Callable[[Case, int, Sequence[Series]], Sequence[NDArray]]


class StopOf:
    """Set by the calibration itself, or by a flag of the caller, which is only read."""

    def __init__(self, other: StopFlag | None = None):
        self._own, self._other = threading.Event(), other

    def set(self) -> None:
        self._own.set()

    def is_set(self) -> bool:
        return self._own.is_set() or (self._other is not None and self._other.is_set())


@dataclass(frozen=True)
class Job:
    """One trial: a point of a stage with one seed. Points count from 0 in the order in which they were proposed."""

    point: int
    number: int  # of the seed at this point
    role: str  # design, search, replicate, best, full
    position: tuple[float, ...]


class TrialStore:
    """Lines of JSON, one a trial, each written to disk before the next is begun. A line that a kill cut short is left out and run again."""

    def __init__(self, path: Path):
        self._path, self._lock = path, threading.Lock()
        self.records: dict[tuple[str, int, int], dict[str, Any]] = {}
        kept = b""
        for line in path.read_bytes().splitlines(keepends=True) if path.exists() else []:
            try:
                record = json.loads(line) if line.endswith(b"\n") else None
            except ValueError:
                record = None
            if record is None:
                break
            kept += line
            self.records[(record["kind"], record["point"], record["number"])] = record
        if path.exists() and len(kept) != path.stat().st_size:
            temporary = path.with_suffix(".part")
            temporary.write_bytes(kept)
            temporary.replace(path)

    def add(self, record: dict[str, Any]) -> None:
        line = json.dumps(record) + "\n"
        with self._lock:
            with open(self._path, "a", encoding="utf-8") as file:
                file.write(line)
                file.flush()
                os.fsync(file.fileno())
            self.records[(record["kind"], record["point"], record["number"])] = record

    def trials(self) -> list[dict[str, Any]]:
        """In the order of points and seeds, whatever order they ended in."""
        return [record for key, record in sorted(self.records.items()) if key[0] == "trial"]


def run_elsewhere(case: Case, folder: Path, launcher: Sequence[str], threads: int, stop: StopFlag) -> Test:
    """As run, by a process of the command line program that the words of a launcher start, such as srun, and wait for.

    Raises what run raises; IoError when the launcher itself cannot be started.
    """
    folder.parent.mkdir(parents=True, exist_ok=True)
    file = folder.with_name(folder.name + ".toml")
    case.write(file)
    command = [*launcher, str(program()), "run", str(file), "-o", str(folder), "-j", str(threads), "-q", "--no-report"]
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        raise IoError(f"{launcher[0]}: cannot be started: {error.strerror}") from None
    was_stopped = False
    while True:
        if stop.is_set() and not was_stopped:
            was_stopped = True
            process.terminate()
        try:
            _, said = process.communicate(timeout=0.5)
            break
        except subprocess.TimeoutExpired:
            pass
    if process.returncode == 0:
        file.unlink()
        return Test(folder)
    if was_stopped or process.returncode == Stopped.exit_code:
        raise Stopped(f"{folder}: stopped; the same call goes on")
    raise error_of(process.returncode, said.strip() or f"{' '.join(command)}: ended with {process.returncode}", [])


def run_program(case: Case, folder: Path, series: Sequence[Series], threads: int, stop: StopFlag, keep: bool,
                launcher: Sequence[str] = ()) -> tuple[list[NDArray], str]:
    """Runs a case, or goes on with it, and reads what the data are compared with."""
    if launcher:
        test = run_elsewhere(case, folder, launcher, threads, stop)
    else:
        test = run(case, folder, threads=threads, message=None, stop=stop)
    table = test.compression if case.test == "grain_compression" else test.shear
    found = []
    for item in series:
        if item.is_number:
            value = test.summary.get(item.quantity)
            if value is None:
                raise PhysicsError(f"{folder}: the test found no {item.quantity}")
            found.append(numpy.array([float(value)]))
        else:
            found.append(at(item.x, table[item.abscissa].to_numpy(), table[item.quantity].to_numpy()))
    state_hash = test.state_hash
    if not keep:
        shutil.rmtree(folder)
    return found, state_hash


class Bench:
    """Carries out the jobs of a stage that are not in its store.

    simulator   None for DEM4GRM itself; else called as simulator(case, seed, series), from several threads
    launcher    words before the command of each run; none: runs within this process
    tell        called with each record that is new, in the calling thread; stops the calibration when it returns False
    """

    def __init__(self, stage: Stage, given: dict[str, Any], store: TrialStore, folder: Path, workers: int, threads: int,
                 simulator: Simulator | None, stop: StopOf, tell: Callable[[dict[str, Any]], bool | None], launcher: Sequence[str] = ()):
        self._launcher = launcher
        self._stage, self._given, self._store, self._folder = stage, given, store, folder
        self._workers, self._threads, self._simulator = workers, threads, simulator
        self._stop, self._tell = stop, tell

    def case(self, experiment: Experiment, position: Sequence[float], is_full: bool, seed: int) -> Case:
        changes = {**self._given, **self._stage.texts(numpy.array(position))}
        if is_full:
            changes.update(self._stage.full or {})
        if experiment.case.test == "direct_shear":
            changes["seed"] = seed
        return with_changes(experiment.case, changes)

    def _simulate(self, job: Job) -> dict[str, Any]:
        stage = self._stage
        seed = stage.seed + 200 * job.point + job.number
        record: dict[str, Any] = {"kind": "trial", "point": job.point, "number": job.number, "role": job.role, "seed": seed,
                                  "position": list(job.position), "values": stage.texts(numpy.array(job.position))}
        parts: list[Any] = [None] * len(stage.series)
        hashes = []
        try:
            for k, experiment in enumerate(stage.experiments):
                if self._stop.is_set():
                    raise Stopped("the calibration was stopped; the same command goes on")
                mine = [j for j, series in enumerate(stage.series) if series.test == k]
                case = self.case(experiment, job.position, job.role == "full", seed)
                asked = [stage.series[j] for j in mine]
                if self._simulator is None:
                    # Runs that this kill or stop interrupts go on from their checkpoint: their folder has a name of its own.
                    folder = self._folder / f"{job.role}-{job.point}-{job.number}-{k}"
                    curves, state_hash = run_program(case, folder, asked, self._threads, self._stop, job.role in ("best", "full"), self._launcher)
                    hashes.append(state_hash)
                else:
                    curves = list(self._simulator(case, seed, asked))
                for j, curve in zip(mine, curves):
                    parts[j] = numpy.asarray(curve, dtype=float)
            values = numpy.concatenate(parts)
            if values.shape != stage.y.shape or not numpy.isfinite(values).all():
                names = ", ".join(s.name for s, part in zip(stage.series, parts) if not numpy.isfinite(part).all()) or "all"
                raise PhysicsError(f"no value at some abscissae of: {names}; the simulated test ends before the data do")
            residual = values - stage.y
            record["misfit"] = float(residual @ numpy.linalg.solve(stage.covariance(), residual))
            record["curves"] = [part.tolist() for part in parts]
            record["state_hashes"] = hashes
        except (PhysicsError, CaseError) as error:
            record["failure"] = str(error).splitlines()[0]
        return record

    def do(self, jobs: Sequence[Job]) -> list[dict[str, Any]]:
        """Records of the jobs, in their order. Raises Stopped, or what a run raised that no other values would have spared."""
        left = [job for job in jobs if ("trial", job.point, job.number) not in self._store.records]
        error: BaseException | None = None
        with ThreadPoolExecutor(self._workers) as pool:
            waiting = {pool.submit(self._simulate, job) for job in left}
            try:
                while waiting:
                    done, waiting = wait(waiting, timeout=0.5, return_when=FIRST_COMPLETED)
                    for future in done:
                        if future.cancelled():
                            continue
                        if future.exception() is not None:
                            error = error or future.exception()
                            self._stop_others(waiting)
                            continue
                        self._store.add(future.result())
                        if self._tell(future.result()) is False:
                            error = error or Stopped("the calibration was stopped; the same command goes on")
                            self._stop_others(waiting)
            except BaseException:
                self._stop_others(waiting)
                raise
        if error is not None:
            raise error
        return [self._store.records[("trial", job.point, job.number)] for job in jobs]

    def _stop_others(self, waiting) -> None:
        self._stop.set()
        for future in waiting:
            future.cancel()


def values_of(record: dict[str, Any]) -> NDArray:
    """All values of a trial, one series after the other."""
    return numpy.concatenate([numpy.array(part) for part in record["curves"]])


def require_successes(records: Sequence[dict[str, Any]], least: int, stage: Stage) -> None:
    good = [r for r in records if "failure" not in r]
    if len(good) < least:
        cause = next((r["failure"] for r in records if "failure" in r), "")
        raise MissedError(f"stage \"{stage.name}\": {len(good)} of {len(records)} trials succeeded, {least} are needed; the first "
                          f"failure: {cause}")
