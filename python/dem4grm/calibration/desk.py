# SPDX-License-Identifier: BSD-3-Clause
"""The desk file of a calibration: its stages with data and parameters, as objects."""
from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from ..cases import Case
from ..errors import CaseError, MissingFileError
from .data import Series


@dataclass
class Parameter:
    """A key of the case that is fitted. Values are numbers in `unit`; `position` is 0 at low and 1 at high, on the scale."""

    key: str
    low: float
    high: float
    unit: str = ""
    is_log: bool = False
    prior: tuple[float, float] | None = None  # mean and standard deviation, in `unit`

    def value(self, position: Any) -> Any:
        """Values at positions between 0 and 1."""
        if self.is_log:
            return numpy.exp(numpy.log(self.low) + numpy.asarray(position) * numpy.log(self.high / self.low))
        return self.low + numpy.asarray(position) * (self.high - self.low)

    def position(self, value: Any) -> Any:
        if self.is_log:
            return numpy.log(numpy.asarray(value) / self.low) / numpy.log(self.high / self.low)
        return (numpy.asarray(value) - self.low) / (self.high - self.low)

    def prior_positions(self) -> tuple[float, float] | None:
        """Mean and standard deviation of the prior as positions; on a log scale the deviation is that of the logarithm, to first order."""
        if self.prior is None:
            return None
        mean, deviation = self.prior
        width = deviation / mean / numpy.log(self.high / self.low) if self.is_log else deviation / (self.high - self.low)
        return float(self.position(mean)), float(width)

    def text(self, value: float) -> Any:
        """As the case file has it, with all digits."""
        return f"{float(value)!r} {self.unit}" if self.unit else float(value)


@dataclass
class Experiment:
    """One simulated test of a stage: what its data ask to be set in the case, and the case."""

    name: str
    changes: dict[str, Any]
    case: Case


@dataclass
class Stage:
    """A fit: parameters, data, the tests that these need, and how much work it may be."""

    name: str
    parameters: list[Parameter]
    series: list[Series]
    experiments: list[Experiment]
    trials: int
    batch: int
    start: int
    seeds: int       # tests behind each trial
    specimens: int   # that the laboratory's data are the mean of
    replicates: int
    seed: int
    full: dict[str, Any] | None = None
    given: dict[str, str] = field(default_factory=dict)  # keys that earlier stages have found: name of the stage

    @property
    def y(self) -> NDArray:
        return numpy.concatenate([series.y for series in self.series])

    def covariance(self) -> NDArray:
        """Of the errors of measurement of all values, one after the other."""
        blocks = [numpy.diag(series.error**2) + numpy.outer(series.common, series.common) for series in self.series]
        total = numpy.zeros((len(self.y), len(self.y)))
        start = 0
        for block in blocks:
            total[start:start + len(block), start:start + len(block)] = block
            start += len(block)
        return total

    def parts(self, values: NDArray) -> list[NDArray]:
        """Cuts values of all series into those of each."""
        return numpy.split(values, numpy.cumsum([len(series.y) for series in self.series])[:-1])

    def texts(self, positions: NDArray) -> dict[str, Any]:
        """Values of the parameters as the case file has them."""
        return {p.key: p.text(p.value(u)) for p, u in zip(self.parameters, positions)}


@dataclass
class Prediction:
    """A test that is run at the end with all that was found, and never fitted."""

    name: str
    experiment: Experiment
    series: list[Series]


@dataclass
class Desk:
    """A calibration as its file says it."""

    path: Path
    name: str
    stages: list[Stage]
    predictions: list[Prediction]
    digest: str  # of everything that the result depends on

    @classmethod
    def read(cls, path: str | PathLike) -> Desk:
        """Raises MissingFileError, and CaseError with every problem of the file, its cases and its data."""
        try:
            text = Path(path).read_text(encoding="utf-8")
        except OSError as error:
            raise MissingFileError(f"{path}: cannot be read: {error.strerror}") from None
        return cls.parse(text, path)

    @classmethod
    def parse(cls, text: str, path: str | PathLike = "desk.toml") -> Desk:
        """From the text of a desk file; `path` stands in messages, and files that it names are looked for in its folder."""
        from .desk_reader import DeskReader
        try:
            tree = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            message = f"{path}: error: this is no TOML: {error}"
            raise CaseError(message, [message]) from None
        return DeskReader(tree, text, Path(path)).desk()


def digest_of(stages: list[Stage], predictions: list[Prediction]) -> str:
    """Equal for desks with equal results: layout, names of files and remarks do not matter, values do."""
    def of_series(series: Series) -> list:
        return [series.name, series.quantity, series.abscissa, series.x.tolist(), series.y.tolist(), series.error.tolist(),
                series.common.tolist(), series.test]

    def of_experiment(experiment: Experiment) -> list:
        return [experiment.name, experiment.case.text]

    content = [[[s.name, [vars(p) for p in s.parameters], [of_series(x) for x in s.series], [of_experiment(e) for e in s.experiments],
                 s.trials, s.batch, s.start, s.seeds, s.specimens, s.replicates, s.seed, s.full, s.given] for s in stages],
               [[p.name, of_experiment(p.experiment), [of_series(x) for x in p.series]] for p in predictions]]
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]


def is_mixture(case: Case) -> bool:
    """Gravel and rubber in one specimen."""
    if case.test != "direct_shear":
        return False
    content = case.si("specimen.rubber_content")
    return isinstance(content, (int, float)) and 0.0 < content < 1.0


def with_changes(case: Case, changes: Mapping[str, Any]) -> Case:
    changed = case.copy()
    if changes:
        changed.update(changes)
    return changed
