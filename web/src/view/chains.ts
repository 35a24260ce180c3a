// SPDX-License-Identifier: BSD-3-Clause
// Force chains: a rod between the centres of the two bodies of each contact above a threshold.
import type { BodyState, Geometry } from "./bodies.ts";
import { CONTACT_COLOURS, robustRange, scaleColour, type Range } from "./palettes.ts";
import type { ChainColour } from "./settings.ts";

export interface ChainRods {
  count: number;
  start: Float32Array;
  end: Float32Array;
  radius: Float32Array;
  colour: Uint8Array;
  /** Of the forces of the rods, N. */
  range: Range;
}

/** 0 gravel-gravel, 1 gravel-rubber, 2 rubber-rubber. */
export function contactKind(rubberGrains: number, i: number, j: number): number {
  return Number(i < rubberGrains) + Number(j < rubberGrains);
}

/** Share of the contacts whose force is above the mean. */
export function strongShare(state: BodyState): number {
  const { force_N, mean_N, count } = state.contacts;
  let strong = 0;
  for (let c = 0; c < count; ++c) strong += Number(force_N[c]! > mean_N);
  return count > 0 ? strong / count : 0;
}

/** Mean distance of the centres of bodies in contact, mm. */
export function meanBranch(state: BodyState): number {
  const { count, body_i, body_j } = state.contacts;
  let sum = 0;
  for (let c = 0; c < count; ++c) {
    const i = 3 * body_i[c]!, j = 3 * body_j[c]!;
    sum += Math.hypot(state.centre[i]! - state.centre[j]!, state.centre[i + 1]! - state.centre[j + 1]!, state.centre[i + 2]! - state.centre[j + 2]!);
  }
  return count > 0 ? sum / count : 1;
}

/** The area of a rod is proportional to its force; `visible` says whether a point (mm) is on the side of the cut that is shown. */
export function chainRods(
  geometry: Geometry, state: BodyState, threshold: number, colouring: ChainColour, visible: (x: number, y: number, z: number) => boolean,
): ChainRods {
  const { contacts, centre } = state;
  const chosen: number[] = [];
  for (let c = 0; c < contacts.count; ++c) {
    if (contacts.force_N[c]! < threshold * contacts.mean_N) continue;
    const i = 3 * contacts.body_i[c]!, j = 3 * contacts.body_j[c]!;
    if (visible((centre[i]! + centre[j]!) / 2, (centre[i + 1]! + centre[j + 1]!) / 2, (centre[i + 2]! + centre[j + 2]!) / 2)) chosen.push(c);
  }
  const n = chosen.length, branch = meanBranch(state);
  const rods: ChainRods = {
    count: n, start: new Float32Array(3 * n), end: new Float32Array(3 * n),
    radius: new Float32Array(n), colour: new Uint8Array(3 * n),
    range: robustRange(Float32Array.from(chosen, (c) => contacts.force_N[c]!)),
  };
  chosen.forEach((c, k) => {
    const i = contacts.body_i[c]!, j = contacts.body_j[c]!, force = contacts.force_N[c]!;
    rods.start.set(centre.subarray(3 * i, 3 * i + 3), 3 * k);
    rods.end.set(centre.subarray(3 * j, 3 * j + 3), 3 * k);
    rods.radius[k] = branch * Math.min(0.3, 0.05 * Math.sqrt(force / contacts.mean_N));
    const { low, high } = rods.range;
    const byKind = CONTACT_COLOURS[contactKind(geometry.rubberGrains, i, j)]!;
    rods.colour.set(colouring === "contact" ? byKind : scaleColour("plasma", (force - low) / (high - low)), 3 * k);
  });
  return rods;
}
