// SPDX-License-Identifier: BSD-3-Clause
// Polar histograms of a stored state that a slider chooses: contact density, normal, tangential and signed tangential force.
import type { HistogramSet, Test } from "../data.ts";
import { el } from "../dom.ts";
import { type Band, signedBand } from "../chart/polar_band.ts";
import { type DataTable, emptyFigure, figure } from "../chart/figure.ts";
import { type PolarPanel, polarPanel } from "../chart/polar_panel.ts";
import { choice, slider } from "../controls.ts";
import { formatNumber, withUnit } from "../numbers.ts";
import { column, nearestRow } from "../tables.ts";
import { numberAt, numberSpan } from "../value.ts";

export type Quantity = "density" | "normal_force_N" | "shear_force_N" | "signed_shear_force_N";

interface QuantityText {
  title: string;
  unit: string;
  /** Amplitude and direction in micro.csv, without the set, and their symbols. */
  amplitude: string;
  direction: string;
  symbols: [string, string];
  colour: number;
}

export const QUANTITIES: Record<Quantity, QuantityText> = {
  density: { title: "Contact density E(θ)", unit: "1/rad", amplitude: "a", direction: "theta_a", symbols: ["a", "θₐ"], colour: 0 },
  normal_force_N: { title: "Normal force fₙ(θ)", unit: "N", amplitude: "a_n", direction: "theta_n", symbols: ["aₙ", "θₙ"], colour: 1 },
  shear_force_N: { title: "Tangential force fₜ(θ)", unit: "N", amplitude: "a_t", direction: "theta_t", symbols: ["aₜ", "θₜ"], colour: 2 },
  signed_shear_force_N: { title: "Signed tangential force", unit: "N", amplitude: "a_s", direction: "theta_s", symbols: ["aₛ", "θₛ"], colour: 3 },
};
export const QUANTITY_NAMES = Object.keys(QUANTITIES) as Quantity[];
export const SET_NAMES: Record<string, string> = { all: "All contacts", "g-g": "Gravel–gravel", "g-r": "Gravel–rubber", "r-r": "Rubber–rubber" };

function meanOf(values: (number | null)[]): number | null {
  const known = values.filter((value): value is number => value !== null);
  return known.length > 0 ? known.reduce((sum, value) => sum + value, 0) / known.length : null;
}

export function bandOf(set: HistogramSet, quantity: Quantity): Band | null {
  const { bands, fit } = set;
  const signed = quantity === "signed_shear_force_N";
  // The signed force is measured in units of the mean normal force.
  const unit = meanOf(signed ? fit.normal_force_N : fit[quantity]);
  const [amplitude, direction] = {
    density: [bands.a, bands.theta_a_deg],
    normal_force_N: [bands.a_n, bands.theta_n_deg],
    shear_force_N: [bands.a_t, bands.theta_t_deg],
    signed_shear_force_N: [bands.a_s ?? null, bands.theta_s_deg ?? null],
  }[quantity];
  if (!amplitude || !direction || unit === null) return null;
  if (signed) return signedBand(unit, amplitude, direction);
  return { mean: unit, unit, harmonic: quantity === "shear_force_N" ? 4 : 2, amplitude, direction_deg: direction };
}

/** Largest value or curve of a quantity in some sets, for the outer ring of panels that are compared. */
export function limitOf(sets: HistogramSet[], quantity: Quantity): number {
  const sizes = sets.flatMap((set) => [...set[quantity], ...set.fit[quantity]]).map((value) => Math.abs(value ?? 0));
  return Math.max(0, ...sizes) * 1.04;
}

interface Coefficient {
  symbol: string;
  value: number | null;
  source: string;
  unit: string;
  band: [number, number] | null;
}

/** Amplitude and direction as micro.csv has them in the row of the state, if there is one at the same displacement. */
function coefficients(test: Test, set: HistogramSet, displacement: number, quantity: Quantity): Coefficient[] {
  const micro = test.tables.micro;
  const displacements = column(micro, "displacement_mm");
  const row = displacements ? nearestRow(displacements, displacement) : -1;
  if (row < 0 || Math.abs((displacements?.[row] ?? Infinity) - displacement) > 1e-6) return [];
  const text = QUANTITIES[quantity];
  const suffix = set.set.replace("-", "");
  const bands = set.bands as Record<string, [number, number] | null | undefined>;
  const at = (name: string, symbol: string, unit: string, band: string): Coefficient =>
    ({ symbol, value: column(micro, name)?.[row] ?? null, source: `micro.${name}[${row}]`, unit, band: bands[band] ?? null });
  return [
    at(`${text.amplitude}_${suffix}`, text.symbols[0], "", text.amplitude),
    at(`${text.direction}_${suffix}_deg`, text.symbols[1], "°", `${text.direction}_deg`),
  ].filter(({ value }) => value !== null);
}

function coefficientText({ symbol, value, unit, band }: Coefficient): string {
  const range = band ? ` (${withUnit(formatNumber(band[0], 3), unit)} to ${withUnit(formatNumber(band[1], 3), unit)})` : "";
  return `${symbol} = ${withUnit(formatNumber(value, 3), unit)}${range}`;
}

function coefficientElement({ symbol, value, source, unit, band }: Coefficient): HTMLElement {
  const range = band ? ` (${withUnit(formatNumber(band[0], 3), unit)} to ${withUnit(formatNumber(band[1], 3), unit)})` : "";
  return el("span", { class: "coefficient" }, `${symbol} = `, numberSpan(value, source, unit, 3), range);
}

export function panelOf(set: HistogramSet, quantity: Quantity, limit: number, title: string, description: string): PolarPanel {
  const text = QUANTITIES[quantity];
  return {
    title, angle_deg: set.angle_deg, values: set[quantity], fit: set.fit[quantity], band: bandOf(set, quantity), limit,
    signed: quantity === "signed_shear_force_N", colour: text.colour, description,
  };
}

function polarTable(sets: HistogramSet[], places: number[], displacement: number, state: number, test: string): DataTable {
  const columns = ["Set", "Displacement (mm)", "Angle (°)", ...QUANTITY_NAMES.flatMap((name) => [`${QUANTITIES[name].title} (${QUANTITIES[name].unit})`, "fit"])];
  const rows = sets.flatMap((set, k) => set.angle_deg.map((angle, row) => {
    const at = `histograms.${state}.sets.${places[k] ?? 0}`;
    return [
      { value: set.set }, { value: displacement }, { value: angle },
      ...QUANTITY_NAMES.flatMap((name) => [
        { value: set[name][row] ?? null, source: `${at}.${name}.${row}`, test },
        { value: set.fit[name][row] ?? null, source: `${at}.fit.${name}.${row}`, test },
      ]),
    ];
  }));
  return { columns, rows };
}

/** The state nearest to the peak, the last without one. */
export function stateAtPeak(test: Test): number {
  const displacements = test.histograms.map((state) => state.displacement_mm);
  const peak = numberAt(test.summary, "displacement_at_peak_mm");
  return peak === null ? displacements.length - 1 : nearestRow(displacements, peak);
}

export function polarFigure(test: Test): HTMLElement {
  const title = "Polar histograms";
  if (test.histograms.length === 0) return emptyFigure(title, "No state is stored yet.");
  const picture = el("div", { class: "panels four" });
  let state = 0;
  let chosen = "";
  const setsNamed = (name: string) => test.histograms.map((one) => one.sets.find((set) => set.set === name)).filter((set): set is HistogramSet => !!set);
  const names = [...new Set(test.histograms.flatMap((one) => one.sets.filter((set) => set.contacts > 0).map((set) => set.set)))];
  const draw = () => {
    const here = test.histograms[state];
    const set = here?.sets.find((one) => one.set === chosen);
    picture.replaceChildren();
    if (!here || !set) return;
    for (const quantity of QUANTITY_NAMES) {
      const found = coefficients(test, set, here.displacement_mm, quantity);
      const text = QUANTITIES[quantity];
      const description = `${text.title} of ${SET_NAMES[set.set] ?? set.set} at ${withUnit(formatNumber(here.displacement_mm), "mm")}. ${found.map(coefficientText).join(", ")}`;
      const panel = polarPanel(panelOf(set, quantity, limitOf(setsNamed(chosen), quantity), `${text.title}, ${text.unit}`, description));
      picture.append(el("div", { class: "panel" }, panel, el("p", {}, ...found.map(coefficientElement))));
    }
  };
  const controls = el("div", { class: "controls" },
    slider(`polar:${test.name}`, "Displacement", test.histograms.map((one) => withUnit(formatNumber(one.displacement_mm, 3), "mm")), stateAtPeak(test), (place) => {
      state = place;
      draw();
    }),
    choice(`polar-set:${test.name}`, "Contacts", names.map((name) => [name, SET_NAMES[name] ?? name]), (name) => {
      chosen = name;
      draw();
    }));
  const element = figure({
    title, picture, wide: true,
    caption: ["Sectors: means of the bins. Line: fitted curve. Shaded: curves whose amplitude and direction lie in their 95 % bands. 0° is the shear direction, 90° is up. In the signed force zero is the middle ring; outwards is positive."],
    table: () => {
      const here = test.histograms[state];
      const places = here ? here.sets.map((_, place) => place) : [];
      return polarTable(here?.sets ?? [], places, here?.displacement_mm ?? 0, state, test.name);
    },
  });
  picture.before(controls);
  return element;
}
