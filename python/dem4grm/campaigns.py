# SPDX-License-Identifier: BSD-3-Clause
"""Studies and campaigns on this machine."""
from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import pandas

from . import _core
from .cases import Case
from .errors import MissedError
from .folders import Test
from .program import program
from .runs import StopFlag


class Study:
    """A case and the keys that its tests differ in (docs/reference/study-file.md).

        study = Study("cases/studies/quick.toml")
        study.plan()                                    # hours, memory, disk
        campaign = study.run("runs/quick-study")
        campaign.collect().envelopes
    """

    def __init__(self, path: str | PathLike):
        """Raises MissingFileError, and CaseError with every problem of the study and of its cases."""
        self.path = Path(path)
        self._study = _core.load_study(self.path)

    @property
    def name(self) -> str:
        return self._study.name

    @property
    def tests(self) -> list[str]:
        """Names of the tests in the order of the study."""
        return self._study.tests

    @property
    def warnings(self) -> list[str]:
        return self._study.warnings

    def case(self, test: str) -> Case:
        """The complete case of a test. Raises KeyError."""
        return Case(self._study.case(test).resolved_toml, f"{test}.toml")

    def plan(self, *, workers: int = 0, threads: int = 0, memory: float = 0.0) -> dict[str, Any]:
        """What the study takes here, from a trial of some seconds, like `dem4grm campaign plan --json`; units in the names.

        workers, threads   tests at a time and threads of each; 0: what is fastest here
        memory             bytes that all tests may take together; 0: what is free
        """
        return json.loads(_core.plan_campaign(self._study, workers, threads, memory))

    def run(self, folder: str | PathLike | None = None, *, workers: int = 0, threads: int = 0, memory: float = 0.0,
            retry: bool = False, progress: Callable[[pandas.DataFrame], bool | None] | None = None,
            stop: StopFlag | None = None) -> Campaign:
        """Runs all tests that are not done, each in a process of its own, like `dem4grm campaign run`.

        progress   called about once a second with the status of all tests; stops the campaign when it returns False
        stop       as of dem4grm.run
        retry      also tests whose physics failed, as they would again

        Stopped tests keep their checkpoints, and the same call goes on. Raises Stopped, KeyboardInterrupt or what progress raised
        when it was stopped; MissedError when tests failed, after all others are done; UsageError when the folder holds tests with
        other cases; FolderInUseError.
        """
        place = Path(folder) if folder is not None else _core.default_folder(self.name)
        tell = None if progress is None else lambda text: progress(_status_frame(text))
        _core.run_campaign(self._study, place, program(), workers, threads, memory, retry, tell, stop)
        campaign = Campaign(place)
        status = campaign.status()
        left = status[status["state"] != "done"]
        if len(left):
            causes = "\n".join(f"  {name}: {row['state']}, {row.get('cause') or ''}" for name, row in left.iterrows())
            raise MissedError(f"{len(left)} of {len(status)} tests are not done:\n{causes}")
        return campaign

    def __repr__(self) -> str:
        return f"<dem4grm.Study '{self.name}', {len(self.tests)} tests>"


def _status_frame(text: str) -> pandas.DataFrame:
    return pandas.DataFrame(json.loads(text)["state_of_tests"]).set_index("name")


class Campaign(Mapping):
    """The folder of a campaign: a mapping from the names of its tests to their folders."""

    def __init__(self, folder: str | PathLike):
        """Raises MissingFileError when the folder is none of a campaign, IoError when its record is damaged."""
        self.path = Path(folder)
        self._names = list(self.status().index)

    def status(self) -> pandas.DataFrame:
        """One row a test: state, stage, progress, ..., judged by the folders."""
        return _status_frame(_core.campaign_status(self.path))

    def __getitem__(self, name: str) -> Test:
        if name not in self._names:
            raise KeyError(name)
        return Test(self.path / "tests" / name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def collect(self, output: str | PathLike | None = None) -> Collected:
        """All finished tests in few tables, written to `output` (by default collected/ in the folder) and read.

        Raises MissingFileError when no test is done yet."""
        place = Path(output) if output is not None else self.path / "collected"
        return Collected(place, _core.collect_campaign(self.path, place))

    def __repr__(self) -> str:
        return f"<dem4grm.Campaign {self.path}, {len(self)} tests>"


class Collected:
    """What `collect` wrote (docs/reference/study-file.md), as frames."""

    def __init__(self, folder: str | PathLike, warnings: list[str] | None = None):
        self.path, self.warnings = Path(folder), list(warnings or [])

    def _read(self, name: str) -> pandas.DataFrame:
        return pandas.read_csv(self.path / name, float_precision="round_trip")

    @property
    def tests(self) -> pandas.DataFrame:
        """One row a test: its values and every number of its summary."""
        return self._read("tests.csv")

    @property
    def curves(self) -> pandas.DataFrame:
        """One row a number, long and tidy."""
        return self._read("collected.csv")

    @property
    def envelopes(self) -> pandas.DataFrame:
        """One row for each mixture and each of peak and residual shear stress: friction angle, cohesion, their errors."""
        return self._read("envelopes.csv")
