// SPDX-License-Identifier: BSD-3-Clause
// Curves of a campaign: one panel for each normal stress, one line for each mixture.
import { ChartGroup } from "../chart/group.ts";
import { legend } from "../chart/legend.ts";
import { xyChart } from "../chart/xy_chart.ts";
import { el } from "../dom.ts";
import { charts } from "../sections/part.ts";
import { DISPLACEMENT, present, shearSeries } from "../sections/shear_curves.ts";
import type { Members } from "./members.ts";

const CURVES = [
  { title: "Shear stress", label: "Shear stress", unit: "kPa", column: "shear_stress_kPa", low: 0 },
  { title: "Vertical displacement", label: "Rise of the top plate", unit: "mm", column: "vertical_displacement_mm", low: undefined },
];

export function campaignCurves({ members, mixtures, stresses }: Members): HTMLElement[] {
  const group = new ChartGroup("campaign");
  const look = (place: number) => ({ colour: place, dash: place % 6 });
  const key = legend(mixtures.map(({ name }, place) => ({ name, key: name, draw: "line" as const, ...look(place) })), group, "all curves of the campaign");
  const rows = CURVES.map((curve) => {
    const figures = stresses.flatMap(({ name }, place) => {
      const here = members.filter((one) => one.stress === place);
      const series = present(...here.map(({ test, mixture }) => {
        const mixtureName = mixtures[mixture]?.name ?? test.name;
        return shearSeries(test, here.filter((one) => one.mixture === mixture).length > 1 ? `${mixtureName} (${test.name})` : mixtureName, curve.column, { ...look(mixture), key: mixtureName });
      }));
      if (series.length === 0) return [];
      return [xyChart({
        title: name ? `${curve.title} under ${name}` : curve.title, x: DISPLACEMENT, y: { label: curve.label, unit: curve.unit, low: curve.low }, series, group,
        legend: false, cursor: "nearest",
      })];
    });
    return charts(...figures);
  });
  return [el("div", { class: "shared-legend" }, key.element), ...rows];
}
