# SPDX-License-Identifier: BSD-3-Clause
"""The calibration desk: parameters of the model from laboratory data, in stages, with intervals (docs/how-to/calibrate.md)."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import MissingFileError
from ..runs import StopFlag
from .desk import Desk
from .result import Calibration

if TYPE_CHECKING:
    from .trials import Simulator

__all__ = ["Calibration", "Desk", "calibrate"]


def calibrate(desk: Desk | str | PathLike, folder: str | PathLike | None = None, *, workers: int = 1, threads: int = 1,
              progress: Callable[[str, dict[str, Any], int, int], bool | None] | None = None, stop: StopFlag | None = None,
              simulator: Simulator | None = None, page: bool = True, launcher: Sequence[str] = ()) -> Calibration:
    """Carries out a calibration, or goes on with one that was stopped or killed; no trial is run twice, and the result is the same.

    desk       a Desk, or the path of a desk file (docs/how-to/calibrate.md)
    folder     where everything is kept, "runs/<name of the file>" by default
    workers    trials at a time; the result does not depend on it
    threads    of each run
    progress   called with (stage, trial, trials done, trials of the stage) after each new trial; False stops the calibration
    stop       asked as stop.is_set(): a threading.Event that another thread may set
    simulator  another model in place of DEM4GRM: called as simulator(case, seed, series) from `workers` threads, it returns for each
               series (name, quantity, abscissa, x) an array of values at series.x, or of one value for a number
    page       writes the figures and calibration.html as well
    launcher   words before the command of each run, as ["srun", "-n1", "-c4"]: it starts the run somewhere, waits for it and ends with its
               exit code. That place must see `folder` under the same path

    Raises CaseError (every problem of the desk at once), MissingFileError, UsageError (the folder holds another desk's trials),
    FolderInUseError, Stopped, IoError; MissedError when too few trials succeed.
    """
    try:
        from .desk_run import DeskRun
        from .trials import StopOf
    except ImportError as error:
        raise MissingFileError(f"a calibration needs scikit-learn, SciPy and matplotlib (Debian: python3-sklearn, python3-matplotlib): "
                               f"{error}") from None
    read = desk if isinstance(desk, Desk) else Desk.read(desk)
    place = Path(folder) if folder is not None else Path("runs") / read.path.name
    tell = progress if progress is not None else lambda *_: None
    return DeskRun(read, place, max(1, workers), max(1, threads), simulator, StopOf(stop), tell, page, tuple(launcher)).run()
