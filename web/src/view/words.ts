// SPDX-License-Identifier: BSD-3-Clause
// What the view shows, in words with numbers, for those who do not see it.
import { strongShare } from "./chains.ts";
import type { BodyState, Geometry } from "./bodies.ts";
import type { Range } from "./palettes.ts";
import { withUnit } from "../numbers.ts";
import { QUANTITIES } from "./quantities.ts";
import type { Colour, ViewSettings } from "./settings.ts";

export function count(n: number): string {
  return n.toLocaleString("en-GB");
}

export function digits(value: number): string {
  return Number(value.toPrecision(3)).toLocaleString("en-GB", { maximumSignificantDigits: 3 });
}

export function describe(geometry: Geometry, state: BodyState, settings: ViewSettings, range: Range | null, chains: number): string {
  const { contacts } = state;
  const parts = [
    `${count(geometry.bodies)} grains (${count(geometry.clumps)} gravel, ${count(geometry.rubberGrains)} rubber)`,
    `${count(contacts.count)} contacts`,
    `mean force ${digits(contacts.mean_N)} N`,
    `${Math.round(100 * strongShare(state))} % strong`,
  ];
  let text = `At ${state.displacement_mm.toFixed(2)} mm: ${parts.join(", ")}.`;
  if (settings.chains) text += ` ${count(chains)} force chains above ${settings.threshold.toFixed(1)} times the mean force.`;
  if (settings.colour !== "kind" && range) {
    const { name, unit } = QUANTITIES[settings.colour];
    text += ` ${name} coloured from ${digits(range.low)} to ${withUnit(digits(range.high), unit)}.`;
  }
  if (settings.cut !== "none") text += ` Cut across ${settings.cut} at ${Math.round(100 * settings.cutAt)} % of the specimen.`;
  return text;
}

/** One grain that was pointed at. */
export function describeBody(geometry: Geometry, body: number, values: Record<Exclude<Colour, "kind">, Float32Array>): string {
  const rubber = body < geometry.rubberGrains;
  const number = rubber ? body : body - geometry.rubberGrains;
  const parts = (["displacement", "rotation", "stress", "strain"] as const)
    .filter((colour) => body < values[colour].length)
    .map((colour) => `${QUANTITIES[colour].name.toLowerCase()} ${withUnit(digits(values[colour][body]!), QUANTITIES[colour].unit)}`);
  return `${rubber ? "Rubber" : "Gravel"} grain ${number} (body ${body}): ${parts.join(", ")}.`;
}
