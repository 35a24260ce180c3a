// SPDX-License-Identifier: BSD-3-Clause
// From the packed states to balls, bodies and contacts in space: which ball belongs to which body, where all of them are.
import type { View, ViewState } from "../data.ts";
import { unpackIntegers, type Integers } from "./unpack.ts";

export const GRAIN_BALLS = 35;
const QUATERNION_UNIT = 32767;

/** What is the same in every state. Balls: 35 for each rubber grain, then pebbles; bodies: rubber grains, then clumps. */
export interface Geometry {
  balls: number;
  rubberBalls: number;
  bodies: number;
  rubberGrains: number;
  clumps: number;
  /** Of each ball, mm. */
  radius: Float32Array;
  /** Of each ball. */
  body: Uint32Array;
  /** First pebble of each clump among all pebbles, and their number at the end. */
  firstPebble: Uint32Array;
  /** Place of each pebble in the frame of its clump, mm: x, y, z of the first, ... */
  pebble: Float32Array;
}

/** One state, decoded. Lengths in mm; triples x, y, z of the first, ... */
export interface BodyState {
  displacement_mm: number;
  position: Float32Array;
  centre: Float32Array;
  /** w, x, y, z of each clump. */
  orientation: Float32Array;
  /** Mean stress of each body, kPa. */
  stress: Float32Array;
  /** Mean bond strain of each rubber grain. */
  strain: Float32Array;
  contacts: Contacts;
  walls: ViewState["walls"];
}

export interface Contacts {
  count: number;
  body_i: Integers;
  body_j: Integers;
  force_N: Float32Array;
  mean_N: number;
}

function expect(what: string, found: number, wanted: number): void {
  if (found !== wanted) throw new Error(`view of the specimen: ${found} numbers for ${what}, expected ${wanted}`);
}

function scaled(integers: Integers, step: number): Float32Array {
  const values = new Float32Array(integers.length);
  for (let i = 0; i < values.length; ++i) values[i] = integers[i]! * step;
  return values;
}

export async function decodeGeometry(view: View): Promise<Geometry> {
  const [rubberRadius, pebblesOf, pebblePlace, pebbleRadius] = await Promise.all([
    unpackIntegers(view.rubber_radius), unpackIntegers(view.clump_pebbles),
    unpackIntegers(view.pebble_position), unpackIntegers(view.pebble_radius),
  ]);
  const rubberGrains = view.rubber_grains, clumps = view.clumps, rubberBalls = GRAIN_BALLS * rubberGrains;
  expect("the radii of rubber", rubberRadius.length, rubberGrains);
  expect("the pebbles of clumps", pebblesOf.length, clumps);
  const firstPebble = new Uint32Array(clumps + 1);
  for (let c = 0; c < clumps; ++c) firstPebble[c + 1] = firstPebble[c]! + pebblesOf[c]!;
  const pebbles = firstPebble[clumps]!;
  expect("the radii of pebbles", pebbleRadius.length, pebbles);
  expect("the places of pebbles", pebblePlace.length, 3 * pebbles);

  const balls = rubberBalls + pebbles;
  const radius = new Float32Array(balls), body = new Uint32Array(balls);
  for (let g = 0; g < rubberGrains; ++g) {
    radius.fill(rubberRadius[g]! * view.radius_step_mm, GRAIN_BALLS * g, GRAIN_BALLS * (g + 1));
    body.fill(g, GRAIN_BALLS * g, GRAIN_BALLS * (g + 1));
  }
  for (let p = 0; p < pebbles; ++p) radius[rubberBalls + p] = pebbleRadius[p]! * view.radius_step_mm;
  for (let c = 0; c < clumps; ++c) {
    body.fill(rubberGrains + c, rubberBalls + firstPebble[c]!, rubberBalls + firstPebble[c + 1]!);
  }
  return {
    balls, rubberBalls, bodies: rubberGrains + clumps, rubberGrains, clumps, radius, body, firstPebble,
    pebble: scaled(pebblePlace, view.radius_step_mm),
  };
}

/** Whole coordinates of the rubber balls along one axis: each is predicted from balls that were decoded before it. */
export function predictRubber(residuals: Integers, start: number, grains: number, rows: View["rubber_prediction"]): Int32Array {
  const place = new Int32Array(GRAIN_BALLS * grains);
  for (let g = 0; g < grains; ++g) {
    const first = GRAIN_BALLS * g;
    for (let k = 0; k < GRAIN_BALLS; ++k) {
      const [a, b, c] = rows[k]!;
      let predicted: number;
      if (a < 0) predicted = g === 0 ? 0 : place[first - GRAIN_BALLS]!;
      else if (b < 0) predicted = place[first + a]!;
      else predicted = place[first + a]! + place[first + b]! - place[first + c]!;
      place[first + k] = predicted + residuals[start + first + k]!;
    }
  }
  return place;
}

function checkPrediction(rows: View["rubber_prediction"]): void {
  expect("the rows of the prediction", rows.length, GRAIN_BALLS);
  rows.forEach((row, k) => {
    if (row.some((ball) => ball >= k && ball >= 0)) {
      throw new Error(`view of the specimen: ball ${k} of a rubber grain is predicted from a later one`);
    }
  });
}

/** Turns (x, y, z) by the unit quaternion at `q` of `quaternions` and adds it to `to` at `out`. */
function placePebble(quaternions: Float32Array, q: number, local: Float32Array, l: number, to: Float32Array, out: number): void {
  const w = quaternions[q]!, x = quaternions[q + 1]!, y = quaternions[q + 2]!, z = quaternions[q + 3]!;
  const px = local[l]!, py = local[l + 1]!, pz = local[l + 2]!;
  const tx = 2 * (y * pz - z * py), ty = 2 * (z * px - x * pz), tz = 2 * (x * py - y * px);
  to[out]! += px + w * tx + (y * tz - z * ty);
  to[out + 1]! += py + w * ty + (z * tx - x * tz);
  to[out + 2]! += pz + w * tz + (x * ty - y * tx);
}

function readClumps(view: View, geometry: Geometry, places: Integers, turns: Integers, state: BodyState): void {
  const { clumps, rubberGrains, rubberBalls, firstPebble } = geometry;
  for (let c = 0; c < clumps; ++c) {
    let size = 0;
    for (let axis = 0; axis < 4; ++axis) size += (turns[axis * clumps + c]! / QUATERNION_UNIT) ** 2;
    const scale = 1 / (QUATERNION_UNIT * Math.sqrt(size || 1));
    for (let axis = 0; axis < 4; ++axis) state.orientation[4 * c + axis] = turns[axis * clumps + c]! * scale;
    for (let axis = 0; axis < 3; ++axis) {
      const place = view.origin_mm[axis]! + view.step_mm[axis]! * places[axis * clumps + c]!;
      state.centre[3 * (rubberGrains + c) + axis] = place;
      for (let p = firstPebble[c]!; p < firstPebble[c + 1]!; ++p) state.position[3 * (rubberBalls + p) + axis] = place;
    }
    for (let p = firstPebble[c]!; p < firstPebble[c + 1]!; ++p) {
      placePebble(state.orientation, 4 * c, geometry.pebble, 3 * p, state.position, 3 * (rubberBalls + p));
    }
  }
}

function readRubber(view: View, geometry: Geometry, residuals: Integers, state: BodyState): void {
  const { rubberGrains, rubberBalls } = geometry;
  for (let axis = 0; axis < 3; ++axis) {
    const place = predictRubber(residuals, axis * rubberBalls, rubberGrains, view.rubber_prediction);
    const origin = view.origin_mm[axis]!, step = view.step_mm[axis]!;
    for (let g = 0; g < rubberGrains; ++g) {
      let sum = 0;
      for (let b = GRAIN_BALLS * g; b < GRAIN_BALLS * (g + 1); ++b) {
        sum += place[b]!;
        state.position[3 * b + axis] = origin + step * place[b]!;
      }
      state.centre[3 * g + axis] = origin + (step * sum) / GRAIN_BALLS;
    }
  }
}

export async function decodeState(view: View, geometry: Geometry, index: number): Promise<BodyState> {
  const packed = view.states[index];
  if (!packed) throw new Error(`view of the specimen: there is no state ${index}, states are 0 to ${view.states.length - 1}`);
  if (geometry.rubberGrains > 0) checkPrediction(view.rubber_prediction);
  const [rubber, places, turns, stress, strain, body_i, body_j, force] = await Promise.all([
    unpackIntegers(packed.rubber), unpackIntegers(packed.clump_position), unpackIntegers(packed.clump_orientation),
    unpackIntegers(packed.body_stress), unpackIntegers(packed.bond_strain), unpackIntegers(packed.contact_body_i),
    unpackIntegers(packed.contact_body_j), unpackIntegers(packed.contact_force),
  ]);
  expect("the rubber balls", rubber.length, 3 * geometry.rubberBalls);
  expect("the places of clumps", places.length, 3 * geometry.clumps);
  expect("the turns of clumps", turns.length, 4 * geometry.clumps);
  expect("the stress of bodies", stress.length, geometry.bodies);
  expect("the bond strain", strain.length, geometry.rubberGrains);
  expect("the second bodies of contacts", body_j.length, body_i.length);
  expect("the forces of contacts", force.length, body_i.length);
  const state: BodyState = {
    displacement_mm: packed.displacement_mm,
    position: new Float32Array(3 * geometry.balls),
    centre: new Float32Array(3 * geometry.bodies),
    orientation: new Float32Array(4 * geometry.clumps),
    stress: scaled(stress, packed.stress_step_kPa),
    strain: scaled(strain, packed.strain_step),
    contacts: {
      count: body_i.length, body_i, body_j, force_N: scaled(force, packed.force_step_N), mean_N: packed.strong_threshold_N,
    },
    walls: packed.walls,
  };
  readRubber(view, geometry, rubber, state);
  readClumps(view, geometry, places, turns, state);
  return state;
}
