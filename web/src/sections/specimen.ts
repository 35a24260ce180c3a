// SPDX-License-Identifier: BSD-3-Clause
// The specimen itself: grading asked for and simulated sieve, forces on the walls and K0.
import type { Test } from "../data.ts";
import { emptyFigure } from "../chart/figure.ts";
import type { ChartGroup } from "../chart/group.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { type Column, column, hasNumbers } from "../tables.ts";
import { labelOf } from "../numbers.ts";
import { measured, numberAt } from "../value.ts";
import { DISPLACEMENT } from "./shear_curves.ts";

export function sieveChart(test: Test): HTMLElement {
  const title = "Grading and simulated sieve";
  const materials = test.sieve?.materials ?? [];
  const series = materials.flatMap((material, k): Series[] => {
    const name = material.name === "both" ? "Both" : labelOf(material.name);
    const at = `sieve.materials.${k}`;
    const common = { x: material.sieve_mm as Column, sourceX: `${at}.sieve_mm`, test: test.name, colour: [0, 1, 2][k] ?? k };
    const sieved: Series = { ...common, name: `${name}, sieved`, y: material.passing_per_cent, draw: "points", symbol: k, sourceY: `${at}.passing_per_cent` };
    const asked: Series = { ...common, name: `${name}, asked for`, y: material.target_per_cent, draw: "line", dash: k, sourceY: `${at}.target_per_cent` };
    return [asked, sieved].filter((one) => hasNumbers(one.y));
  });
  if (series.length === 0) return emptyFigure(title, "No specimen is stored.");
  const openings = materials.flatMap((material) => material.sieve_mm).filter((opening) => opening > 0);
  return xyChart({
    title, x: { label: "Sieve opening", unit: "mm", log: true, low: 0.9 * Math.min(...openings), high: 1.05 * Math.max(...openings), exact: true }, y: { label: "Passing by mass", unit: "%", low: 0, high: 100 },
    series, cursor: "nearest", caption: ["Square openings, shares by mass."],
  });
}

/** Several columns of walls.csv added up with signs. */
function sum(test: Test, parts: [string, number][]): Column {
  const columns = parts.map(([name, factor]) => [column(test.tables.walls, name), factor] as const);
  const rows = column(test.tables.walls, "displacement_mm")?.length ?? 0;
  return Array.from({ length: rows }, (_, row) => {
    let total = 0;
    for (const [values, factor] of columns) {
      const value = values?.[row] ?? null;
      if (value === null) return null;
      total += factor * value;
    }
    return total;
  });
}

export function wallCharts(test: Test, group: ChartGroup): HTMLElement[] {
  const x = column(test.tables.walls, "displacement_mm");
  if (!hasNumbers(x)) return [emptyFigure("Forces on the walls", "There are no rows of walls.csv yet.")];
  const one = (name: string, source: string, colour: number): Series =>
    ({ name, x, y: column(test.tables.walls, source) ?? [], draw: "line", colour, dash: colour, sourceX: "walls.displacement_mm", sourceY: `walls.${source}`, test: test.name });
  const along = [
    one("Wall x min", "lower_xmin_fx_N", 0), one("Wall x max", "lower_xmax_fx_N", 1),
    one("Bottom plate", "bottom_plate_fx_N", 2), one("Ledge", "lower_wing_fx_N", 3),
  ].filter((series) => hasNumbers(series.y));
  const across = [
    one("Lower half, y min", "lower_ymin_fy_N", 0), one("Lower half, y max", "lower_ymax_fy_N", 1),
    one("Upper half, y min", "upper_ymin_fy_N", 2), one("Upper half, y max", "upper_ymax_fy_N", 3),
  ].filter((series) => hasNumbers(series.y));
  const vertical: Series[] = [
    one("Top plate", "top_plate_fz_N", 0),
    { name: "Bottom plate, upwards", x, y: sum(test, [["bottom_plate_fz_N", -1]]), draw: "line", colour: 1, dash: 1 },
    { name: "Ledges", x, y: sum(test, [["lower_wing_fz_N", 1], ["upper_wing_fz_N", 1]]), draw: "line", colour: 3, dash: 3 },
  ].filter((series): series is Series => hasNumbers(series.y));
  const k0 = numberAt(test.summary, "k0_x") === null ? [] : [
    "K₀ before shear: ", measured(test.summary, "summary", "k0_x"), " along and ", measured(test.summary, "summary", "k0_y"), " across the shear direction. "];
  const force = (label: string) => ({ label, unit: "N" });
  return [
    xyChart({ title: "Lower half along the shear direction", x: DISPLACEMENT, y: force("Force of the grains, x"), group, series: along, caption: ["Their sum over the area is the shear stress, with the other sign."] }),
    xyChart({ title: "Side walls across the shear direction", x: DISPLACEMENT, y: force("Force of the grains, y"), group, series: across, caption: k0 }),
    xyChart({ title: "Vertical forces", x: DISPLACEMENT, y: force("Force of the grains, z"), group, series: vertical, caption: [] }),
  ];
}
