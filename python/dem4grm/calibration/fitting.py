# SPDX-License-Identifier: BSD-3-Clause
"""Fits one stage: design, rounds of proposals, the posterior, and the run that confirms it."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray
from scipy.stats import chi2

from .desk import Stage
from .posterior import FLAT, Estimate, estimates, log_prior, mode, sample
from .search import design, proposals
from .surrogate import Surrogate
from .trials import Bench, Job, TrialStore, require_successes, values_of

SAMPLES = 1024


@dataclass
class Fit:
    """What a stage found."""

    stage: Stage
    given: dict[str, Any]
    estimates: list[Estimate]
    best: NDArray  # position
    correlations: NDArray  # of the positions, [d, d]
    points: NDArray  # samples of the posterior, positions
    records: list[dict[str, Any]]
    best_curves: NDArray  # simulated with the best values
    full_curves: NDArray | None
    band: NDArray  # [2, m]: 2.5 and 97.5 % of the surrogate's curves over the posterior
    misfit: float  # chi-squared of the best run over the number of values, errors of measurement and noise of a specimen
    inflation: float  # factor on the covariance of measurement, since the model does not reach the data within their errors
    noise: NDArray  # standard deviation of each value from one seed to the next
    surrogate_error: float  # root mean square difference of surrogate and run at the best values, in errors of measurement
    runs: int

    @property
    def values(self) -> dict[str, Any]:
        """Best values as the case file has them."""
        return self.stage.texts(self.best)


class _Rounds:
    """Proposals kept on disk: a calibration that goes on runs the same trials, whatever machine it goes on on."""

    def __init__(self, path: Path):
        self._path = path
        self.rounds: list[list[list[float]]] = json.loads(path.read_text(encoding="utf-8")) if path.exists() else []

    def get(self, number: int, make) -> NDArray:
        if number == len(self.rounds):
            self.rounds.append(make().tolist())
            temporary = self._path.with_suffix(".part")
            temporary.write_text(json.dumps(self.rounds), encoding="utf-8")
            temporary.replace(self._path)
        return numpy.array(self.rounds[number])


class _Fitting:
    def __init__(self, stage: Stage, given: dict[str, Any], bench: Bench, folder: Path):
        self._stage, self._given, self._bench = stage, given, bench
        self._rounds = _Rounds(folder / "proposals.json")
        self._points: list[NDArray] = []
        self._records: list[dict[str, Any]] = []
        self._replicates: NDArray | None = None
        self._surrogate: Surrogate | None = None
        self._trained = 0

    def _run(self, positions: NDArray, role: str) -> None:
        first = len(self._points)
        self._points += list(positions)
        jobs = [Job(first + k, number, role, tuple(map(float, position))) for k, position in enumerate(positions)
                for number in range(self._stage.seeds)]
        self._records += self._bench.do(jobs)

    def _means(self) -> tuple[NDArray, NDArray, NDArray]:
        """Positions and mean curves of points whose trials all succeeded, and positions of the others."""
        good, curves, failed = [], [], []
        for k, position in enumerate(self._points):
            mine = self._records[k * self._stage.seeds:(k + 1) * self._stage.seeds]
            if any("failure" in record for record in mine):
                failed.append(position)
            else:
                good.append(position)
                curves.append(numpy.mean([values_of(record) for record in mine], axis=0))
        return numpy.array(good), numpy.array(curves), numpy.array(failed).reshape(-1, len(self._stage.parameters))

    def _replicate(self) -> None:
        """The best trial so far again, with other seeds: how far specimens differ that only their seed tells apart."""
        stage = self._stage
        if stage.replicates < 2:
            return
        good = [record for record in self._records if "failure" not in record]
        best = min(good, key=lambda record: (record["misfit"], record["point"], record["number"]))
        jobs = [Job(best["point"], stage.seeds + k, "replicate", tuple(best["position"])) for k in range(stage.replicates)]
        records = [record for record in self._bench.do(jobs) if "failure" not in record]
        self._replicates = numpy.array([values_of(record) for record in records])

    def _train(self, is_final: bool = False) -> Surrogate:
        stage = self._stage
        good, curves, _ = self._means()
        self._surrogate = Surrogate(good, curves, stage.y, stage.covariance(), self._replicates, stage.seeds, stage.specimens, is_final)
        if not is_final:
            return self._surrogate
        # A model that misses the data by more than their errors explain must not be sure of its parameters: the errors grow until it fits.
        best = float(self._surrogate.misfit(self._surrogate.predict(good)[0]).min())
        degrees = max(1, len(stage.y) - len(stage.parameters))
        self._surrogate.inflation = best / degrees if best > chi2.ppf(0.95, degrees) else 1.0
        return self._surrogate

    def fit(self) -> Fit:
        stage = self._stage
        self._run(design(stage), "design")
        require_successes(self._records, len(stage.parameters) + 2, stage)
        self._replicate()
        number = 0
        while len(self._points) < stage.trials:
            count = min(stage.batch, stage.trials - len(self._points))
            failed = self._means()[2]
            self._run(self._rounds.get(number, lambda: proposals(self._train(), stage, count, number, failed)), "search")
            number += 1
        surrogate = self._train(is_final=True)

        def density(u: NDArray) -> NDArray:
            return log_prior(stage, u) + surrogate.log_likelihood(numpy.clip(u, 0.0, 1.0))

        points, densities = sample(surrogate.log_likelihood, stage, SAMPLES, 5, stage.seed)
        best = self._rounds.get(number, lambda: mode(density, points, densities)[None])[0]
        best_curves = self._confirm(best, "best", stage.trials)
        full_curves = self._confirm(best, "full", stage.trials + 1) if stage.full is not None else None
        return self._result(surrogate, density, points, best, best_curves, full_curves)

    def _confirm(self, best: NDArray, role: str, point: int) -> NDArray:
        """The best values run: the surrogate's word alone is not enough."""
        jobs = [Job(point, number, role, tuple(map(float, best))) for number in range(self._stage.seeds)]
        records = self._bench.do(jobs)
        require_successes(records, 1, self._stage)
        return numpy.mean([values_of(record) for record in records if "failure" not in record], axis=0)

    def _without_influence(self, best: NDArray, best_curves: NDArray, covariance: NDArray) -> list[bool]:
        """Runs the best values with each parameter at both of its ends: a surrogate may see a trend where there is none, a run does not."""
        stage = self._stage
        jobs = []
        for k in range(len(stage.parameters)):
            for end in (0.0, 1.0):
                position = best.copy()
                position[k] = end
                jobs.append(Job(stage.trials + 2 + len(jobs), 0, "sweep", tuple(map(float, position))))
        residuals = [values_of(r) - stage.y if "failure" not in r else None for r in self._bench.do(jobs)]

        def chi(residual: NDArray) -> float:
            return float(residual @ numpy.linalg.solve(covariance, residual))

        changes = [numpy.inf if r is None else abs(chi(r) - chi(best_curves - stage.y)) / 2.0 for r in residuals]
        return [max(changes[2 * k:2 * k + 2]) < FLAT for k in range(len(stage.parameters))]

    def _result(self, surrogate: Surrogate, density, points: NDArray, best: NDArray, best_curves: NDArray,
                full_curves: NDArray | None) -> Fit:
        stage = self._stage
        scale = numpy.sqrt(numpy.diag(stage.covariance()))
        noise = numpy.sqrt((surrogate.directions**2 @ surrogate.noise)) * scale
        covariance = stage.covariance() + (surrogate.directions * scale[:, None] * surrogate.noise) @ (
            surrogate.directions * scale[:, None]).T
        residual = best_curves - stage.y
        some = points[:: max(1, len(points) // 300)]
        band = numpy.quantile(surrogate.curve(some, stage.y), [0.025, 0.975], axis=0)
        off = (surrogate.curve(best[None], stage.y)[0] - best_curves) / scale
        correlations = numpy.atleast_2d(numpy.corrcoef(points.T))
        found = estimates(stage, density, points, best)
        for estimate, is_idle in zip(found, self._without_influence(best, best_curves, covariance)):
            if is_idle:
                estimate.is_identified, estimate.at_bound = False, ""
                estimate.why_not = "runs with it at either end of its range are as near to the data"
        return Fit(stage, self._given, found, best, correlations, points, self._records, best_curves,
                   full_curves, band, float(residual @ numpy.linalg.solve(covariance, residual)) / len(residual), surrogate.inflation,
                   noise, float(numpy.sqrt((off**2).mean())), 0)


def fit_stage(stage: Stage, given: dict[str, Any], bench: Bench, store: TrialStore, folder: Path) -> Fit:
    """Fits a stage with the values that earlier ones have given; everything that is run is kept in the folder."""
    found = _Fitting(stage, given, bench, folder).fit()
    found.records = store.trials()
    found.runs = len(found.records) * len(stage.experiments)
    return found
