// SPDX-License-Identifier: BSD-3-Clause
// Several tests on the same axes, with one legend that switches them off in all charts.
import type { LaboratoryCurve, Test } from "../data.ts";
import { el } from "../dom.ts";
import { ChartGroup } from "../chart/group.ts";
import { legend } from "../chart/legend.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { column, hasNumbers } from "../tables.ts";
import { measured } from "../value.ts";
import { charts } from "./part.ts";
import { DISPLACEMENT, laboratorySeries, present, shearSeries } from "./shear_curves.ts";
import { microSeries } from "./network.ts";
import { badge, testVerdict } from "./verdict.ts";

const LOOKS = (place: number) => ({ colour: place, dash: place % 6 });

export function overlay(tests: Test[], laboratory: LaboratoryCurve[]): HTMLElement[] {
  const sheared = tests.filter((test) => hasNumbers(column(test.tables.shear, "shear_stress_kPa")));
  const compressed = tests.filter((test) => hasNumbers(column(test.tables.compression, "load_N")));
  const parts: HTMLElement[] = [];
  if (sheared.length > 1) {
    const group = new ChartGroup("overlay");
    const measuredCurves = [...laboratorySeries(laboratory, null, "shear_stress_kPa"), ...laboratorySeries(laboratory, null, "vertical_displacement_mm")];
    const key = legend([
      ...sheared.map((test, place) => ({ name: test.name, key: test.name, draw: "line" as const, ...LOOKS(place) })),
      ...measuredCurves.filter((one, place) => measuredCurves.findIndex(({ name }) => name === one.name) === place).map((one) => ({ ...one, key: one.name })),
    ], group, "all charts of this part");
    const chart = (title: string, label: string, unit: string, y: string, lab?: "shear_stress_kPa" | "vertical_displacement_mm") => xyChart({
      title, x: DISPLACEMENT, y: { label, unit }, group, legend: false, cursor: "nearest",
      series: [
        ...present(...sheared.map((test, place) => shearSeries(test, test.name, y, LOOKS(place)))),
        ...(lab ? laboratorySeries(laboratory, null, lab) : []),
      ],
    });
    const microChart = (title: string, label: string, unit: string, y: string) => xyChart({
      title, x: DISPLACEMENT, y: { label, unit }, group, legend: false, cursor: "nearest",
      series: present(...sheared.map((test, place) => microSeries(test, test.name, y, LOOKS(place)))),
    });
    parts.push(el("div", { class: "shared-legend" }, key.element), charts(
      chart("Shear stress of all tests", "Shear stress", "kPa", "shear_stress_kPa", "shear_stress_kPa"),
      chart("Vertical displacement of all tests", "Rise of the top plate", "mm", "vertical_displacement_mm", "vertical_displacement_mm"),
      chart("Normal stress of all tests", "Normal stress", "kPa", "normal_stress_kPa"),
      microChart("Anisotropy of the normal forces", "aₙ", "", "a_n_all"),
    ));
  }
  if (compressed.length > 1) {
    parts.push(charts(xyChart({
      title: "Load of all tests", x: { label: "Strain", low: 0, exact: true }, y: { label: "Load", unit: "N", low: 0 }, cursor: "nearest",
      series: compressed.map((test, place): Series => ({
        name: test.name, x: column(test.tables.compression, "strain") ?? [], y: column(test.tables.compression, "load_N") ?? [], draw: "line",
        sourceX: "grain.strain", sourceY: "grain.load_N", test: test.name, ...LOOKS(place),
      })),
    })));
  }
  return parts;
}

const COLUMNS: [string, string][] = [
  ["Peak shear stress", "peak_shear_stress_kPa"], ["at", "displacement_at_peak_mm"], ["Residual", "residual_shear_stress_kPa"],
  ["Dilation angle", "dilation_angle_deg"], ["Void ratio before shear", "void_ratio_before_shear"], ["Load at the end", "load_at_end_N"],
];

export function testTable(tests: Test[], addressOf: (test: Test) => string): HTMLElement {
  const shown = COLUMNS.filter(([, name]) => tests.some((test) => typeof test.summary[name] === "number"));
  const rows = tests.map((test) => el("tr", { "data-test": test.name },
    el("th", { scope: "row" }, el("a", { href: addressOf(test) }, test.name)), el("td", {}, badge(testVerdict(test))),
    ...shown.map(([, name]) => el("td", {}, measured(test.summary, "summary", name)))));
  const head = el("tr", {}, ...["Test", "State", ...shown.map(([text]) => text)].map((name) => el("th", { scope: "col" }, name)));
  return el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": "All tests" },
    el("table", { class: "wide-table" }, el("thead", {}, head), el("tbody", {}, ...rows)));
}
