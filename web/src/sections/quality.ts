// SPDX-License-Identifier: BSD-3-Clause
// Can the test be trusted: the checks with their limits and verdicts, and the warnings of the program.
import type { Test } from "../data.ts";
import { el } from "../dom.ts";
import { numberSpan } from "../value.ts";
import { badge, capital, qualityVerdict, toneBadge } from "./verdict.ts";

export function warningsOf(test: Test): string[] {
  const warnings = test.summary.warnings;
  return Array.isArray(warnings) ? warnings.map(String) : [];
}

export function qualityPanel(test: Test): HTMLElement[] {
  const verdict = qualityVerdict(test.quality);
  const warnings = warningsOf(test);
  // Warnings that stand in full below the table are no rows of it; the places in the data stay.
  const rows = test.quality.flatMap((line, place) => warnings.includes(line.limit) ? [] : [
    el("tr", {}, el("th", { scope: "row" }, capital(line.name)), el("td", {}, numberSpan(line.value, `quality.${place}.value`, line.unit)),
      el("td", { class: "prose" }, line.limit), el("td", {}, toneBadge(line.verdict)))]);
  const head = el("tr", {}, ...["Check", "Value", "What is good, and why", "Verdict"].map((name) => el("th", { scope: "col" }, name)));
  const table = el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": `Checks of ${test.name}` },
    el("table", { class: "wide-table stacked" }, el("thead", {}, head), el("tbody", {}, ...rows)));
  const words = warnings.length === 0
    ? el("p", {}, "The program gave no warnings.")
    : el("div", {}, el("p", { class: "subtitle" }, warnings.length === 1 ? "One warning of the program" : `${warnings.length} warnings of the program`),
      el("ul", { class: "warnings" }, ...warnings.map((text) => el("li", {}, el("pre", {}, text)))));
  return [el("p", {}, badge(verdict)), ...(rows.length > 0 ? [table] : []), words];
}
