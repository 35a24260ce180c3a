// SPDX-License-Identifier: BSD-3-Clause
// Profiles over the height at the stored states, from profiles.csv: the chosen state in front of the others.
import type { Test } from "../data.ts";
import { el } from "../dom.ts";
import { emptyFigure } from "../chart/figure.ts";
import { ChartGroup } from "../chart/group.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { slider } from "../controls.ts";
import { formatNumber, withUnit } from "../numbers.ts";
import { type Column, column, hasNumbers } from "../tables.ts";
import { lookUp, numberSpan } from "../value.ts";
import { charts } from "./part.ts";

interface Profile {
  title: string;
  label: string;
  unit: string;
  columns: [string, string][];
}

const PROFILES: Profile[] = [
  { title: "Displacement", label: "Along the shear direction", unit: "mm", columns: [["displacement_x_mm", "All grains"]] },
  { title: "Rotation", label: "Mean turn about y", unit: "°", columns: [["rotation_gravel_deg", "Gravel"], ["rotation_rubber_deg", "Rubber"]] },
  { title: "Void ratio", label: "Void ratio", unit: "", columns: [["void_ratio", "Layer"]] },
  { title: "Rubber content", label: "Share of the solid volume", unit: "", columns: [["rubber_content", "Layer"]] },
  { title: "Strong contacts", label: "Share of the contacts", unit: "", columns: [["strong_share", "Layer"]] },
];

/** Values of one state at the middles of its layers, as lines that go up. */
function stateSeries(test: Test, profile: Profile, rows: number[], quiet: boolean): Series[] {
  const table = test.tables.profiles;
  const [low, high] = [column(table, "low_mm"), column(table, "high_mm")];
  const pick = (values: Column | null) => rows.map((row) => values?.[row] ?? null);
  const middle = rows.map((row) => ((low?.[row] ?? 0) + (high?.[row] ?? 0)) / 2);
  return profile.columns.flatMap(([name, text], place): Series[] => {
    const x = pick(column(table, name));
    if (!hasNumbers(x)) return [];
    const look = { colour: quiet ? 6 : place, dash: quiet ? 0 : place, symbol: place };
    return [{ name: text, x, y: middle, draw: quiet ? "line" : "both", quiet, ...look }];
  });
}

/** Thickness of the shear band as summary.json has it for the state. */
function shearBand(test: Test, displacement: number): (HTMLElement | string)[] {
  const bands = lookUp(test.summary, "shear_band");
  if (!Array.isArray(bands)) return [];
  const place = bands.findIndex((band) => Math.abs(Number(lookUp(band, "displacement_mm")) - displacement) < 1e-6);
  const number = (name: string) => {
    const value = lookUp(bands[place], name);
    return typeof value === "number" ? numberSpan(value, `summary.shear_band.${place}.${name}`, "mm", 3) : null;
  };
  const [thickness, error, centre] = [number("thickness_mm"), number("thickness_error_mm"), number("centre_mm")];
  if (!thickness || !centre) return ["No shear band can be told from the displacements of this state."];
  return ["Shear band: thickness ", thickness, ...(error ? [" ± ", error] : []), ", centre at ", centre, " above the bottom."];
}

export function profileCharts(test: Test): HTMLElement[] {
  const displacements = column(test.tables.profiles, "shear_displacement_mm");
  if (!hasNumbers(displacements)) return [emptyFigure("", "profiles.csv is written at the end of the test.")];
  const states = [...new Set(displacements.filter((value): value is number => value !== null))];
  const rowsAt = (state: number) => displacements.flatMap((value, row) => (value === state ? [row] : []));
  const box = charts();
  box.classList.add("narrow");
  const words = el("p", { class: "note", "aria-live": "polite" });
  // Charts are made once for each state, when it is first asked for.
  const made = new Map<number, HTMLElement[]>();
  const figuresOf = (state: number): HTMLElement[] => {
    const group = new ChartGroup();
    return PROFILES.flatMap((profile) => {
      const front = stateSeries(test, profile, rowsAt(state), false);
      if (front.length === 0) return [];
      const behind = states.filter((one) => one !== state).flatMap((one) => stateSeries(test, profile, rowsAt(one), true));
      return [xyChart({
        title: profile.title, x: { label: profile.label, unit: profile.unit }, y: { label: "Height", unit: "mm", low: 0 }, series: [...behind, ...front],
        height: 300, cursor: "nearest", group, legend: front.length > 1,
      })];
    });
  };
  const control = slider(`profiles:${test.name}`, "Displacement", states.map((state) => withUnit(formatNumber(state, 3), "mm")), states.length - 1, (place) => {
    const state = states[place] ?? 0;
    const figures = made.get(state) ?? figuresOf(state);
    made.set(state, figures);
    box.replaceChildren(...figures);
    words.replaceChildren(...shearBand(test, state), " Grey lines: the other states.");
  });
  return [el("div", { class: "controls" }, control), words, box];
}
