# SPDX-License-Identifier: BSD-3-Clause
"""calibration.html: the whole result on one page that needs nothing but itself."""
from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from typing import Any

from .fitting import Fit

STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#1b1f24;background:#fff}
table{border-collapse:collapse;margin:1rem 0}td,th{padding:.25rem .8rem;border-bottom:1px solid #d8dee4;text-align:left}
td.n{text-align:right;font-variant-numeric:tabular-nums}img{max-width:100%;height:auto}.no{color:#b3400a;font-weight:600}
.ok{color:#1a7f37;font-weight:600}figure{margin:1.2rem 0}figcaption{color:#57606a}"""
FIGURES = (("fit.png", "Measured values with their errors (95 %), the run with the best values, the band of the posterior, and residuals."),
           ("profiles.png", "Profile likelihoods. The shaded part is the 95 % interval; a flat line is a parameter that the data do not see."),
           ("pairs.png", "Trials (crosses) and samples of the posterior (points). A narrow slanted cloud is a combination of parameters that "
            "the data see better than either of them."),
           ("search.png", "Misfit of every trial."))


def _verdict(p: dict[str, Any]) -> str:
    if not p["identified"]:
        return f"<span class=no>not identified</span>: {escape(p['why_not'])}"
    if p["at_bound"]:
        return f"<span class=no>at its {p['at_bound']} bound</span>: the range may be too narrow"
    return "<span class=ok>identified</span>"


def _parameter_rows(stage: dict[str, Any]) -> str:
    return "".join(f"<tr><td><code>{escape(p['key'])}</code></td><td class=n>{p['best']:.4g}</td><td class=n>{p['interval_low']:.4g} to "
                   f"{p['interval_high']:.4g}</td><td>{escape(p['unit'])}</td><td class=n>{p['range'][0]:g} to {p['range'][1]:g}</td>"
                   f"<td>{_verdict(p)}</td></tr>" for p in stage["parameters"])


def _correlations(stage: dict[str, Any]) -> str:
    keys = [p["key"] for p in stage["parameters"]]
    if len(keys) < 2:
        return ""
    head = "".join(f"<th>{escape(key)}</th>" for key in keys)
    rows = "".join(f"<tr><th>{escape(key)}</th>" + "".join(f"<td class=n>{value:.2f}</td>" for value in row) + "</tr>"
                   for key, row in zip(keys, stage["correlations"]))
    return f"<h3>Correlations in the posterior</h3><table><tr><th></th>{head}</tr>{rows}</table>"


def _remarks(stage: dict[str, Any]) -> str:
    remarks = []
    if stage["inflation"] > 1.0:
        remarks.append(f"The model misses the data by more than their errors (the best chi-squared is {stage['inflation']:.1f} per degree of "
                       "freedom): the intervals were widened as if the errors were larger by the root of that. Look at the residuals.")
    if stage["surrogate_error"] > 1.0:
        remarks.append(f"Surrogate and run differ by {stage['surrogate_error']:.1f} errors of measurement at the best values: more trials "
                       "would narrow the intervals.")
    if stage["failed_trials"]:
        remarks.append(f"{stage['failed_trials']} trials failed; trials.csv says why.")
    if stage["given_by_earlier_stages"]:
        given = ", ".join(f"<code>{escape(k)}</code> = {escape(str(v))}" for k, v in stage["given_by_earlier_stages"].items())
        remarks.append(f"Found by earlier stages and held: {given}.")
    return "".join(f"<p>{remark}</p>" for remark in remarks)


def _stage(folder: Path, stage: dict[str, Any]) -> str:
    figures = []
    for name, caption in FIGURES:
        data = base64.b64encode((folder / stage["folder"] / name).read_bytes()).decode()
        figures.append(f"<figure><img alt=\"{escape(caption)}\" src=\"data:image/png;base64,{data}\"><figcaption>{caption}</figcaption></figure>")
    return (f"<h2>{escape(stage['name'])}</h2><p>{stage['trials']} points, {stage['runs']} runs. Chi-squared over the number of values, at "
            f"the best values: {stage['misfit_per_value']:.2f}.</p>{_remarks(stage)}<table><tr><th>parameter</th><th>best</th><th>95 % interval</th>"
            f"<th>unit</th><th>range</th><th></th></tr>{_parameter_rows(stage)}</table>{figures[0]}{figures[1]}{_correlations(stage)}"
            f"{figures[2]}{figures[3]}")


def _predictions(result: dict[str, Any]) -> str:
    rows = ""
    for prediction in result["predictions"]:
        for data in prediction["data"] or [{"name": "", "misfit_per_value": None}]:
            misfit = "" if data["misfit_per_value"] is None else f"{data['misfit_per_value']:.2f}"
            rows += (f"<tr><td>{escape(prediction['name'])}</td><td>{escape(data['name'])}</td><td class=n>{misfit}</td>"
                     f"<td><code>{escape(prediction['folder'])}</code></td></tr>")
    return ("<h2>Predicted, never fitted</h2><table><tr><th>test</th><th>data</th><th>chi-squared / values</th><th>folder</th></tr>"
            f"{rows}</table>") if rows else ""


def write_page(folder: Path, result: dict[str, Any], fits: list[Fit]) -> None:
    name = escape(result["name"])
    runs = sum(fit.runs for fit in fits)
    word = "stage" if len(fits) == 1 else "stages"
    body = "".join(_stage(folder, stage) for stage in result["stages"])
    text = (f"<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width\"><title>{name}: calibration"
            f"</title><style>{STYLE}</style><h1>{name}: calibration</h1><p>{runs} runs in {len(fits)} {word}. Intervals hold measurement "
            f"error, differences between seeds, and what the surrogate does not know.</p>{body}{_predictions(result)}</html>\n")
    (folder / "calibration.html").write_text(text, encoding="utf-8")
