# SPDX-License-Identifier: BSD-3-Clause
"""Where the next trials are: a space-filling design, then batches that improve the fit and its intervals."""
from __future__ import annotations

import warnings

import numpy
from numpy.typing import NDArray
from scipy.stats import norm, qmc

from .desk import Stage
from .posterior import log_prior, mode, sample
from .surrogate import Surrogate

CANDIDATES = 1024
NEAREST = 0.02  # trials closer than this to one that failed are not proposed


def design(stage: Stage) -> NDArray:
    """The first trials: a scrambled Sobol sequence over the whole range."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # any number of points is fine here, not only powers of two
        return qmc.Sobol(len(stage.parameters), seed=stage.seed).random(stage.start)


def _expected_improvement(surrogate: Surrogate, stage: Stage, positions: NDArray) -> NDArray:
    """Of chi-squared, over the smallest that the surrogate expects at any trial; means over fixed normal numbers."""
    normals = norm.ppf(numpy.clip(qmc.Sobol(surrogate.scores.shape[1], seed=0).random(64), 1e-6, 1.0 - 1e-6))
    means, variances = surrogate.predict(positions)
    chi = surrogate.misfit(means[:, None] + numpy.sqrt(variances)[:, None] * normals) - 2.0 * log_prior(stage, positions)[:, None]
    at_trials = surrogate.misfit(surrogate.predict(surrogate.positions)[0]) - 2.0 * log_prior(stage, surrogate.positions)
    return numpy.maximum(at_trials.min() - chi, 0.0).mean(axis=1)


def _most_uncertain(surrogate: Surrogate, points: NDArray) -> int:
    """The sample of the posterior at which the surrogate's doubt is largest beside the errors of measurement."""
    _, variances = surrogate.predict(points)
    return int(numpy.argmax((variances / (numpy.diag(surrogate._measured) + surrogate.noise)).sum(axis=1)))


def proposals(surrogate: Surrogate, stage: Stage, count: int, round_number: int, failed: NDArray) -> NDArray:
    """A batch of positions: the most probable one, then by turns the sample of the posterior that the surrogate knows least about (it decides
    the intervals) and the largest expected improvement (it finds other minima). Each takes those before it as done."""
    seed = stage.seed + 7919 * (round_number + 1)
    random = numpy.random.default_rng(seed)
    d = len(stage.parameters)

    def density(u: NDArray) -> NDArray:
        return log_prior(stage, u) + surrogate.log_likelihood(numpy.clip(u, 0.0, 1.0))

    points, densities = sample(surrogate.log_likelihood, stage, 256, 2, seed)
    chosen: list[NDArray] = []
    current = surrogate
    for k in range(count):
        if k == 0:
            position = mode(density, points, densities)
        elif k % 2 == 1:
            position = points[_most_uncertain(current, points)]
        else:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", UserWarning)
                spread = qmc.Sobol(d, seed=seed).random(CANDIDATES)
            near = points + random.normal(0.0, 0.02, points.shape)
            tried = numpy.clip(numpy.vstack([spread, near]), 0.0, 1.0)
            position = tried[int(numpy.argmax(_expected_improvement(current, stage, tried)))]
        known = numpy.vstack([current.positions, *failed[None, :]]) if len(failed) else current.positions
        closest = numpy.abs(known - position).max(axis=1)
        if closest.min() < 1e-4 or (len(failed) and numpy.abs(failed - position).max(axis=1).min() < NEAREST):
            # A repetition tells nothing new; nor does a place next to a failure.
            position = numpy.clip(points[random.integers(len(points))] + random.normal(0.0, 0.03, d), 0.0, 1.0)
        chosen.append(position)
        if k + 1 < count:
            current = current.believe(position)
    return numpy.array(chosen)
