// SPDX-License-Identifier: BSD-3-Clause
// Colours that people with any colour vision tell apart, and the range of values that a scale of colours covers.

export type Rgb = [number, number, number];

export function rgb(hex: string): Rgb {
  const n = parseInt(hex.replace("#", ""), 16);
  return [(n >> 16) & 255, (n >> 8) & 255, n & 255];
}

export function css([r, g, b]: Rgb): string {
  return `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;
}

// 17 colours at equal distances, of matplotlib. Sources: viridis and plasma by S. van der Walt and N. Smith (2015); cividis by
// Nunez, Anderton and Renslow (2018), PLoS ONE 13, e0199239. Plasma is taken from 0.1 to
// 0.9: its ends do not show on dark and on white paper.
const SCALES = {
  viridis: "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725",
  cividis: "00224e 002e6a 1a386f 32436d 434e6c 535a6d 61656f 6f7073 7d7c78 8c8878 9b9476 aba072 bcae6c cdbb63 dec958 f0d846 fee838",
  plasma: "41049d 5601a4 6a00a8 7e03a8 8f0da4 a11b9b b12a90 bf3984 cc4778 d6556d e16462 ea7457 f2844b f89540 fca636 feba2c fcce25",
};
export type Scale = keyof typeof SCALES;
const STOPS = Object.fromEntries(Object.entries(SCALES).map(([name, text]) => [name, text.split(" ").map(rgb)])) as Record<Scale, Rgb[]>;

/** Colour at a share of a scale from 0 to 1; beyond the ends, the colour of the end. */
export function scaleColour(scale: Scale, share: number): Rgb {
  const stops = STOPS[scale];
  const place = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const k = Math.min(stops.length - 2, Math.floor(place)), t = place - k;
  const a = stops[k]!, b = stops[k + 1]!;
  return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])];
}

export const KIND_COLOURS = { gravel: rgb("#dbb47c"), rubber: rgb("#355f9e"), none: rgb("#b9b9b6") };
/** Okabe and Ito (2008): orange, bluish green, blue. */
export const CONTACT_COLOURS: Rgb[] = [rgb("#e08a00"), rgb("#009e73"), rgb("#0072b2")];

export interface Range {
  low: number;
  high: number;
  /** Whether values lie beyond the ends. */
  below: boolean;
  above: boolean;
}

/** From the 2nd to the 97th percentile: a few extreme bodies must not take all colours for themselves. */
export function robustRange(values: Float32Array): Range {
  const sorted = values.filter(Number.isFinite).sort();
  const last = sorted.length - 1;
  if (last < 0) return { low: 0, high: 1, below: false, above: false };
  let low = sorted[Math.floor(0.02 * last)]!, high = sorted[Math.ceil(0.97 * last)]!;
  if (low >= 0 && low < 0.15 * high) low = 0;
  if (!(high > low)) high = low + (Math.abs(low) || 1);
  return { low, high, below: sorted[0]! < low, above: sorted[last]! > high };
}
