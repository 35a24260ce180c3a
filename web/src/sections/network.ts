// SPDX-License-Identifier: BSD-3-Clause
// The contact network against the displacement, from micro.csv: anisotropy, directions, friction, strong contacts, rubber strain.
import type { Test } from "../data.ts";
import type { Child } from "../dom.ts";
import { svg } from "../dom.ts";
import { emptyFigure } from "../chart/figure.ts";
import type { ChartGroup } from "../chart/group.ts";
import type { PlotArea } from "../chart/plot_area.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { column, hasNumbers, nearestRow, rowsOf } from "../tables.ts";
import { measured, numberAt, numberSpan } from "../value.ts";
import { DISPLACEMENT, present } from "./shear_curves.ts";

export const ZONES = ["", "rigid", "intermediate", "soft"];

export function microSeries(test: Test, name: string, y: string, look: Partial<Series> & { colour: number }): Series | null {
  const across = column(test.tables.micro, "displacement_mm");
  const up = column(test.tables.micro, y);
  if (!across || !hasNumbers(up)) return null;
  return { name, x: across, y: up, draw: "line", sourceX: "micro.displacement_mm", sourceY: `micro.${y}`, test: test.name, ...look };
}

/** "last row: name value" of some columns of micro.csv. */
function atEnd(test: Test, columns: [string, string][]): Child[] {
  const row = rowsOf(test.tables.micro) - 1;
  const parts = columns.flatMap(([text, name]): Child[] => {
    const value = column(test.tables.micro, name)?.[row] ?? null;
    return value === null ? [] : [`${text} `, numberSpan(value, `micro.${name}[${row}]`, undefined, 3), ", "];
  });
  return parts.length > 0 ? ["At the end: ", ...parts.slice(0, -1), "."] : [];
}

function atPeak(test: Test, names: [string, string][]): Child[] {
  const parts = names.flatMap(([text, name]): Child[] =>
    numberAt(test.summary, `micro_at_peak.${name}`) === null ? [] : [`${text} `, measured(test.summary, "summary", `micro_at_peak.${name}`, 3), ", "]);
  return parts.length > 0 ? ["At the peak: ", ...parts.slice(0, -1), "."] : [];
}

function either(...captions: Child[][]): Child[] {
  return captions.find((caption) => caption.length > 0) ?? [];
}

function anisotropy(test: Test, group: ChartGroup): HTMLElement {
  return xyChart({
    title: "Anisotropy", x: DISPLACEMENT, y: { label: "Amplitude", low: 0 }, group,
    caption: [
      ...either(atPeak(test, [["a", "a"], ["aₙ", "a_n"], ["aₜ", "a_t"]]), atEnd(test, [["a", "a_all"], ["aₙ", "a_n_all"], ["aₜ", "a_t_all"]])),
      " Noise: isotropic contacts exceed it once in 3000 times."],
    series: present(
      microSeries(test, "Fabric a", "a_all", { colour: 0 }),
      microSeries(test, "Normal force aₙ", "a_n_all", { colour: 1, dash: 1 }),
      microSeries(test, "Tangential force aₜ", "a_t_all", { colour: 2, dash: 3 }),
      microSeries(test, "Signed tangential force aₛ", "a_s_all", { colour: 3, dash: 4 }),
      microSeries(test, "Noise of a", "a_noise_all", { colour: 6, dash: 2 }),
    ),
  });
}

function directions(test: Test, group: ChartGroup): HTMLElement {
  return xyChart({
    title: "Major axes of the anisotropy", x: DISPLACEMENT, y: { label: "Angle from the shear direction", unit: "°" }, group,
    caption: [...either(atPeak(test, [["θₙ", "theta_n_deg"]]), atEnd(test, [["θₙ", "theta_n_all_deg"]])), " 90° is vertical."],
    series: present(
      microSeries(test, "Normal force θₙ", "theta_n_all_deg", { colour: 1, dash: 1 }),
      microSeries(test, "Fabric θₐ", "theta_a_all_deg", { colour: 0 }),
      microSeries(test, "Stress", "stress_direction_deg", { colour: 6, dash: 2 }),
    ),
  });
}

function bulkFriction(test: Test, group: ChartGroup): HTMLElement {
  return xyChart({
    title: "Bulk friction", x: DISPLACEMENT, y: { label: "Σfₜ / Σfₙ" }, group,
    caption: either(atPeak(test, [["μ", "bulk_friction"]]), atEnd(test, [["μ", "bulk_friction_all"]])),
    series: present(
      microSeries(test, "All contacts", "bulk_friction_all", { colour: 0 }),
      microSeries(test, "Gravel–gravel", "bulk_friction_gg", { colour: 1, dash: 1 }),
      microSeries(test, "Gravel–rubber", "bulk_friction_gr", { colour: 2, dash: 2 }),
      microSeries(test, "Rubber–rubber", "bulk_friction_rr", { colour: 3, dash: 3 }),
    ),
  });
}

/** A strip under the lines that names the zone of each stretch. */
function zoneStrip(test: Test): (area: PlotArea) => SVGElement[] {
  const zone = column(test.tables.micro, "zone") ?? [];
  const x = column(test.tables.micro, "displacement_mm") ?? [];
  return (area) => {
    const parts: SVGElement[] = [];
    let start = 0;
    for (let row = 1; row <= zone.length; row += 1) {
      if (row < zone.length && zone[row] === zone[start]) continue;
      const from = area.x(x[start] ?? 0);
      const to = area.x(x[Math.min(row, zone.length - 1)] ?? 0);
      const name = ZONES[zone[start] ?? 0] ?? "";
      if (name) {
        parts.push(svg("rect", { class: `zone ${name}`, x: from, y: area.top - 4, width: Math.max(1, to - from), height: 16 }));
        if (to - from > name.length * 7 + 8) {
          parts.push(svg("text", { class: "zone-text", x: (from + to) / 2, y: area.top + 8, "text-anchor": "middle" }, name));
        }
      }
      start = row;
    }
    return parts;
  };
}

function strongNetwork(test: Test, group: ChartGroup): HTMLElement {
  const kinds: [string, string, number][] = [["Gravel–gravel", "gg", 0], ["Gravel–rubber", "gr", 2], ["Rubber–rubber", "rr", 1]];
  const zone = test.summary.micro_at_peak as { zone?: unknown } | null | undefined;
  return xyChart({
    title: "Strong contacts by kind", x: DISPLACEMENT, y: { label: "Share of the strong contacts", low: 0, high: 1.15, exact: true, ticks: [0, 0.25, 0.5, 0.75, 1] }, group,
    caption: [
      ...either(
        atPeak(test, [["g–g", "strong_share_gg"], ["g–r", "strong_share_gr"], ["r–r", "strong_share_rr"]]),
        atEnd(test, [["g–g", "strong_share_gg"], ["g–r", "strong_share_gr"], ["r–r", "strong_share_rr"]])),
      typeof zone?.zone === "string" ? ` Zone at the peak: ${zone.zone}.` : "",
      " The strip names the zone: rigid when g–g holds the majority, soft when r–r does."],
    marks: [{ along: "y", at: 0.5, text: "" }],
    decorate: zoneStrip(test),
    series: present(...kinds.flatMap(([name, set, colour]) => [
      microSeries(test, `${name}, by number`, `strong_share_${set}`, { colour, dash: 0 }),
      microSeries(test, `${name}, by load`, `strong_load_share_${set}`, { colour, dash: 2 }),
    ])),
  });
}

function sliding(test: Test, group: ChartGroup): HTMLElement {
  return xyChart({
    title: "Sliding contacts", x: DISPLACEMENT, y: { label: "Share of the contacts", low: 0 }, group,
    caption: atEnd(test, [["all", "sliding_all"], ["g–g", "sliding_gg"], ["g–r", "sliding_gr"], ["r–r", "sliding_rr"]]),
    series: present(
      microSeries(test, "All contacts", "sliding_all", { colour: 0 }),
      microSeries(test, "Gravel–gravel", "sliding_gg", { colour: 1, dash: 1 }),
      microSeries(test, "Gravel–rubber", "sliding_gr", { colour: 2, dash: 2 }),
      microSeries(test, "Rubber–rubber", "sliding_rr", { colour: 3, dash: 3 }),
    ),
  });
}

function coordination(test: Test, group: ChartGroup): HTMLElement | null {
  const series = present(
    microSeries(test, "Contacts of a grain", "coordination", { colour: 0 }),
    microSeries(test, "without rattlers", "coordination_mechanical", { colour: 1, dash: 1 }),
    microSeries(test, "Grains that it touches", "coordination_pairs", { colour: 2, dash: 2 }),
  );
  if (series.length === 0) return null;
  return xyChart({
    title: "Coordination", x: DISPLACEMENT, y: { label: "Coordination number", low: 0 }, group, series,
    caption: atEnd(test, [["contacts", "coordination"], ["share of rattlers", "rattlers"]]),
  });
}

export function networkCharts(test: Test, group: ChartGroup): (HTMLElement | null)[] {
  if (!hasNumbers(column(test.tables.micro, "a_all"))) {
    return [emptyFigure("", "There are no rows of micro.csv yet.")];
  }
  return [anisotropy(test, group), directions(test, group), bulkFriction(test, group), strongNetwork(test, group), sliding(test, group), coordination(test, group)];
}

/** null: a test without rubber. */
export function rubberCharts(test: Test, group: ChartGroup): HTMLElement[] | null {
  const micro = test.tables.micro;
  const mean = microSeries(test, "Mean", "bond_strain", { colour: 1 });
  if (!mean) return null;
  const end = rowsOf(micro) - 1;
  const start = nearestRow(column(micro, "displacement_mm") ?? [], 0);
  const value = (row: number) => numberSpan(column(micro, "bond_strain")?.[row] ?? null, `micro.bond_strain[${row}]`, "", 3);
  mean.low = column(micro, "bond_strain_p05") ?? undefined;
  mean.high = column(micro, "bond_strain_p95") ?? undefined;
  const volume = present(
    microSeries(test, "Volume of a grain", "volume_strain", { colour: 0 }),
    microSeries(test, "Major axis", "grain_strain_major", { colour: 1, dash: 1 }),
    microSeries(test, "Vertical", "grain_strain_vertical", { colour: 2, dash: 2 }),
  );
  return [
    xyChart({
      title: "Strain of the rubber bonds", x: DISPLACEMENT, y: { label: "Bond strain, compression +" }, group,
      caption: ["Mean ", value(start), " at the start, ", value(end), " at the end. Band: 5 to 95 % of the bonds."],
      series: present(mean, microSeries(test, "Median", "bond_strain_p50", { colour: 0, dash: 1 }),
        microSeries(test, "Mean of the compressed bonds", "bond_strain_compressed", { colour: 2, dash: 2 })),
    }),
    ...(volume.length > 0 ? [xyChart({
      title: "Strain of the rubber grains", x: DISPLACEMENT, y: { label: "Strain, compression +" }, group,
      caption: atEnd(test, [["volume", "volume_strain"], ["major axis", "grain_strain_major"], ["vertical", "grain_strain_vertical"]]), series: volume,
    })] : []),
  ];
}
