# SPDX-License-Identifier: BSD-3-Clause
"""Reads and checks a desk file; every problem is reported at once, with its line."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy

from ..cases import Case
from ..errors import CaseError, Error
from .data import CURVES, NUMBERS, Series, errors_of, read_curve, thinned
from .desk import Desk, Experiment, Parameter, Prediction, Stage, digest_of, is_mixture, with_changes
from .problems import Place, Problems

_VALUE = re.compile(r"^\s*([+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?)\s*([^\s0-9].*?)?\s*$")
DESK_KEYS = ("name", "seed", "stage", "predict")
STAGE_KEYS = ("name", "case", "trials", "start", "batch", "seeds", "specimens", "replicates", "allow_mixtures", "set", "full", "parameter",
              "data")
PARAMETER_KEYS = ("key", "low", "high", "scale", "prior_mean", "prior_deviation")
DATA_KEYS = ("name", "quantity", "x", "file", "x_column", "y_column", "x_factor", "y_factor", "points", "values", "value", "error",
             "common_error", "set")
PREDICT_KEYS = ("name", "case", "set", "data")
MOST_PARAMETERS = 8


class DeskReader:
    """Turns the tables of a desk file into a Desk."""

    def __init__(self, tree: dict, text: str, path: Path):
        self._tree, self._folder = tree, path.parent
        self._problems = Problems(path, text)
        self._stem = path.stem

    def desk(self) -> Desk:
        tree, problems = self._tree, self._problems
        problems.unknown((), tree, DESK_KEYS, "the desk")
        seed = self._whole((), tree, "seed", 1, 0, 1_000_000)
        stages: list[Stage] = []
        for k, section in enumerate(self._sections((), tree, "stage")):
            stages.append(self._stage(("stage", k), section, stages, seed + 100_000 * k))
        if not tree.get("stage"):
            problems.add((), "a desk needs at least one [[stage]]")
        names = [stage.name for stage in stages]
        for k, name in enumerate(names):
            if name in names[:k]:
                problems.add(("stage", k, "name"), f"name = \"{name}\" is taken by an earlier stage")
        found = {p.key for stage in stages for p in stage.parameters}
        predictions = [self._prediction(("predict", k), section, found)
                       for k, section in enumerate(self._sections((), tree, "predict"))]
        problems.raise_any()
        name = tree.get("name", self._stem)
        return Desk(self._folder / self._stem, str(name), stages, predictions, digest_of(stages, predictions))

    # ---- simple values -----------------------------------------------------------------------------------------------
    def _sections(self, place: Place, section: dict, key: str) -> list[dict]:
        found = section.get(key, [])
        if isinstance(found, list) and all(isinstance(item, dict) for item in found):
            return found
        name = ".".join([part for part in place if isinstance(part, str)] + [key])
        self._problems.add((*place, key), f"{key} is a list of sections: write [[{name}]]")
        return []

    def _whole(self, place: Place, section: dict, key: str, default: int, low: int, high: int) -> int:
        value = section.get(key, default)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            self._problems.add((*place, key), f"{key} = {value!r} is not a whole number in [{low}, {high}]")
            return default
        return value

    def _number(self, place: Place, section: dict, key: str, default: float) -> float:
        value = section.get(key, default)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not numpy.isfinite(value) or value == 0:
            self._problems.add((*place, key), f"{key} = {value!r} is not a number other than 0")
            return default
        return float(value)

    def _word(self, place: Place, section: dict, key: str, default: str | None = None) -> str:
        value = section.get(key, default)
        if isinstance(value, str) and value:
            return value
        self._problems.add((*place, key), f"{key} is needed, as text" if value is None else f"{key} = {value!r} is no text")
        return ""

    def _base(self, place: Place, section: dict) -> Case | None:
        name = self._word(place, section, "case")
        if not name:
            return None
        changes = self._changes(place, section, "set")
        try:
            return Case.read(self._folder / name, changes)
        except Error as error:
            for problem in getattr(error, "problems", [str(error)]):
                self._problems.add((*place, "case" if "--set" not in problem else "set"), problem.splitlines()[0])
            return None

    def _changes(self, place: Place, section: dict, key: str) -> dict[str, Any]:
        found = section.get(key, {})
        if not isinstance(found, dict):
            self._problems.add((*place, key), f"{key} is a table of case keys and values")
            return {}
        return _flat(found)

    def _changed(self, place: Place, case: Case, changes: dict[str, Any]) -> Case | None:
        try:
            return with_changes(case, changes)
        except CaseError as error:
            for problem in error.problems:
                self._problems.add(place, problem.splitlines()[0])
            return None

    # ---- a stage -----------------------------------------------------------------------------------------------------
    def _stage(self, place: Place, section: dict, earlier: list[Stage], seed: int) -> Stage:
        problems = self._problems
        problems.unknown(place, section, STAGE_KEYS, "[[stage]]")
        name = self._word(place, section, "name", f"stage {place[-1] + 1}")
        base = self._base(place, section)
        fixed = {**self._changes(place, section, "set"), **self._changes(place, section, "full")}
        parameters = [p for k, s in enumerate(self._sections(place, section, "parameter"))
                      if (p := self._parameter((*place, "parameter", k), s, base, fixed))]
        keys = [p.key for p in parameters]
        for k, key in enumerate(keys):
            if key in keys[:k]:
                problems.add((*place, "parameter", k, "key"), f"key = \"{key}\" is fitted twice in one stage")
        if not 1 <= len(self._sections(place, section, "parameter")) <= MOST_PARAMETERS:
            problems.add(place, f"stage \"{name}\" has {len(section.get('parameter', []))} of 1 to {MOST_PARAMETERS} [[stage.parameter]]")
        experiments: list[Experiment] = []
        series = self._data(place, section, base, experiments, name)
        if not section.get("data"):
            problems.add(place, f"stage \"{name}\" has no [[stage.data]]: nothing to fit")
        if section.get("allow_mixtures") is not True:
            self._refuse_mixtures(place, section, experiments)
        full = self._changes(place, section, "full") if "full" in section else None
        if full is not None and base is not None:
            self._changed((*place, "full"), base, full)
        dimension = max(1, len(parameters))
        trials = self._whole(place, section, "trials", 20 * dimension, 4 * dimension + 2, 10_000)
        start = self._whole(place, section, "start", min(8 * dimension, trials // 2), 2 * dimension + 1, trials)
        given = {key: stage.name for stage in earlier for key in (p.key for p in stage.parameters)
                 if base is not None and key in base and key not in keys and key not in fixed}
        has_noise = base is not None and base.test == "direct_shear"
        return Stage(name, parameters, series, experiments, trials, self._whole(place, section, "batch", 4, 1, 100), start,
                     self._whole(place, section, "seeds", 1, 1, 100), self._whole(place, section, "specimens", 1, 1, 1000),
                     self._whole(place, section, "replicates", 4 if has_noise else 0, 0, 100), seed, full, given)

    def _refuse_mixtures(self, place: Place, section: dict, experiments: list[Experiment]) -> None:
        """Mixtures are what a calibrated model predicts: fitted to them it predicts nothing."""
        mixed = [e for e in experiments if is_mixture(e.case)]
        if mixed:
            content = mixed[0].case.si("specimen.rubber_content")
            self._problems.add((*place, "allow_mixtures") if "allow_mixtures" in section else (*place, "case"),
                               f"test \"{mixed[0].name}\" is of a mixture (specimen.rubber_content = {content:g}): mixtures are predicted "
                               "with [[predict]], not fitted; allow_mixtures = true in the stage fits them all the same")

    def _parameter(self, place: Place, section: dict, base: Case | None, fixed: dict) -> Parameter | None:
        problems = self._problems
        before = len(problems.found)
        problems.unknown(place, section, PARAMETER_KEYS, "[[stage.parameter]]")
        key = self._word(place, section, "key")
        ends = {end: self._quantity(place, section, end) for end in ("low", "high")}
        prior = {end: self._quantity(place, section, end) for end in ("prior_mean", "prior_deviation") if end in section}
        scale = section.get("scale", "linear")
        if scale not in ("linear", "log"):
            problems.add((*place, "scale"), f"scale = {scale!r} is neither \"linear\" nor \"log\"")
        if key in fixed:
            problems.add((*place, "key"), f"key = \"{key}\" is fitted and set in [stage.set] or [stage.full]")
        if len(prior) == 1:
            problems.add(place, "a prior has both prior_mean and prior_deviation")
        if base is not None and key:
            self._check_ends(place, section, base, key)
        if any(value is None for value in (*ends.values(), *prior.values())) or len(problems.found) > before:
            return None
        units = {unit for _, unit in (*ends.values(), *prior.values())}
        if len(units) > 1:
            problems.add((*place, "low"), f"low, high and prior are in different units: {', '.join(sorted(u or 'none' for u in units))}")
            return None
        low, high = ends["low"][0], ends["high"][0]
        if not low < high or (scale == "log" and low <= 0.0):
            problems.add((*place, "low"), f"low = {section['low']!r} has to be below high = {section['high']!r}"
                         + (", and above 0 on a log scale" if scale == "log" else ""))
            return None
        if prior and (not low <= prior["prior_mean"][0] <= high or prior["prior_deviation"][0] <= 0.0):
            problems.add((*place, "prior_mean"), f"prior_mean lies in [{section['low']}, {section['high']}], prior_deviation above 0")
            return None
        given = (prior["prior_mean"][0], prior["prior_deviation"][0]) if prior else None
        return Parameter(key, low, high, units.pop(), scale == "log", given)

    def _check_ends(self, place: Place, section: dict, base: Case, key: str) -> None:
        """By the rules of the case: whether there is such a key, and whether it may have these values."""
        for end in ("low", "high"):
            if end in section:
                try:
                    with_changes(base, {key: section[end]})
                except CaseError as error:
                    is_value = "outside" in error.problems[0] or "unit" in error.problems[0].splitlines()[0]
                    message = error.problems[0].splitlines()[0].split("error: ")[-1]
                    self._problems.add((*place, end if is_value else "key"), message)
                    if not is_value:
                        return

    def _quantity(self, place: Place, section: dict, key: str) -> tuple[float, str] | None:
        value = section.get(key)
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return float(value), ""
        found = _VALUE.match(value) if isinstance(value, str) else None
        if not found:
            self._problems.add((*place, key), f"{key} is needed, a number or text with a number and a unit" if value is None
                               else f"{key} = {value!r} is no number, nor text with a number and a unit")
            return None
        return float(found[1]), found[2] or ""

    # ---- data --------------------------------------------------------------------------------------------------------
    def _data(self, place: Place, section: dict, base: Case | None, experiments: list[Experiment], name: str) -> list[Series]:
        series = []
        for k, item in enumerate(self._sections(place, section, "data")):
            here = (*place, "data", k)
            self._problems.unknown(here, item, DATA_KEYS, "[[stage.data]]" if place[0] == "stage" else "[[predict.data]]")
            test = self._experiment(here, item, base, experiments, name)
            found = self._series(here, item, base.test if base else "direct_shear")
            if found is not None and test is not None:
                found.test = test
                self._check_reach(here, found, experiments[test].case)
                series.append(found)
        return series

    def _experiment(self, place: Place, item: dict, base: Case | None, experiments: list[Experiment], name: str) -> int | None:
        changes = self._changes(place, item, "set")
        for k, known in enumerate(experiments):
            if known.changes == changes:
                return k
        case = self._changed((*place, "set"), base, changes) if base is not None else None
        if case is None:
            return None
        words = ", ".join(f"{key.split('.')[-1]} {value}" for key, value in changes.items())
        experiments.append(Experiment(words or name, changes, case))
        return len(experiments) - 1

    def _series(self, place: Place, item: dict, test: str) -> Series | None:
        problems = self._problems
        quantity = self._word(place, item, "quantity")
        kinds = [kind for kind in ("file", "values", "value") if kind in item]
        if len(kinds) != 1:
            problems.add(place, "data is one of file (a CSV file), values (a list of [x, y]) or value (a number of the summary)")
            return None
        is_number = kinds[0] == "value"
        allowed = (NUMBERS if is_number else CURVES)[test]
        if quantity and quantity not in allowed:
            problems.add((*place, "quantity"), f"quantity = \"{quantity}\" is no {'number' if is_number else 'column'} of a {test} test; "
                         f"allowed are {', '.join(allowed)}")
        if is_number:
            x, y = numpy.empty(0), numpy.array([self._number(place, item, "value", 1.0)])
            abscissa = ""
        else:
            abscissa = self._word(place, item, "x", "displacement_mm")
            if abscissa not in CURVES[test]:
                problems.add((*place, "x"), f"x = \"{abscissa}\" is no column of a {test} test; allowed are {', '.join(CURVES[test])}")
            curve = self._curve(place, item, kinds[0], abscissa, quantity)
            if curve is None:
                return None
            x, y = curve
        error, common = errors_of(item.get("error", -1), y), errors_of(item.get("common_error", 0.0), y)
        if error is None or not (error > 0.0).all():
            problems.add((*place, "error"), "error, the standard deviation of the measurement, is needed and above 0 for every value: a "
                         "number in the unit of the quantity, \"3 %\", or a list of both, which matters where values are 0")
            return None
        if common is None:
            problems.add((*place, "common_error"), "common_error is a number, a text like \"2 %\", or a list of both")
            return None
        source = item.get("file", "")
        return Series(str(item.get("name", quantity)), quantity, abscissa, x, y, error, common, source=str(source))

    def _curve(self, place: Place, item: dict, kind: str, abscissa: str, quantity: str):
        problems = self._problems
        if kind == "values":
            try:
                rows = numpy.array(item["values"], dtype=float)
            except (TypeError, ValueError):
                rows = numpy.empty(0)
            if rows.ndim != 2 or rows.shape[1] != 2 or not len(rows) or not numpy.isfinite(rows).all():
                problems.add((*place, "values"), "values is a list of pairs of numbers: [[x, y], ...]")
                return None
            x, y = rows.T
        else:
            name = self._word(place, item, "file")
            found = read_curve(self._folder / name, item.get("x_column", abscissa), item.get("y_column", quantity))
            if found.problem:
                problems.add((*place, "file"), f"{self._folder / name}: {found.problem}")
                return None
            x, y = found.x, found.y
        x = x * self._number(place, item, "x_factor", 1.0)
        y = y * self._number(place, item, "y_factor", 1.0)
        return thinned(x, y, self._whole(place, item, "points", 40, 2, 500))

    def _check_reach(self, place: Place, series: Series, case: Case) -> None:
        ends = {("grain_compression", "strain"): ("compression.strain", 1.0),
                ("direct_shear", "displacement_mm"): ("shear.displacement", 1e3)}
        key, factor = ends.get((case.test, series.abscissa), ("", 1.0))
        if key and series.x.max() > (reach := factor * float(case.si(key))) * 1.01:  # a test ends a step away from its end
            self._problems.add((*place, "file" if series.source else "values"),
                               f"{series.name} reaches to {series.abscissa} = {series.x.max():g}, but {key} ends the test at {reach:g}")

    def _prediction(self, place: Place, section: dict, found: set[str]) -> Prediction:
        self._problems.unknown(place, section, PREDICT_KEYS, "[[predict]]")
        name = self._word(place, section, "name", f"prediction {place[-1] + 1}")
        base = self._base(place, section)
        experiments: list[Experiment] = [] if base is None else [Experiment(name, {}, base)]
        series = self._data(place, section, base, experiments, name)
        if len(experiments) > 1:
            self._problems.add(place, "a [[predict]] is one test: its data have no set of their own")
        case = experiments[0] if experiments else Experiment(name, {}, Case.new())
        return Prediction(name, case, series)


def _flat(table: dict, before: str = "") -> dict[str, Any]:
    """Keys with their sections, whether they were written as "shear.velocity" or as tables."""
    flat: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            flat.update(_flat(value, f"{before}{key}."))
        else:
            flat[before + key] = value
    return flat
