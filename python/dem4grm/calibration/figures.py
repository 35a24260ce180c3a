# SPDX-License-Identifier: BSD-3-Clause
"""Figures of a stage: the fit beside the data, profiles, pairs of parameters, and how the search went."""
from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from .fitting import Fit

BLUE, ORANGE, GREY = "#1f6feb", "#d9480f", "#8a8f98"


def _figure(width: float, height: float) -> Figure:
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)  # no window system, and no state that threads share
    return figure


def _save(figure: Figure, path: Path) -> None:
    # Without the version of the library: the same calibration gives the same file.
    figure.savefig(path, dpi=110, metadata={"Software": None})


def _label(key: str, unit: str) -> str:
    return f"{key} ({unit})" if unit else key


def _few_ticks(axis: Axis) -> None:
    """1, 2, 5, 10, ... as plain numbers: ranges of parameters seldom span two decades."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def draw_fit(fit: Fit, path: Path) -> None:
    """Data with their errors, simulated curves, and residuals in errors of measurement below."""
    stage = fit.stage
    curves, lows, highs = stage.parts(fit.best_curves), stage.parts(fit.band[0]), stage.parts(fit.band[1])
    full = stage.parts(fit.full_curves) if fit.full_curves is not None else None
    count = len(stage.series)
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = _figure(4.4 * columns, 4.2 * rows)
    grids = figure.subfigures(rows, columns, squeeze=False)
    for k, series in enumerate(stage.series):
        top, bottom = grids[k // columns][k % columns].subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [3, 1]})
        error = numpy.hypot(series.error, series.common)
        x = series.x if not series.is_number else numpy.zeros(1)
        top.fill_between(x, lows[k], highs[k], color=BLUE, alpha=0.2, lw=0)
        top.errorbar(x, series.y, 1.96 * error, fmt="o", ms=3.5, color=ORANGE, lw=1, label="measured, 95 %")
        top.plot(x, curves[k], "-" if len(x) > 1 else "D", color=BLUE, ms=5, label="best values, run")
        if full is not None:
            top.plot(x, full[k], "--" if len(x) > 1 else "s", color="black", ms=5, label="best values, full size")
        bottom.axhspan(-1.96, 1.96, color=ORANGE, alpha=0.12, lw=0)
        bottom.axhline(0.0, color=GREY, lw=0.8)
        bottom.plot(x, (curves[k] - series.y) / error, "o", ms=3.5, color=BLUE)
        bottom.set_ylabel("residual /\nerror")
        bottom.set_xlabel(series.abscissa)
        top.set_ylabel(series.quantity)
        top.set_title(f"{series.name} ({stage.experiments[series.test].name})", fontsize=9)
        if series.is_number:
            bottom.set_xticks([])
        if k == 0:
            top.legend(fontsize=8, frameon=False)
    _save(figure, path)


def draw_profiles(fit: Fit, path: Path) -> None:
    """Profile log likelihoods, with the interval; flat ones are not identified."""
    count = len(fit.estimates)
    columns = min(count, 3)
    figure = _figure(3.6 * columns, 2.9 * -(-count // columns))
    axes = figure.subplots(-(-count // columns), columns, squeeze=False).ravel()
    for axis in axes[count:]:
        axis.set_axis_off()
    for axis, estimate, parameter in zip(axes, fit.estimates, fit.stage.parameters):
        color = BLUE if estimate.is_identified else GREY
        axis.axvspan(estimate.low, estimate.high, color=color, alpha=0.15, lw=0)
        axis.plot(estimate.grid, estimate.profile, ".-", color=color, ms=3)
        axis.axvline(estimate.best, color=ORANGE, lw=1)
        axis.set_ylim(-12, 0.8)
        if parameter.is_log:
            axis.set_xscale("log")
            _few_ticks(axis.xaxis)
        axis.set_xlim(parameter.low, parameter.high)
        axis.set_xlabel(_label(estimate.key, estimate.unit), fontsize=9)
        axis.set_title("identified" if estimate.is_identified else "not identified by these data", fontsize=9, color=color)
    axes[0].set_ylabel("profile, log likelihood")
    _save(figure, path)


def draw_pairs(fit: Fit, path: Path) -> None:
    """The trials and the samples of the posterior for each pair of parameters; histograms on the diagonal."""
    d = len(fit.estimates)
    figure = _figure(2.3 * d + 0.6, 2.3 * d + 0.4)
    axes = figure.subplots(d, d, squeeze=False)
    trials = numpy.array([record["position"] for record in fit.records if record["role"] in ("design", "search")])
    values = [p.value(fit.points[:, k]) for k, p in enumerate(fit.stage.parameters)]
    tried = [p.value(trials[:, k]) for k, p in enumerate(fit.stage.parameters)]
    for row in range(d):
        for column in range(d):
            axis = axes[row][column]
            if column > row:
                axis.set_axis_off()
                continue
            across, down = fit.stage.parameters[column], fit.stage.parameters[row]
            if across.is_log:
                axis.set_xscale("log")
                _few_ticks(axis.xaxis)
            axis.set_xlim(across.low, across.high)
            if column == row:
                axis.hist(values[row], bins=across.value(numpy.linspace(0, 1, 60)), color=BLUE, alpha=0.6)
                axis.set_yticks([])
            else:
                axis.plot(tried[column], tried[row], "x", ms=3, color=GREY, mew=0.7)
                axis.plot(values[column], values[row], ".", ms=1.5, color=BLUE, alpha=0.4)
                if down.is_log:
                    axis.set_yscale("log")
                    _few_ticks(axis.yaxis)
                axis.set_ylim(down.low, down.high)
            axis.tick_params(labelsize=7, which="both")
            if row == d - 1:
                axis.set_xlabel(_label(across.key, across.unit), fontsize=8)
            if column == 0 and row > 0:
                axis.set_ylabel(_label(down.key, down.unit), fontsize=8)
    _save(figure, path)


def draw_search(fit: Fit, path: Path) -> None:
    """Misfit of each trial, in the order of the points."""
    figure = _figure(6.0, 2.8)
    axis = figure.subplots()
    done = [r for r in fit.records if "misfit" in r]
    for role, color in (("design", GREY), ("search", BLUE), ("replicate", "#7048e8"), ("best", ORANGE), ("full", "black"), ("sweep", "#2b8a3e")):
        mine = [r for r in done if r["role"] == role]
        if mine:
            axis.semilogy([r["point"] for r in mine], [r["misfit"] / len(fit.stage.y) for r in mine], "o", ms=3.5, color=color, label=role)
    axis.set_xlabel("point")
    axis.set_ylabel("chi-squared / values")
    axis.legend(fontsize=8, frameon=False, ncols=5)
    _save(figure, path)


def draw_stage(fit: Fit, folder: Path) -> None:
    with matplotlib.rc_context({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False}):
        draw_fit(fit, folder / "fit.png")
        draw_profiles(fit, folder / "profiles.png")
        draw_pairs(fit, folder / "pairs.png")
        draw_search(fit, folder / "search.png")
