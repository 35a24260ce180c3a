# SPDX-License-Identifier: BSD-3-Clause
"""DEM4GRM from Python: gravel-rubber mixtures by the discrete element method, and tests of one's own.

    import dem4grm

    case = dem4grm.Case.read("cases/quick.toml")
    case["shear.displacement"] = "4 mm"
    test = dem4grm.run(case, "runs/quick-4mm", progress=dem4grm.print_progress)
    test.shear.plot(x="displacement_mm", y="shear_stress_kPa")

Everything is done by the library that the command line is made of: the same checks, messages, files and bits. Quantities of
functions and of live objects are in SI units; tables of finished tests have the units of their columns' names, as the files have.
docs/how-to/python.md goes from the first line to the picture.
"""
import os as _os

# The OpenMP runtime reads its limit for waiting threads once, when it is loaded. Threads that wait for milliseconds hold the
# processors that others need; the command line sets the same limit (docs/decisions/0008-waiting-threads.md).
if "OMP_WAIT_POLICY" not in _os.environ:
    _os.environ.setdefault("GOMP_SPINCOUNT", "10000")

from . import _core, micro  # noqa: E402
from ._core import Progress  # noqa: E402
from .calibration import Calibration, Desk, calibrate  # noqa: E402
from .campaigns import Campaign, Study  # noqa: E402
from .cases import Case  # noqa: E402
from .errors import (  # noqa: E402
    CaseError, Error, FolderInUseError, InternalError, IoError, MissedError, MissingFileError, OutOfMemoryError, PhysicsError,
    Stopped, UsageError)
from .folders import State, Test, open  # noqa: E402, A004  # pylint: disable=redefined-builtin
from .program import program  # noqa: E402
from .runs import print_progress, run  # noqa: E402
from .simulation import Material, Simulation  # noqa: E402
from .verification import verification_cases, verify  # noqa: E402

if _os.environ.get("DEM4GRM_TARGET"):  # as the command line: other loops than the best ones, with the same bits
    _core.choose_kernel_target(_os.environ["DEM4GRM_TARGET"])

__version__ = _core.version
__commit__ = _core.commit

__all__ = [
    "Calibration", "Campaign", "Case", "CaseError", "Desk", "Error", "FolderInUseError", "InternalError", "IoError", "Material",
    "MissedError", "MissingFileError", "OutOfMemoryError", "PhysicsError", "Progress", "Simulation", "State", "Stopped", "Study", "Test",
    "UsageError", "calibrate", "micro", "open", "print_progress", "program", "run", "verification_cases", "verify",
]
