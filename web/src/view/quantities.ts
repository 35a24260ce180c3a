// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which bodies are coloured, with their names, units and scales.
import type { Geometry } from "./bodies.ts";
import { KIND_COLOURS, scaleColour, type Range, type Rgb, type Scale } from "./palettes.ts";
import type { Colour } from "./settings.ts";

export interface Quantity {
  name: string;
  unit: string;
  scale: Scale;
}

export const QUANTITIES: Record<Exclude<Colour, "kind">, Quantity> = {
  displacement: { name: "Displacement", unit: "mm", scale: "viridis" },
  rotation: { name: "Rotation", unit: "°", scale: "viridis" },
  stress: { name: "Mean stress", unit: "kPa", scale: "cividis" },
  strain: { name: "Bond strain", unit: "%", scale: "cividis" },
};

/** Darker and lighter grains of one kind can be told apart, and their pebbles and balls belong together. */
function tinted([r, g, b]: Rgb, body: number): Rgb {
  const share = ((body * 0.61803398875) % 1) - 0.5;
  const factor = 1 + 0.2 * share;
  return [Math.min(255, r * factor), Math.min(255, g * factor), Math.min(255, b * factor)];
}

export function kindColour(geometry: Geometry): (body: number) => Rgb {
  return (body) => tinted(body < geometry.rubberGrains ? KIND_COLOURS.rubber : KIND_COLOURS.gravel, body);
}

/** Bodies beyond the values (gravel has no bond strain) are grey. */
export function valueColour(values: Float32Array, range: Range, scale: Scale): (body: number) => Rgb {
  return (body) => {
    if (body >= values.length) return KIND_COLOURS.none;
    return scaleColour(scale, (values[body]! - range.low) / (range.high - range.low));
  };
}

export function joinRanges(ranges: Range[]): Range {
  return {
    low: Math.min(...ranges.map((r) => r.low)), high: Math.max(...ranges.map((r) => r.high)),
    below: ranges.some((r) => r.below), above: ranges.some((r) => r.above),
  };
}


