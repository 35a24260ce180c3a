# SPDX-License-Identifier: BSD-3-Clause
"""What simulated curves look like between the trials: Gaussian processes of their principal components, and the likelihood that follows.

Residuals of the trials, in units of the errors of measurement, are written as scores times few directions (singular value decomposition);
each score is a Gaussian process over the positions of the parameters. With scores of mean m and variance v, directions V, errors of
measurement S and the noise D of the specimens behind the data, the residual has the covariance S + V (D + v) V', so that

    log likelihood = -(m' M^-1 m + log det M) / 2,    M = (V' S^-1 V)^-1 + D + v

up to a constant (Woodbury's identity): what the surrogate does not know widens the intervals.
"""
from __future__ import annotations

import warnings

import numpy
from numpy.typing import NDArray
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

MOST_DIRECTIONS = 8
REST = 0.05  # in units of an error of measurement: how well the directions have to describe a curve near the data


class Surrogate:
    """Fitted to the mean curves of trials.

    positions    [n, d] between 0 and 1
    curves       [n, m], mean over the seeds of each trial
    y, covariance   data [m] and the covariance of their errors [m, m]
    replicates   [r, m] curves of one point with different seeds, or none
    seeds        how many seeds a curve is the mean of
    specimens    how many specimens the data are the mean of

    It depends on nothing else, above all not on earlier surrogates: a calibration that goes on after a kill has none.
    """

    def __init__(self, positions: NDArray, curves: NDArray, y: NDArray, covariance: NDArray, replicates: NDArray | None = None,
                 seeds: int = 1, specimens: int = 1, is_final: bool = False):
        self.positions, self.seeds = positions, seeds
        self._scale = 1.0 / numpy.sqrt(numpy.diag(covariance))
        residuals = (curves - y) * self._scale
        # Directions are those that matter near the data: far trials count less the farther they are.
        weights = 1.0 / numpy.sqrt(1.0 + (residuals**2).mean(axis=1))
        _, sizes, rows = numpy.linalg.svd(weights[:, None] * residuals, full_matrices=False)
        rests = numpy.sqrt(numpy.maximum(0.0, (sizes**2).sum() - numpy.cumsum(sizes**2)) / residuals.size)
        kept = min(int(numpy.argmax(rests < REST)) + 1 if (rests < REST).any() else len(sizes), MOST_DIRECTIONS, len(y))
        self.directions = rows[:kept].T
        self.scores = residuals @ self.directions
        unexplained = weights[:, None] * (residuals - self.scores @ self.directions.T)
        scaled = covariance * numpy.outer(self._scale, self._scale) + numpy.diag((unexplained**2).mean(axis=0))
        self._measured = numpy.linalg.inv(self.directions.T @ numpy.linalg.solve(scaled, self.directions))
        self.inflation = 1.0
        self._fit(is_final)
        self.noise = self._noise_of_a_specimen(replicates) / specimens

    def _fit(self, is_final: bool) -> None:
        d = self.positions.shape[1]
        self._processes: list[GaussianProcessRegressor] = []
        for scores in self.scores.T:
            kernel = ConstantKernel(1.0, (1e-2, 1e4)) * Matern([1.0] * d, (0.05, 50.0), nu=2.5) + WhiteKernel(1e-4, (1e-9, 1.0))
            process = GaussianProcessRegressor(kernel, normalize_y=True, alpha=1e-10, random_state=0,
                                               n_restarts_optimizer=1 if is_final and d < 4 else 0)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ConvergenceWarning)
                self._processes.append(process.fit(self.positions, scores))

    def _white(self) -> NDArray:
        return numpy.array([p.kernel_.k2.noise_level * p._y_train_std**2 for p in self._processes])

    def _noise_of_a_specimen(self, replicates: NDArray | None) -> NDArray:
        """Variance of each score from one seed to the next: that of replicates, or what the processes could not follow, if that is more."""
        noise = self._white() * self.seeds
        if replicates is not None and len(replicates) > 1:
            scores = (replicates * self._scale) @ self.directions
            noise = numpy.maximum(noise, scores.var(axis=0, ddof=1))
        return noise

    def predict(self, positions: NDArray) -> tuple[NDArray, NDArray]:
        """Mean and variance of the scores [n, k] of the mean over many seeds."""
        means, variances = [], []
        for process, white in zip(self._processes, self._white()):
            mean, deviation = process.predict(positions, return_std=True)
            means.append(mean)
            variances.append(numpy.maximum(deviation**2 - white, 0.0))
        return numpy.array(means).T, numpy.array(variances).T

    def log_likelihood(self, positions: NDArray) -> NDArray:
        """Of the data at each of the positions, up to a constant."""
        return self._log_of(*self.predict(positions))

    def _log_of(self, means: NDArray, variances: NDArray) -> NDArray:
        matrix = self.inflation * self._measured + (self.noise + variances)[:, :, None] * numpy.eye(len(self.noise))
        solved = numpy.linalg.solve(matrix, means[:, :, None])[:, :, 0]
        return -0.5 * ((means * solved).sum(axis=1) + numpy.linalg.slogdet(matrix)[1])

    def misfit(self, scores: NDArray) -> NDArray:
        """Chi-squared of scores [..., k], with the errors of measurement and the noise of the specimens, without doubts of the surrogate."""
        matrix = numpy.linalg.inv(self._measured + numpy.diag(self.noise))
        return numpy.einsum("...i,ij,...j->...", scores, matrix, scores)

    def curve(self, positions: NDArray, y: NDArray) -> NDArray:
        """Predicted values of all data [n, m]."""
        return y + self.predict(positions)[0] @ self.directions.T / self._scale

    def believe(self, position: NDArray) -> Surrogate:
        """Another surrogate that takes its own prediction at a position for a trial: what a batch does not know yet."""
        other = object.__new__(Surrogate)
        other.__dict__.update(self.__dict__)
        other.positions = numpy.vstack([self.positions, position])
        other.scores = numpy.vstack([self.scores, self.predict(position[None])[0]])
        other._processes = []
        for process, scores in zip(self._processes, other.scores.T):
            same = GaussianProcessRegressor(process.kernel_, optimizer=None, normalize_y=True, alpha=1e-10)
            other._processes.append(same.fit(other.positions, scores))
        return other
