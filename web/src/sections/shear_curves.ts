// SPDX-License-Identifier: BSD-3-Clause
// Stress, volume change and energy of direct shear tests against the displacement; of one test or of several on the same axes.
import type { LaboratoryCurve, Test } from "../data.ts";
import type { Child } from "../dom.ts";
import { emptyFigure } from "../chart/figure.ts";
import type { ChartGroup } from "../chart/group.ts";
import { type Mark, type Series, xyChart } from "../chart/xy_chart.ts";
import { type Column, column, hasNumbers } from "../tables.ts";
import { measured, numberAt } from "../value.ts";

export const DISPLACEMENT = { label: "Shear displacement", unit: "mm", exact: true, low: 0 };

/** One column of shear.csv as a series. */
export function shearSeries(test: Test, name: string, y: string, look: Omit<Series, "name" | "x" | "y" | "draw">, x = "displacement_mm"): Series | null {
  const across = column(test.tables.shear, x);
  const up = column(test.tables.shear, y);
  if (!across || !hasNumbers(up)) return null;
  return { name, x: across, y: up, draw: "line", sourceX: `shear.${x}`, sourceY: `shear.${y}`, test: test.name, ...look };
}

export function present(...series: (Series | null)[]): Series[] {
  return series.filter((one): one is Series => one !== null);
}

export function laboratorySeries(curves: LaboratoryCurve[], test: string | null, y: "shear_stress_kPa" | "vertical_displacement_mm"): Series[] {
  return curves.flatMap((curve, place) => {
    const values = curve[y];
    if (!values || (curve.test !== null && test !== null && curve.test !== test)) return [];
    return [{ name: `Laboratory: ${curve.name}`, x: curve.displacement_mm as Column, y: values, draw: "points" as const, colour: 7, symbol: place + 1 }];
  });
}

function shearStress(test: Test, laboratory: LaboratoryCurve[], group: ChartGroup): HTMLElement {
  const s = test.summary;
  const peak = numberAt(s, "displacement_at_peak_mm");
  const marks: Mark[] = peak === null ? [] : [{ along: "x", at: peak, text: "peak" }];
  const caption: Child[] = peak === null ? [] : [
    "Peak ", measured(s, "summary", "peak_shear_stress_kPa"), " at ", measured(s, "summary", "displacement_at_peak_mm"),
    ...(numberAt(s, "residual_shear_stress_kPa") === null ? [] : ["; residual ", measured(s, "summary", "residual_shear_stress_kPa")]), ". ",
    "Corrected: over the area that is left.",
  ];
  return xyChart({
    title: "Shear stress", x: DISPLACEMENT, y: { label: "Shear stress", unit: "kPa", low: 0 }, group, marks, caption,
    series: [
      ...present(
        shearSeries(test, "Nominal area", "shear_stress_kPa", { colour: 0 }),
        shearSeries(test, "Corrected area", "shear_stress_corrected_kPa", { colour: 1, dash: 1 }),
      ),
      ...laboratorySeries(laboratory, test.name, "shear_stress_kPa"),
    ],
  });
}

function normalStress(test: Test, group: ChartGroup): HTMLElement {
  const s = test.summary;
  const target = numberAt(s, "normal_stress_target_kPa");
  const caption: Child[] = target === null ? [] : [
    "Target ", measured(s, "summary", "normal_stress_target_kPa"), ", mean ", measured(s, "summary", "normal_stress_mean_kPa"),
    ". The corrected stress grows because the area shrinks.",
  ];
  return xyChart({
    title: "Normal stress", x: DISPLACEMENT, y: { label: "Normal stress", unit: "kPa" }, group, caption,
    marks: target === null ? [] : [{ along: "y", at: target, text: "target" }],
    series: present(
      shearSeries(test, "Nominal area", "normal_stress_kPa", { colour: 0 }),
      shearSeries(test, "Corrected area", "normal_stress_corrected_kPa", { colour: 1, dash: 1 }),
    ),
  });
}

function verticalDisplacement(test: Test, laboratory: LaboratoryCurve[], group: ChartGroup): HTMLElement {
  const s = test.summary;
  const caption: Child[] = numberAt(s, "dilation_angle_deg") === null ? [] : [
    "Dilation angle ", measured(s, "summary", "dilation_angle_deg"), "; at the end ", measured(s, "summary", "vertical_displacement_at_end_mm"),
    "; largest contraction ", measured(s, "summary", "largest_contraction_mm"), ". Rise of the plate is positive.",
  ];
  return xyChart({
    title: "Vertical displacement", x: DISPLACEMENT, y: { label: "Rise of the top plate", unit: "mm" }, group, caption,
    series: [
      ...present(shearSeries(test, "Top plate", "vertical_displacement_mm", { colour: 0 })),
      ...laboratorySeries(laboratory, test.name, "vertical_displacement_mm"),
    ],
  });
}

const DILATANCY: [string, string, number][] = [
  ["dilatancy_at_peak", "At the peak", 1], ["dilatancy_fastest", "Fastest rise", 2], ["dilatancy_residual", "Last 2 mm", 3],
];

function stressDilatancy(test: Test): HTMLElement {
  const path = shearSeries(test, "Path of the test", "shear_ratio", { colour: 0 }, "dilation_rate");
  if (!path) return emptyFigure("Stress-dilatancy", "shear.csv has no dilation rate yet.");
  const points: Series[] = DILATANCY.flatMap(([key, name, symbol]) => {
    const at = `summary.${key}`;
    const [x, y] = [numberAt(test.summary, `${key}.dilation_rate`), numberAt(test.summary, `${key}.shear_ratio`)];
    if (x === null || y === null) return [];
    return [{ name, x: [x], y: [y], draw: "points" as const, colour: symbol, symbol, sourceX: () => `${at}.dilation_rate`, sourceY: () => `${at}.shear_ratio`, test: test.name }];
  });
  // Taylor: shear ratio = friction + dilation rate, a line of slope one through the point at the peak.
  const friction = numberAt(test.summary, "dilatancy_at_peak.taylor_friction");
  const rates = path.x.filter((value): value is number => value !== null);
  const ends = [Math.min(...rates, 0), Math.max(...rates)];
  const taylor: Series[] = friction === null ? [] : [
    { name: "Taylor: slope 1", x: ends, y: ends.map((rate) => friction + rate), draw: "line", colour: 6, dash: 1 },
  ];
  const caption: Child[] = friction === null ? [] : [
    "At the peak: shear ratio ", measured(test.summary, "summary", "dilatancy_at_peak.shear_ratio"), " = friction ",
    measured(test.summary, "summary", "dilatancy_at_peak.taylor_friction"), " + dilation rate ",
    measured(test.summary, "summary", "dilatancy_at_peak.dilation_rate"), " (Taylor).",
  ];
  return xyChart({
    title: "Stress-dilatancy", x: { label: "Dilation rate dv/du" }, y: { label: "Shear ratio τ/σₙ", low: 0 }, cursor: "nearest", caption,
    series: [path, ...taylor, ...points],
  });
}

function decomposition(test: Test, group: ChartGroup): HTMLElement {
  const s = test.summary;
  const residual = numberAt(s, "dilatancy_residual.taylor_friction");
  return xyChart({
    title: "Parts of the shear ratio", x: DISPLACEMENT, y: { label: "Ratio" }, group,
    caption: residual === null ? [] : ["Friction in the last 2 mm ", measured(s, "summary", "dilatancy_residual.taylor_friction"), "."],
    series: present(
      shearSeries(test, "Shear ratio τ/σₙ", "shear_ratio", { colour: 0 }),
      shearSeries(test, "Friction (Taylor)", "taylor_friction", { colour: 1, dash: 1 }),
      shearSeries(test, "Dilation rate dv/du", "dilation_rate", { colour: 2, dash: 2 }),
    ),
  });
}

export function shearCharts(test: Test, laboratory: LaboratoryCurve[], group: ChartGroup): HTMLElement[] {
  if (!hasNumbers(column(test.tables.shear, "shear_stress_kPa"))) {
    return [emptyFigure("", "There are no rows of shear.csv: the test has not begun to shear.")];
  }
  return [shearStress(test, laboratory, group), verticalDisplacement(test, laboratory, group), normalStress(test, group), voidRatio(test, group), stressDilatancy(test), decomposition(test, group)];
}

function voidRatio(test: Test, group: ChartGroup): HTMLElement {
  const s = test.summary;
  return xyChart({
    title: "Void ratio", x: DISPLACEMENT, y: { label: "Void ratio" }, group,
    caption: numberAt(s, "void_ratio_at_end") === null ? [] : [
      "From ", measured(s, "summary", "void_ratio_before_shear"), " to ", measured(s, "summary", "void_ratio_at_end"), ", from the height of the plate."],
    series: present(shearSeries(test, "Void ratio", "void_ratio", { colour: 0 })),
  });
}

/** How near the test was to rest; a log axis knows no zero. */
export function equilibriumChart(test: Test, group: ChartGroup): HTMLElement | null {
  const names: [string, string][] = [["unbalanced_ratio", "Unbalanced force"], ["half_force_imbalance", "Difference of the halves"], ["inertial_number", "Inertial number"]];
  const series = present(...names.map(([key, name], place) => shearSeries(test, name, key, { colour: place, dash: place })));
  for (const one of series) one.y = one.y.map((value) => (value !== null && value > 0 ? value : null));
  const s = test.summary;
  if (!series.some((one) => hasNumbers(one.y))) return null;
  return xyChart({
    title: "Equilibrium", x: DISPLACEMENT, y: { label: "Ratio", log: true }, group, series: series.filter((one) => hasNumbers(one.y)),
    caption: numberAt(s, "unbalanced_ratio_mean") === null ? [] : [
      "Mean unbalanced force ", measured(s, "summary", "unbalanced_ratio_mean"), ", mean difference of the halves ", measured(s, "summary", "half_force_imbalance_mean"),
      ", largest inertial number ", measured(s, "summary", "inertial_number_max"), "."],
  });
}

export function energyChart(test: Test, group: ChartGroup): HTMLElement | null {
  const names: [string, string][] = [
    ["boundary_work_J", "Work of the walls"], ["slip_J", "Slip"], ["local_damping_J", "Local damping"], ["dashpot_J", "Dashpots"],
    ["contact_strain_J", "Contacts, stored"], ["bond_strain_J", "Bonds, stored"],
  ];
  const series = present(...names.map(([key, name], place) => shearSeries(test, name, key, { colour: place, dash: place })));
  if (series.length === 0) return null;
  const s = test.summary;
  return xyChart({
    title: "Energies", x: DISPLACEMENT, y: { label: "Energy", unit: "J" }, group, series,
    caption: numberAt(s, "energy_closure_per_cent") === null ? [] : ["Work less stored energy less losses: ", measured(s, "summary", "energy_closure_per_cent"), " of the work."],
  });
}
