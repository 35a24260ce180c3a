// SPDX-License-Identifier: BSD-3-Clause
// Compression of one rubber grain between plates, from grain.csv: load, stiffness and Poisson's ratio against strain.
import type { Test } from "../data.ts";
import { emptyFigure } from "../chart/figure.ts";
import { ChartGroup } from "../chart/group.ts";
import { type Mark, xyChart } from "../chart/xy_chart.ts";
import { column, hasNumbers, slope } from "../tables.ts";
import { measured, numberAt } from "../value.ts";

const STRAIN = { label: "Strain", exact: true, low: 0 };
const HALF_WINDOW = 2;

export function compressionCharts(test: Test): HTMLElement[] {
  const table = test.tables.compression;
  const [strain, displacement, load] = [column(table, "strain"), column(table, "displacement_mm"), column(table, "load_N")];
  if (!strain || !displacement || !hasNumbers(load)) return [emptyFigure("", "There are no rows of grain.csv yet.")];
  const s = test.summary;
  const group = new ChartGroup();
  const knee = numberAt(s, "knee_strain");
  const marks: Mark[] = knee === null || knee === 0 ? [] : [{ along: "x", at: knee, text: "knee" }];
  const source = { sourceX: "grain.strain", test: test.name };
  const poisson = column(table, "poisson_ratio");
  const closed = column(table, "closed_second_neighbours");
  const late = numberAt(s, "late_stiffness_N_per_mm");
  return [
    xyChart({
      title: "Load", x: STRAIN, y: { label: "Load", unit: "N", low: 0 }, group, marks,
      series: [{ name: "Mean of both plates", x: strain, y: load, draw: "line", colour: 0, sourceY: "grain.load_N", ...source }],
      caption: numberAt(s, "load_at_end_N") === null ? [] : [
        measured(s, "summary", "load_at_end_N"), " at a strain of ", measured(s, "summary", "strain", 3),
        ...(knee === null ? [] : ["; second neighbours touch from ", measured(s, "summary", "knee_strain", 3), " on"]), "."],
    }),
    xyChart({
      title: "Tangent stiffness", x: STRAIN, y: { label: "dF/du", unit: "N/mm", low: 0 }, group, marks,
      series: [{ name: "Slope of five rows", x: strain, y: slope(displacement, load, HALF_WINDOW), draw: "line", colour: 1, sourceX: "grain.strain", test: test.name }],
      caption: numberAt(s, "initial_stiffness_N_per_mm") === null ? [] : [
        "2 to 8 % strain: ", measured(s, "summary", "initial_stiffness_N_per_mm"),
        ...(late === null ? [] : ["; last quarter: ", measured(s, "summary", "late_stiffness_N_per_mm")]), "."],
    }),
    poisson && hasNumbers(poisson) ? xyChart({
      title: "Poisson's ratio", x: STRAIN, y: { label: "Poisson's ratio, secant" }, group, marks,
      series: [{ name: "Inner cube of eight balls", x: strain, y: poisson, draw: "line", colour: 2, sourceY: "grain.poisson_ratio", ...source }],
      caption: numberAt(s, "poisson_ratio_initial") === null ? [] : ["Initial ", measured(s, "summary", "poisson_ratio_initial", 3), "."],
    }) : emptyFigure("Poisson's ratio", "grain.csv has no values of it."),
    closed && hasNumbers(closed) ? xyChart({
      title: "Second neighbours that touch", x: STRAIN, y: { label: "Closed pairs of balls", low: 0 }, group, marks,
      series: [{ name: "Closed pairs", x: strain, y: closed, draw: "line", colour: 3, sourceY: "grain.closed_second_neighbours", ...source }],
      caption: ["They stiffen the grain."],
    }) : emptyFigure("Second neighbours that touch", "grain.csv has no values of it."),
  ];
}
