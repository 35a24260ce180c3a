# SPDX-License-Identifier: BSD-3-Clause
"""Runs a case into its folder."""
from __future__ import annotations

import logging
import sys
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Protocol

from . import _core
from .cases import Case
from .folders import Test

_log = logging.getLogger("dem4grm")


class StopFlag(Protocol):
    """What can be asked whether to stop: a threading.Event is one."""

    def is_set(self) -> bool: ...


def print_progress(now: _core.Progress) -> None:
    """A progress callback that keeps one line on stderr."""
    words = [now.stage]
    if now.fraction >= 0.0:
        words.append(f"{100.0 * now.fraction:.1f} %")
    if now.displacement > 0.0:
        words.append(f"{now.displacement * 1e3:.3f} mm  tau {now.shear_stress / 1e3:.1f} kPa")
    if now.seconds_left is not None:
        words.append(f"{now.seconds_left:.0f} s left")
    sys.stderr.write("\r" + "  ".join(words).ljust(78))
    if now.stage in ("shear", "compression") and now.fraction >= 1.0:
        sys.stderr.write("\n")
    sys.stderr.flush()


def _tell(text: str, is_warning: bool) -> None:
    _log.log(logging.WARNING if is_warning else logging.INFO, "%s", text)


def run(case: Case | str | PathLike, folder: str | PathLike | None = None, *, threads: int | None = None,
        progress: Callable[[_core.Progress], bool | None] | None = None, interval: float = 0.2,
        message: Callable[[str, bool], None] | None = _tell, stop: StopFlag | None = None,
        store: str | PathLike | None = None, specimen: str | PathLike | None = None,
        source: str | PathLike | None = None, specimen_only: bool = False, checkpoint_interval: float = 600.0,
        max_hours: float | None = None) -> Test:
    """Runs a case, or goes on with it, or opens its finished folder; the files and bits of `dem4grm run`.

    case           a Case, or the path of a case file
    folder         of the run, "runs/<name of the case>" by default
    threads        as many as pay off by default; any number gives the same bits
    progress       called with a Progress (SI units) at most every `interval` seconds (0: at every report) and at every new stage,
                   in the thread that called run; the run waits meanwhile. It stops the run when it returns False
    message        called with (text, is_warning); by default the logger "dem4grm" gets it
    stop           asked about twenty times a second, as `stop.is_set()`: a threading.Event that another thread may set
    store          folder in which preparations find each other's states
    specimen       a finished specimen to start from, or its folder
    source         a stored state of another test to start from, as `--from`: its folder, or a file in it. The case is that of the source
                   but for what may still change there: case = source_test.case; case["shear.normal_stress"] = "75 kPa"
    specimen_only  prepares the specimen and stops before shear
    checkpoint_interval   seconds of wall time between two checkpoints
    max_hours      stops with a checkpoint after that time

    Returns the folder as a Test. However a run is stopped, it first writes a checkpoint, and the same call or `dem4grm run` goes on
    from it with the same bits; a grain compression alone keeps none and starts anew. Then it raises:
      Stopped              progress returned False, stop was set, or the time is up
      KeyboardInterrupt    Ctrl-C in the main thread
      what progress or message raised
    Other errors: CaseError, MissingFileError, UsageError (the folder holds another case), FolderInUseError, IoError, PhysicsError,
    OutOfMemoryError. The lock of the interpreter is released while the test steps: other threads of Python go on.
    """
    if not isinstance(case, Case):
        case = Case.read(case)
    place = Path(folder) if folder is not None else _core.default_folder(case.name)
    for text in case.warnings:
        if message is not None:
            message(text, True)
    try:
        _, was_complete = _core.run_case(
            case._loaded, place, threads=threads or 0, progress=progress, interval=interval, message=message, stop=stop,
            store=store or "", specimen=specimen or "", source=source or "",
            is_specimen_only=specimen_only, checkpoint_interval=checkpoint_interval, most_hours=max_hours or 0.0)
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt) and hasattr(error, "add_note"):
            error.add_note(f"{place}: stopped with a checkpoint; the same call goes on")
        raise
    return Test(place, was_complete=was_complete)
