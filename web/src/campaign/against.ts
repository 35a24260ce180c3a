// SPDX-License-Identifier: BSD-3-Clause
// Quantities at the peak against the rubber content (or what else the study varies), one line for each normal stress.
import { emptyFigure } from "../chart/figure.ts";
import { ChartGroup } from "../chart/group.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { svg } from "../dom.ts";
import { labelOf, unitOf } from "../numbers.ts";
import { lookUp, numberAt } from "../value.ts";
import type { Member, Members } from "./members.ts";

interface Quantity {
  title: string;
  label: string;
  unit?: string;
  path: string;
}

export const AGAINST: Record<"strength" | "fabric", Quantity[]> = {
  strength: [
    { title: "Peak shear stress", label: "Peak shear stress", unit: "kPa", path: "peak_shear_stress_kPa" },
    { title: "Dilation angle", label: "Dilation angle", unit: "°", path: "dilation_angle_deg" },
    { title: "Void ratio before shear", label: "Void ratio", path: "void_ratio_before_shear" },
  ],
  fabric: [
    { title: "Direction of the normal forces", label: "θₙ", unit: "°", path: "micro_at_peak.theta_n_deg" },
    { title: "Anisotropy of the fabric", label: "a", path: "micro_at_peak.a" },
    { title: "Anisotropy of the normal forces", label: "aₙ", path: "micro_at_peak.a_n" },
    { title: "Anisotropy of the tangential forces", label: "aₜ", path: "micro_at_peak.a_t" },
    { title: "Bulk friction", label: "μ = Σfₜ / Σfₙ", path: "micro_at_peak.bulk_friction" },
    { title: "Mean strain of the rubber bonds", label: "Bond strain, compression +", path: "micro_at_peak.rubber_bond_strain" },
  ],
};

/** Rubber content is read in per cent. */
function acrossOf(members: Members): { name: string; label: string; unit: string; factor: number } | null {
  if (members.across === null) return null;
  const vrc = members.across === "rubber_content";
  return { name: members.across, label: vrc ? "Rubber content VRC" : labelOf(members.across), unit: vrc ? "%" : unitOf(members.across), factor: vrc ? 100 : 1 };
}

function sorted(members: Member[], name: string): Member[] {
  return [...members].sort((one, other) => Number(one.values[name]) - Number(other.values[name]));
}

function pointsOf(members: Member[], across: { name: string; factor: number }, path: string): { x: number[]; y: number[]; tests: string[] } {
  const points = { x: [] as number[], y: [] as number[], tests: [] as string[] };
  for (const { test, values } of sorted(members, across.name)) {
    const value = numberAt(test.summary, path);
    if (value === null) continue;
    points.x.push(across.factor * Number(values[across.name]));
    points.y.push(value);
    points.tests.push(test.name);
  }
  return points;
}

export function againstContent(members: Members, quantities: Quantity[], group: ChartGroup): HTMLElement[] {
  const across = acrossOf(members);
  if (!across) return [emptyFigure("At the peak", "The tests of the study do not differ in a number of the mixture.")];
  return quantities.map(({ title, label, unit, path }) => {
    const series = members.stresses.flatMap(({ name }, place): Series[] => {
      const { x, y, tests } = pointsOf(members.members.filter((one) => one.stress === place), across, path);
      if (x.length === 0) return [];
      // Tests that differ in more than x and stress share a place: no line joins them.
      const draw = new Set(x).size === x.length ? "both" : "points";
      return [{ name: name || "All tests", x, y, draw, colour: place, dash: place, symbol: place, sourceY: () => `summary.${path}`, pointTests: tests }];
    });
    if (series.length === 0) return emptyFigure(title, "No finished test has this number.");
    const ends = across.name === "rubber_content" ? { low: 0, high: 100, exact: true } : {};
    return xyChart({ title, x: { label: across.label, unit: across.unit, ...ends }, y: { label, unit }, series, group, cursor: "nearest" });
  });
}

const KINDS: [string, string, number][] = [["Gravel–gravel", "gg", 0], ["Gravel–rubber", "gr", 2], ["Rubber–rubber", "rr", 1]];

export function strongAgainstContent(members: Members): HTMLElement[] {
  const across = acrossOf(members);
  if (!across) return [];
  const group = new ChartGroup("strong");
  return members.stresses.flatMap(({ name }, place) => {
    const here = sorted(members.members.filter((one) => one.stress === place), across.name);
    const series = KINDS.flatMap(([text, set, colour]): Series[] => {
      const { x, y, tests } = pointsOf(here, across, `micro_at_peak.strong_share_${set}`);
      return x.length > 0 ? [{ name: text, x, y, draw: "both", colour, dash: colour, symbol: colour, sourceY: () => `summary.micro_at_peak.strong_share_${set}`, pointTests: tests }] : [];
    });
    if (series.length === 0) return [];
    const zones = here.flatMap(({ test, values }): [number, string][] => {
      const zone = lookUp(test.summary, "micro_at_peak.zone");
      return typeof zone === "string" ? [[across.factor * Number(values[across.name]), zone]] : [];
    });
    const ends = across.name === "rubber_content" ? { low: 0, high: 100, exact: true } : {};
    return [xyChart({
      title: name ? `Strong contacts under ${name}` : "Strong contacts", x: { label: across.label, unit: across.unit, ...ends },
      y: { label: "Share of the strong contacts", low: 0, high: 1.15, exact: true, ticks: [0, 0.25, 0.5, 0.75, 1] }, series, group, cursor: "nearest",
      caption: [`Zones: ${zones.map(([x, zone]) => `${zone} at ${x} ${across.unit}`).join(", ")}.`],
      decorate: (area) => {
        let free = -Infinity;
        return zones.flatMap(([x, zone]) => {
          const at = area.x(x);
          const anchor = at < area.left + 30 ? "start" : at > area.right - 30 ? "end" : "middle";
          const half = zone.length * 3.4 + 5;
          const from = anchor === "start" ? at : anchor === "end" ? at - 2 * half : at - half;
          if (from < free) return [];
          free = from + 2 * half + 2;
          return [
            svg("rect", { class: `zone ${zone}`, x: from, y: area.top - 4, width: 2 * half, height: 16, rx: 3 }),
            svg("text", { class: "zone-text", x: from + half, y: area.top + 8, "text-anchor": "middle" }, zone),
          ];
        });
      },
      marks: [{ along: "y", at: 0.5, text: "" }],
    })];
  });
}
