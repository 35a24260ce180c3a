# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration found, as files (result.json, trials.csv, samples.csv) and as an object."""
from __future__ import annotations

import json
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas

from ..errors import MissingFileError

if TYPE_CHECKING:
    from .fitting import Fit


def trial_table(fit: Fit) -> pandas.DataFrame:
    """One row a trial: parameters, seed, misfit, or why it failed."""
    rows = []
    for record in fit.records:
        row = {"point": record["point"], "number": record["number"], "role": record["role"], "seed": record["seed"]}
        for parameter, position in zip(fit.stage.parameters, record["position"]):
            row[f"{parameter.key} [{parameter.unit}]" if parameter.unit else parameter.key] = float(parameter.value(position))
        row["misfit"] = record["misfit"] / len(fit.stage.y) if "misfit" in record else None
        row["state_hashes"] = " ".join(record.get("state_hashes", []))
        row["failure"] = record.get("failure", "")
        rows.append(row)
    return pandas.DataFrame(rows)


def stage_result(fit: Fit) -> dict[str, Any]:
    """Of a stage, for result.json."""
    stage = fit.stage
    parameters = []
    for estimate, parameter in zip(fit.estimates, stage.parameters):
        parameters.append({
            "key": estimate.key, "unit": estimate.unit, "best": estimate.best, "interval_low": estimate.low,
            "interval_high": estimate.high, "identified": estimate.is_identified, "why_not": estimate.why_not,
            "at_bound": estimate.at_bound, "range": [parameter.low, parameter.high], "scale": "log" if parameter.is_log else "linear",
            "prior": list(parameter.prior) if parameter.prior else None, "profile_values": estimate.grid,
            "profile_log_likelihood": estimate.profile})
    curves, noise, band = stage.parts(fit.best_curves), stage.parts(fit.noise), [stage.parts(edge) for edge in fit.band]
    full = stage.parts(fit.full_curves) if fit.full_curves is not None else [None] * len(curves)
    data = [{"name": s.name, "quantity": s.quantity, "x_quantity": s.abscissa, "test": stage.experiments[s.test].name, "x": s.x.tolist(),
             "measured": s.y.tolist(), "error": s.error.tolist(), "common_error": s.common.tolist(), "fitted": curves[k].tolist(),
             "fitted_low": band[0][k].tolist(), "fitted_high": band[1][k].tolist(), "seed_deviation": noise[k].tolist(),
             "full_size": full[k].tolist() if full[k] is not None else None} for k, s in enumerate(stage.series)]
    return {"name": stage.name, "parameters": parameters, "correlations": fit.correlations.tolist(),
            "best": fit.values, "given_by_earlier_stages": fit.given, "misfit_per_value": fit.misfit, "inflation": fit.inflation,
            "surrogate_error": fit.surrogate_error, "trials": stage.trials, "runs": fit.runs,
            "failed_trials": sum("failure" in record for record in fit.records), "data": data}


class Calibration:
    """A finished calibration: what `dem4grm.calibrate` returns.

    path     its folder, with calibration.html, result.json and for each stage trials.csv, samples.csv and figures
    result   everything of result.json
    """

    def __init__(self, folder: str | PathLike):
        """Raises MissingFileError when the folder holds no finished calibration."""
        self.path = Path(folder)
        try:
            self.result: dict[str, Any] = json.loads((self.path / "result.json").read_text(encoding="utf-8"))
        except OSError:
            raise MissingFileError(f"{self.path}: no finished calibration: it has no result.json") from None

    @property
    def stages(self) -> list[str]:
        """Names of the stages."""
        return [stage["name"] for stage in self.result["stages"]]

    def _stage(self, name: str | None) -> dict[str, Any]:
        for stage in self.result["stages"]:
            if name is None or stage["name"] == name:
                return stage
        raise KeyError(f"{name}; there are {', '.join(self.stages)}")

    @property
    def best(self) -> dict[str, Any]:
        """Best values of all stages as a case file has them: `case.update(calibration.best)`."""
        return {key: value for stage in self.result["stages"] for key, value in stage["best"].items()}

    @property
    def parameters(self) -> pandas.DataFrame:
        """One row a parameter: stage, best, interval_low, interval_high, unit, identified, why_not, at_bound."""
        columns = ["best", "interval_low", "interval_high", "unit", "identified", "why_not", "at_bound"]
        rows = [{"key": p["key"], "stage": stage["name"], **{c: p[c] for c in columns}}
                for stage in self.result["stages"] for p in stage["parameters"]]
        return pandas.DataFrame(rows).set_index("key")

    def correlations(self, stage: str | None = None) -> pandas.DataFrame:
        """Correlations of the parameters of a stage (the first one by default) in the posterior."""
        found = self._stage(stage)
        keys = [p["key"] for p in found["parameters"]]
        return pandas.DataFrame(found["correlations"], index=keys, columns=keys)

    def trials(self, stage: str | None = None) -> pandas.DataFrame:
        """All trials of a stage: parameters, seed, misfit (chi-squared over the number of values), failures."""
        return pandas.read_csv(self.path / self._stage(stage)["folder"] / "trials.csv", float_precision="round_trip")

    def samples(self, stage: str | None = None) -> pandas.DataFrame:
        """Samples of the posterior of a stage, one column a parameter, in its unit."""
        return pandas.read_csv(self.path / self._stage(stage)["folder"] / "samples.csv", float_precision="round_trip")

    def __repr__(self) -> str:
        return f"<dem4grm.Calibration {self.path}, {len(self.parameters)} parameters in {len(self.stages)} stages>"
