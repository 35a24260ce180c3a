# SPDX-License-Identifier: BSD-3-Clause
"""The verification suite from Python."""
from __future__ import annotations

import json
from collections.abc import Callable, Iterable

import pandas

from . import _core


def verification_cases() -> pandas.DataFrame:
    """The cases of the suite: name, title, is_quick."""
    return pandas.DataFrame(_core.verification_cases(), columns=["name", "title", "is_quick"])


def verify(only: str | Iterable[str] | None = None, *, quick: bool = True, threads: int | None = None,
           progress: Callable[[str], None] | None = None) -> pandas.DataFrame:
    """Holds the engine against numbers that this project did not make, like `dem4grm verify`.

    only      name of a case, or several; by default all of the quick ones, or with quick=False all
    progress  called with the name of each case before it runs

    Returns one row a checked quantity: case, quantity, unit, expected, obtained, error, tolerance, comparison, passed, source.
    `attrs["missed"]` counts those that did not pass. Raises UsageError for an unknown name.
    """
    if only is None:
        names = [name for name, _, is_quick in _core.verification_cases() if is_quick or not quick]
    else:
        names = [only] if isinstance(only, str) else list(only)
    rows = []
    for name in names:
        if progress is not None:
            progress(name)
        rows += json.loads(_core.verify_case(name, threads or _core.processors()))
    table = pandas.DataFrame(rows)
    table.attrs["missed"] = int((~table["passed"]).sum()) if len(table) else 0
    return table
