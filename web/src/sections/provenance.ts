// SPDX-License-Identifier: BSD-3-Clause
// Where a test comes from: its inputs, the command that repeats it, fingerprints, and every number of summary.json.
import type { Test } from "../data.ts";
import { el } from "../dom.ts";
import { command } from "../controls.ts";
import { labelOf } from "../numbers.ts";
import { scalar } from "../value.ts";

export function inputs(test: Test): HTMLElement[] {
  if (test.inputs.length === 0) return [el("p", {}, "The folder holds no resolved case.")];
  return test.inputs.map(({ section, rows }) =>
    el("details", { class: "inputs" },
      el("summary", {}, section === "" ? "Case" : `[${section}]`, el("span", { class: "count" }, ` ${rows.length} keys`)),
      el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": `Inputs of ${section || "the case"}` },
        el("table", { class: "wide-table stacked" },
          el("thead", {}, el("tr", {}, ...["Key", "Value", "Meaning"].map((name) => el("th", { scope: "col" }, name)))),
          el("tbody", {}, ...rows.map((row) => el("tr", {}, el("th", { scope: "row" }, el("code", {}, row.key)), el("td", { class: "text" }, row.value), el("td", { class: "prose" }, row.comment))))))));
}

/** Scalars of a record with their paths; lists of records come as place.name. */
function scalars(record: unknown, path: string): [string, unknown][] {
  if (record === null || typeof record !== "object") return [[path, record]];
  return Object.entries(record).flatMap(([key, value]) => scalars(value, path ? `${path}.${key}` : key));
}

export function allNumbers(test: Test): HTMLElement | null {
  const rows = scalars(test.summary, "").filter(([path]) => !path.startsWith("warnings."));
  if (rows.length === 0) return null;
  const box = el("details", { class: "inputs" }, el("summary", {}, "All numbers of the summary", el("span", { class: "count" }, ` ${rows.length}`)));
  box.addEventListener("toggle", () => {
    if (!box.open || box.querySelector("table")) return;
    const body = rows.map(([path, value]) => el("tr", {}, el("th", { scope: "row" }, el("code", {}, path)), el("td", {}, scalar(value, `summary.${path}`))));
    box.append(el("div", { class: "table-box tall", tabindex: 0, role: "group", "aria-label": `All numbers of ${test.name}` },
      el("table", {}, el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Name"), el("th", { scope: "col" }, "Value"))), el("tbody", {}, ...body))));
  });
  return box;
}

const FACTS = ["version", "commit", "compiler", "build_type", "processor_target", "threads", "seed", "steps", "time_step_s", "wall_time_s"];

export function provenance(test: Test): HTMLElement[] {
  const facts = FACTS.filter((name) => test.summary[name] !== undefined && test.summary[name] !== null);
  return [
    el("p", { class: "subtitle" }, "Command that repeats the test"), command(test.command),
    el("dl", { class: "plain" },
      el("dt", {}, "Folder"), el("dd", { class: "text" }, test.folder),
      ...(test.state_hash ? [el("dt", {}, "Hash of the last state"), el("dd", {}, el("code", {}, test.state_hash))] : []),
      ...facts.flatMap((name) => [el("dt", {}, labelOf(name)), el("dd", {}, scalar(test.summary[name], `summary.${name}`))])),
    ...[allNumbers(test)].filter((one): one is HTMLDetailsElement => one !== null),
  ];
}
