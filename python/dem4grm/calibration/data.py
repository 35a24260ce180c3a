# SPDX-License-Identifier: BSD-3-Clause
"""Measured curves and numbers: files as laboratories export them, errors of measurement, quantities of a simulated test."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy
from numpy.typing import NDArray

# What a simulated test can be compared in: columns of its curve (grain.csv, shear.csv) and numbers of its summary.json.
CURVES = {
    "grain_compression": ("strain", "displacement_mm", "load_N", "poisson_ratio", "closed_second_neighbours"),
    "direct_shear": ("displacement_mm", "shear_stress_kPa", "shear_stress_corrected_kPa", "normal_stress_kPa",
                     "normal_stress_corrected_kPa", "vertical_displacement_mm", "void_ratio", "shear_ratio", "dilation_rate"),
}
NUMBERS = {
    "grain_compression": ("load_at_end_N", "initial_stiffness_N_per_mm", "late_stiffness_N_per_mm", "knee_strain",
                          "poisson_ratio_initial"),
    "direct_shear": ("void_ratio_generated", "void_ratio_prepared", "void_ratio_before_shear", "void_ratio_at_end", "void_ratio_min",
                     "void_ratio_max", "relative_density", "preparation_friction", "peak_shear_stress_kPa",
                     "displacement_at_peak_mm", "residual_shear_stress_kPa", "secant_stiffness_kPa_per_mm", "dilation_angle_deg",
                     "vertical_displacement_at_end_mm", "largest_contraction_mm", "k0_x", "k0_y"),
}


@dataclass
class Series:
    """A measured curve (x, y) or number (x empty) with its errors; `test` is the index of the test of the stage that it belongs to."""

    name: str
    quantity: str
    abscissa: str  # column of x, "" for a number
    x: NDArray
    y: NDArray
    error: NDArray  # standard deviation of each value, independent of the others
    common: NDArray  # standard deviation that all values of this series share, as of a load cell's calibration
    test: int = 0
    source: str = ""

    @property
    def is_number(self) -> bool:
        return not self.abscissa


@dataclass
class ReadCurve:
    """What is in a file, or what is wrong with it."""

    x: NDArray = field(default_factory=lambda: numpy.empty(0))
    y: NDArray = field(default_factory=lambda: numpy.empty(0))
    problem: str = ""


def _separator(line: str) -> str:
    return next((mark for mark in (";", "\t") if mark in line), ",")


def _number(word: str, separator: str) -> float:
    word = word.strip().strip('"')
    return float(word.replace(",", ".") if separator != "," else word)


def read_curve(path: Path, x_column: str, y_column: str) -> ReadCurve:
    """Two columns of a CSV file by their names. Fields are parted by semicolons, tabs or commas; decimal commas, lines before the names
    and a line of units under them are understood. Rows in which both fields are empty are left out."""
    try:
        lines = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    except OSError as error:
        return ReadCurve(problem=f"cannot be read: {error.strerror}")
    for start, line in enumerate(lines):
        separator = _separator(line)
        names = [name.strip().strip('"') for name in line.split(separator)]
        if x_column in names and y_column in names:
            break
    else:
        first = next((line for line in lines if line.strip()), "")
        return ReadCurve(problem=f"has no line with the columns \"{x_column}\" and \"{y_column}\"; it begins with: {first[:100]}")
    places = names.index(x_column), names.index(y_column)
    rows: list[tuple[float, float]] = []
    for number, line in enumerate(lines[start + 1:], start + 2):
        fields = line.split(separator)
        words = [fields[place].strip() if place < len(fields) else "" for place in places]
        if not any(words):
            continue
        try:
            rows.append((_number(words[0], separator), _number(words[1], separator)))
        except ValueError:
            if rows or number > start + 2:
                return ReadCurve(problem=f"line {number}: \"{words[0]}\", \"{words[1]}\" are not two numbers")
    if not rows:
        return ReadCurve(problem="has no rows of numbers")
    x, y = numpy.array(rows).T
    if not (numpy.isfinite(x).all() and numpy.isfinite(y).all()):
        return ReadCurve(problem="has values that are not finite")
    return ReadCurve(x, y)


def thinned(x: NDArray, y: NDArray, points: int) -> tuple[NDArray, NDArray]:
    """About so many values, evenly over the abscissa, each the mean of the rows around it."""
    order = numpy.argsort(x, kind="stable")
    x, y = x[order], y[order]
    if len(x) <= points or x[-1] == x[0]:
        return x, y
    bins = numpy.minimum((points * (x - x[0]) / (x[-1] - x[0])).astype(int), points - 1)
    kept = [bins == k for k in range(points) if (bins == k).any()]
    return numpy.array([x[rows].mean() for rows in kept]), numpy.array([y[rows].mean() for rows in kept])


_ERROR = re.compile(r"^\s*([0-9.eE+-]+)\s*(%?)\s*$")


def errors_of(words: object, y: NDArray) -> NDArray | None:
    """Standard deviations from 0.2 (in the unit of y), "3 %" (of each value), or a list of both, which add up as squares do."""
    total = numpy.zeros_like(y)
    for word in words if isinstance(words, list) else [words]:
        found = _ERROR.match(str(word)) if not isinstance(word, bool) else None
        try:
            value = float(found[1]) if found else -1.0
        except ValueError:
            value = -1.0
        if not 0.0 <= value < float("inf"):
            return None
        total = numpy.hypot(total, numpy.abs(y) * value / 100.0 if found[2] else value)
    return total


def at(x: NDArray, curve_x: NDArray, curve_y: NDArray) -> NDArray:
    """A simulated curve at the abscissae of the data: linear between rows; before the first row the line of the first two goes on, since
    the first row is a mean over an interval that begins at zero; NaN beyond the last row."""
    y = numpy.interp(x, curve_x, curve_y, right=numpy.nan)
    reach = curve_x[-1] + 0.02 * (curve_x[-1] - curve_x[0])  # the last row may be a step short of its end
    y = numpy.where((x > curve_x[-1]) & (x <= reach), curve_y[-1], y)
    if len(curve_x) > 1:
        slope = (curve_y[1] - curve_y[0]) / (curve_x[1] - curve_x[0])
        y = numpy.where(x < curve_x[0], curve_y[0] + slope * (x - curve_x[0]), y)
    return y
