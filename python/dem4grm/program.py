# SPDX-License-Identifier: BSD-3-Clause
"""The command line program that belongs to this package."""
from __future__ import annotations

import os
import sys
from pathlib import Path

from .errors import MissingFileError


def program() -> Path:
    """The path of the program `dem4grm` that was built with this package. Campaigns start one process of it for each test.

    Raises MissingFileError when it was not installed with the package.
    """
    path = Path(__file__).with_name("dem4grm")
    if not os.access(path, os.X_OK):
        raise MissingFileError(f"{path}: the program was not installed with the package")
    return path


def main() -> None:
    """The command `dem4grm` of an installed package, and `python3 -m dem4grm`: `calibrate` is carried out here, since it needs Python;
    for everything else this process becomes the program."""
    if sys.argv[1:2] == ["calibrate"]:
        from .calibration.command import main as calibrate  # what it imports would slow every other command down
        sys.exit(calibrate(sys.argv[2:]))
    path = program()
    os.execv(path, [str(path), *sys.argv[1:]])
