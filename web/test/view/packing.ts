// SPDX-License-Identifier: BSD-3-Clause
// Packs whole numbers as data.ts describes, written from that description alone, for the tests of the view.
import { deflateSync } from "node:zlib";
import type { PackedIntegers, View, ViewState } from "../../src/data.ts";

export function pack(numbers: number[], bytes: 1 | 2 | 4, zigzag: boolean, delta: boolean): PackedIntegers {
  const modulus = 2n ** BigInt(8 * bytes), half = modulus / 2n;
  let before = 0n;
  const words = numbers.map((number, k) => {
    let word = BigInt(number);
    if (delta && k > 0) word -= before;
    before = BigInt(number);
    word = ((word % modulus) + modulus) % modulus;
    if (zigzag) {
      if (word >= half) word -= modulus;
      word = word < 0n ? -2n * word - 1n : 2n * word;
    }
    return word;
  });
  const planes = new Uint8Array(bytes * words.length);
  words.forEach((word, k) => {
    for (let plane = 0; plane < bytes; ++plane) planes[plane * words.length + k] = Number((word >> BigInt(8 * plane)) & 255n);
  });
  return { count: numbers.length, bytes, zigzag, delta, data: Buffer.from(deflateSync(planes)).toString("base64") };
}

/** A corner of the lattice of a rubber grain from its neighbours, a centre from the lowest corner of its cell and the first centre. */
export function predictionRows(): [number, number, number][] {
  const rows: [number, number, number][] = [];
  for (let slot = 0; slot < 27; ++slot) {
    const moved = [1, 3, 9].filter((step) => Math.floor(slot / step) % 3 > 0);
    if (moved.length === 0) rows.push([-1, -1, -1]);
    else if (moved.length === 1) rows.push([0, -1, -1]);
    else rows.push([slot - moved[0]!, slot - moved[1]!, slot - moved[0]! - moved[1]!]);
  }
  rows.push([0, -1, -1]);
  for (let cell = 1; cell < 8; ++cell) rows.push([(cell & 1) + 3 * ((cell >> 1) & 1) + 9 * ((cell >> 2) & 1), 27, 0]);
  return rows;
}

/** Residuals of whole coordinates along one axis. */
export function residuals(places: number[], rows: [number, number, number][]): number[] {
  return places.map((place, n) => {
    const first = n - (n % 35), [a, b, c] = rows[n % 35]!;
    if (a < 0) return place - (n === 0 ? 0 : places[n - 35]!);
    if (b < 0) return place - places[first + a]!;
    return place - (places[first + a]! + places[first + b]! - places[first + c]!);
  });
}

export interface Body {
  centre: [number, number, number];
  /** Unit quaternion w, x, y, z. */
  turn: [number, number, number, number];
}

export function turned([w, x, y, z]: Body["turn"], [a, b, c]: [number, number, number]): [number, number, number] {
  // The matrix of the quaternion, not the formula of the view.
  return [
    (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c,
    2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c,
    2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c,
  ];
}

/** Balls of a rubber grain of ball radius 1 at rest: 27 corners, 8 centres. */
export const LATTICE: [number, number, number][] = Array.from({ length: 35 }, (_, slot) => {
  const a = 4 / Math.sqrt(3);
  if (slot < 27) return [((slot % 3) - 1) * a, ((Math.floor(slot / 3) % 3) - 1) * a, (Math.floor(slot / 9) - 1) * a];
  const cell = slot - 27;
  return [((cell & 1) - 0.5) * a, (((cell >> 1) & 1) - 0.5) * a, (((cell >> 2) & 1) - 0.5) * a];
});

export const PEBBLES: [number, number, number][] = [[0.5, 0, 0], [-0.5, 0.25, 0], [0, -0.25, 0.75]];
const ORIGIN: [number, number, number] = [-10, -20, -5], STEP: [number, number, number] = [0.004, 0.003, 0.002], RADIUS_STEP = 1 / 1024;

/** A view of two rubber grains and two clumps in the given states. */
export function smallView(states: { rubber: Body[]; clumps: Body[] }[]): View {
  const rows = predictionRows();
  const packedStates = states.map(({ rubber, clumps }, n): ViewState => {
    const whole = (places: [number, number, number][], axis: number) => places.map((p) => Math.round((p[axis]! - ORIGIN[axis]!) / STEP[axis]!));
    const balls = rubber.flatMap(({ centre, turn }) => LATTICE.map((site) => turned(turn, site).map((v, axis) => v + centre[axis]!) as [number, number, number]));
    return {
      displacement_mm: 2 * n,
      rubber: pack([0, 1, 2].flatMap((axis) => residuals(whole(balls, axis), rows)), 2, true, false),
      clump_position: pack([0, 1, 2].flatMap((axis) => whole(clumps.map((clump) => clump.centre), axis)), 2, true, true),
      clump_orientation: pack([0, 1, 2, 3].flatMap((k) => clumps.map((clump) => Math.round(32767 * clump.turn[k]!))), 2, true, false),
      stress_step_kPa: 0.5, body_stress: pack([100, -4, 7, 300], 2, true, false),
      strain_step: 0.001, bond_strain: pack([12, -3], 1, true, false),
      contact_body_i: pack([0, 0, 2], 1, false, true), contact_body_j: pack([1, 2, 3], 1, false, false),
      force_step_N: 0.1, contact_force: pack([10, 20, 60], 1, false, false), strong_threshold_N: 3,
      walls: [{ name: "bottom plate", corner_mm: [0, 0, 0], u_mm: [50, 0, 0], v_mm: [0, 50, 0] }],
    };
  });
  return {
    origin_mm: ORIGIN, step_mm: STEP, rubber_grains: 2, clumps: 2, radius_step_mm: RADIUS_STEP, rubber_radius: pack([1024, 1024], 2, false, false),
    rubber_prediction: rows, clump_pebbles: pack([3, 3], 1, false, false),
    pebble_position: pack([...PEBBLES, ...PEBBLES].flat().map((v) => v * 1024), 2, true, false),
    pebble_radius: pack([1024, 512, 768, 1024, 512, 768], 2, false, false), states: packedStates,
  };
}
