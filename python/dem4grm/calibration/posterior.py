# SPDX-License-Identifier: BSD-3-Clause
"""The posterior of the parameters: samples, best point, intervals, profiles, and what the data do not identify."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.stats import qmc, truncnorm

from .desk import Stage

WIDE = 0.6  # an interval wider than this fraction of the prior's is no identification
FLAT = 2.0  # nor is a profile that changes less than this, in units of log likelihood
NEAR_BOUND = 0.01
LogDensity = Callable[[NDArray], NDArray]


def log_prior(stage: Stage, positions: NDArray) -> NDArray:
    """Uniform between low and high on the parameter's scale, times the normal distribution of those with a prior."""
    total = numpy.where(((positions >= 0.0) & (positions <= 1.0)).all(axis=1), 0.0, -numpy.inf)
    for k, parameter in enumerate(stage.parameters):
        if prior := parameter.prior_positions():
            total = total - 0.5 * ((positions[:, k] - prior[0]) / prior[1])**2
    return total


def prior_width(stage: Stage, k: int) -> float:
    """Length of the central 95 % of a parameter's prior, in positions."""
    prior = stage.parameters[k].prior_positions()
    if prior is None:
        return 0.95
    distribution = truncnorm(-prior[0] / prior[1], (1.0 - prior[0]) / prior[1], *prior)
    return float(distribution.ppf(0.975) - distribution.ppf(0.025))


def sample(log_likelihood: LogDensity, stage: Stage, count: int, moves: int, seed: int) -> tuple[NDArray, NDArray]:
    """Samples of the posterior and their log densities, by sequential Monte Carlo (Del Moral et al. 2006): points of the prior are led to
    the posterior in steps that halve the effective number of samples at most, each with resampling and Metropolis moves."""
    d = len(stage.parameters)
    random = numpy.random.default_rng(seed)
    points = qmc.Sobol(d, seed=seed).random(1 << (count - 1).bit_length())[:count]
    prior, likelihood = log_prior(stage, points), log_likelihood(points)
    for k, parameter in enumerate(stage.parameters):  # points of a prior that is not uniform
        if given := parameter.prior_positions():
            points[:, k] = truncnorm.ppf(points[:, k], -given[0] / given[1], (1.0 - given[0]) / given[1], *given)
            prior, likelihood = log_prior(stage, points), log_likelihood(points)
    power = 0.0
    while power < 1.0:
        step = _step(likelihood, power)
        weights = numpy.exp(step * (likelihood - likelihood.max()))
        power = 1.0 if step >= 1.0 - power else power + step
        places = (numpy.arange(count) + random.random()) / count
        chosen = numpy.minimum(numpy.searchsorted(numpy.cumsum(weights) / weights.sum(), places), count - 1)
        points, prior, likelihood = points[chosen], prior[chosen], likelihood[chosen]
        scale = 2.38 / numpy.sqrt(d)
        for _ in range(moves if power < 1.0 else 2 * moves):
            shape = numpy.linalg.cholesky(numpy.atleast_2d(numpy.cov(points.T)) + 1e-12 * numpy.eye(d))
            tried = points + scale * random.standard_normal((count, d)) @ shape.T
            tried_prior = log_prior(stage, tried)
            inside = numpy.isfinite(tried_prior)
            tried_likelihood = numpy.full(count, -numpy.inf)
            if inside.any():
                tried_likelihood[inside] = log_likelihood(tried[inside])
            gain = tried_prior - prior + power * (tried_likelihood - likelihood)
            taken = numpy.log(random.random(count)) < gain
            points[taken], prior[taken], likelihood[taken] = tried[taken], tried_prior[taken], tried_likelihood[taken]
            scale *= numpy.exp(taken.mean() - 0.3)  # towards a rate of acceptance that mixes well
    return points, prior + likelihood


def _step(likelihood: NDArray, power: float) -> float:
    """How far the power of the likelihood may be raised with half of the samples still effective."""
    def is_fine(step: float) -> bool:
        weights = numpy.exp(step * (likelihood - likelihood.max()))
        return bool(weights.sum()**2 >= 0.5 * len(likelihood) * (weights**2).sum())

    low, high = 0.0, 1.0 - power
    if is_fine(high):
        return high
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_fine(middle) else (low, middle)
    return max(low, 1e-6)


def mode(density: LogDensity, points: NDArray, densities: NDArray) -> NDArray:
    """The most probable point: the best of samples, improved."""
    start = points[int(numpy.argmax(densities))]
    found = minimize(lambda u: -float(density(u[None])[0]), start, method="L-BFGS-B", bounds=[(0.0, 1.0)] * len(start),
                     options={"maxiter": 60, "eps": 1e-5})
    return found.x if -found.fun > densities.max() else start


def profile(density: LogDensity, points: NDArray, k: int, grid: NDArray, seed: int) -> NDArray:
    """The largest log density over all other parameters, with parameter k held at each position of a grid."""
    random = numpy.random.default_rng([seed, k])
    d = points.shape[1]
    spread = numpy.maximum(points.std(axis=0), 0.01)
    some = points[:: max(1, len(points) // 100)]
    tried = numpy.repeat(some[None], len(grid), axis=0)
    best, best_value = numpy.empty((len(grid), d)), numpy.full(len(grid), -numpy.inf)
    for width in (None, 1.0, 1.0, 0.5, 0.25, 0.1):
        if width is not None:
            tried = numpy.clip(best[:, None] + width * spread * random.standard_normal((len(grid), 80, d)), 0.0, 1.0)
        tried[:, :, k] = grid[:, None]
        values = density(tried.reshape(-1, d)).reshape(len(grid), -1)
        place = values.argmax(axis=1)
        rows = numpy.arange(len(grid))
        better = values[rows, place] > best_value
        best[better], best_value[better] = tried[rows, place][better], values[rows, place][better]
        if d == 1:
            break
    return best_value


@dataclass
class Estimate:
    """What the data say about one parameter; values in the unit of the parameter."""

    key: str
    unit: str
    best: float
    low: float  # of the 95 % interval
    high: float
    is_identified: bool
    why_not: str
    at_bound: str  # "low", "high" or ""
    grid: list[float]
    profile: list[float]  # log density, 0 at its largest


def estimates(stage: Stage, density: LogDensity, points: NDArray, best: NDArray) -> list[Estimate]:
    found = []
    for k, parameter in enumerate(stage.parameters):
        low, high = numpy.quantile(points[:, k], [0.025, 0.975])
        # Fine around the interval, coarse over the rest of the range.
        wide = max(high - low, 1e-3)
        fine = numpy.linspace(max(0.0, low - wide), min(1.0, high + wide), 17)
        grid = numpy.unique(numpy.concatenate([numpy.linspace(0.0, 1.0, 13), fine, best[k:k + 1]]))
        values = profile(density, points, k, grid, stage.seed)
        values = values - max(values.max(), float(density(best[None])[0]))
        share, drop = (high - low) / prior_width(stage, k), float(values.max() - values.min())
        reasons = [f"its interval has {100 * share:.0f} % of the width of the prior"] if share > WIDE else []
        reasons += [f"its profile changes by {drop:.1f} in log likelihood"] if drop < FLAT else []
        edge = "low" if best[k] < NEAR_BOUND else "high" if best[k] > 1.0 - NEAR_BOUND else ""
        found.append(Estimate(parameter.key, parameter.unit, float(parameter.value(best[k])), float(parameter.value(low)),
                              float(parameter.value(high)), not reasons, " and ".join(reasons), edge if not reasons else "",
                              parameter.value(grid).tolist(), values.tolist()))
    return found
