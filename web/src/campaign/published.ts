// SPDX-License-Identifier: BSD-3-Clause
// Values of the literature beside those of the tests, with differences; and the specimens of a campaign in one table.
import type { PageData, PublishedValue, Test } from "../data.ts";
import { el } from "../dom.ts";
import { formatNumber, labelOf, unitOf, withUnit } from "../numbers.ts";
import { measured, numberAt, numberSpan } from "../value.ts";
import type { Values } from "./members.ts";

/** Does the row speak of the test? Contents as asked for are exact, those of a made specimen come near. */
export function speaksOf(row: PublishedValue, test: Test, values: Values | null): boolean {
  if (test.kind === "grain_compression") return false;
  const content = values?.rubber_content ?? numberAt(test.summary, "rubber_content");
  const stress = values?.normal_stress_kPa ?? numberAt(test.summary, "normal_stress_target_kPa");
  const near = typeof content === "number" && Math.abs(content - row.rubber_content) < 0.01;
  return near && (row.normal_stress_kPa === null || (typeof stress === "number" && Math.abs(stress - row.normal_stress_kPa) < 0.01 * row.normal_stress_kPa));
}

function differenceCells(ours: number | null, published: number, unit: string): HTMLElement[] {
  if (ours === null) return [el("td", {}, "–"), el("td", {}, "–")];
  const difference = ours - published;
  const sign = (value: number, text: string) => (value > 0 ? `+${text}` : text);
  const share = published === 0 ? "–" : sign(difference, `${formatNumber((100 * difference) / published, 2)}\u202f%`);
  return [el("td", { class: "number" }, sign(difference, withUnit(formatNumber(difference, 3), unit))), el("td", { class: "number" }, share)];
}

/** Tests that give the same number share a row. */
function rowsOf(data: PageData, place: number, tests: Test[]): HTMLElement[] {
  const row = data.published[place];
  if (!row) return [];
  const start = [
    el("th", { scope: "row" }, `${formatNumber(100 * row.rubber_content)}\u202f%`),
    el("td", {}, row.normal_stress_kPa === null ? "all" : withUnit(formatNumber(row.normal_stress_kPa), "kPa")),
    el("td", {}, numberSpan(row.value, `published.${place}.value`, unitOf(row.quantity))),
  ];
  const source = el("td", { class: "prose" }, row.source);
  const known = tests.filter((test) => numberAt(test.summary, row.quantity) !== null);
  if (known.length === 0) {
    return [el("tr", {}, ...start, el("td", { colspan: 3 }, tests.length > 0 ? "not finished" : "no such test"), el("td", {}, tests.map((test) => test.name).join(", ") || "–"), source)];
  }
  const values = [...new Set(known.map((test) => numberAt(test.summary, row.quantity)))];
  return values.map((value) => {
    const same = known.filter((test) => numberAt(test.summary, row.quantity) === value);
    const first = same[0] as Test;
    return el("tr", {}, ...start.map((cell) => cell.cloneNode(true) as HTMLElement),
      el("td", { "data-test": first.name }, measured(first.summary, "summary", row.quantity)), ...differenceCells(value, row.value, unitOf(row.quantity)),
      el("td", {}, same.length > 2 ? `${same.length} tests` : same.map((test) => test.name).join(", ")), source.cloneNode(true));
  });
}

export function publishedTables(data: PageData): HTMLElement[] {
  const valuesOf = (test: Test) => data.campaign?.tests.find((one) => one.name === test.name)?.values ?? null;
  const matches = data.published.map((row) => data.tests.filter((test) => speaksOf(row, test, valuesOf(test))));
  const quantities = [...new Set(data.published.map((row) => row.quantity))];
  return quantities.flatMap((quantity) => {
    const places = data.published.flatMap((row, place) => (row.quantity === quantity ? [place] : []));
    // A page of few tests shows what speaks of them; a campaign also what it misses.
    const shown = data.campaign ? places : places.filter((place) => (matches[place]?.length ?? 0) > 0);
    if (shown.length === 0 || !places.some((place) => (matches[place]?.length ?? 0) > 0)) return [];
    const head = ["VRC", "Normal stress", "Published", "Here", "Difference", "in %", "Tests", "Source"].map((name) => el("th", { scope: "col" }, name));
    return [
      el("p", { class: "subtitle" }, labelOf(quantity)),
      el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": `${labelOf(quantity)}, published and here` },
        el("table", { class: "wide-table" }, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...shown.flatMap((place) => rowsOf(data, place, matches[place] ?? []))))),
    ];
  });
}

const SPECIMEN = ["void_ratio_before_shear", "void_ratio_min", "void_ratio_max", "relative_density", "clumps", "rubber_grains", "balls", "rubber_content", "k0_x"];

export function specimenTable(tests: Test[], addressOf: (test: Test) => string): HTMLElement {
  const shown = SPECIMEN.filter((name) => tests.some((test) => typeof test.summary[name] === "number"));
  if (shown.length === 0) return el("p", {}, "No test is finished yet.");
  const head = ["Test", ...shown.map(labelOf)].map((name) => el("th", { scope: "col" }, name));
  const rows = tests.map((test) => el("tr", { "data-test": test.name },
    el("th", { scope: "row" }, el("a", { href: addressOf(test) }, test.name)), ...shown.map((name) => el("td", {}, measured(test.summary, "summary", name)))));
  return el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": "Specimens" },
    el("table", { class: "wide-table" }, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...rows)));
}
