// SPDX-License-Identifier: BSD-3-Clause
// Balls, bodies and their motion from a small packed view whose places and turns are known.
import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeGeometry, decodeState } from "../../src/view/bodies.ts";
import { chainRods, contactKind, strongShare } from "../../src/view/chains.ts";
import { bodyDisplacement, bodyRotation, fitRotation } from "../../src/view/rotation.ts";
import { LATTICE, PEBBLES, smallView, turned, type Body } from "./packing.ts";

function about(axis: [number, number, number], angle_deg: number): Body["turn"] {
  const half = (angle_deg * Math.PI) / 360, size = Math.hypot(...axis), s = Math.sin(half) / size;
  return [Math.cos(half), s * axis[0], s * axis[1], s * axis[2]];
}

function product([a, b, c, d]: Body["turn"], [w, x, y, z]: Body["turn"]): Body["turn"] {
  return [a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y, a * y - b * z + c * w + d * x, a * z + b * y - c * x + d * w];
}

const START: Body["turn"][] = [about([1, 2, 3], 40), about([0, 1, 0], -75), about([1, 0, 1], 130), about([2, -1, 0], 10)];
const TURNS: Body["turn"][] = [about([0, 1, 0], 25), about([1, 1, 1], 1), about([0, -1, 0], 90), about([1, 0, 0], 0)];
const ANGLES = [25, 1, 90, 0];
const CENTRES: Body["centre"][] = [[10, 0, 12], [22, 7, 15], [3, 20, 30.5], [-2, -8, 9]];
const SHIFTS: [number, number, number][] = [[3, 0, 4], [1, 0, 0], [0, 2, 0], [0, 0, 0]];

function bodies(turns: Body["turn"][], centres: Body["centre"][]) {
  const all = turns.map((turn, k) => ({ turn, centre: centres[k]! }));
  return { rubber: all.slice(0, 2), clumps: all.slice(2) };
}

const first = bodies(START, CENTRES);
const second = bodies(TURNS.map((turn, k) => product(turn, START[k]!)), CENTRES.map((c, k) => c.map((v, a) => v + SHIFTS[k]![a]!) as Body["centre"]));
const view = smallView([first, second]);
// Half a step of the lattice in each direction, and for pebbles the rounding of the turn and of the place in the clump.
const LATTICE_ERROR = 0.5 * Math.hypot(0.004, 0.003, 0.002) + 1e-5;

test("balls of rubber lie where the lattice was packed", async () => {
  const geometry = await decodeGeometry(view);
  for (const [n, known] of [first, second].entries()) {
    const state = await decodeState(view, geometry, n);
    known.rubber.forEach(({ centre, turn }, g) => LATTICE.forEach((site, k) => {
      const wanted = turned(turn, site).map((v, a) => v + centre[a]!), b = 3 * (35 * g + k);
      const error = Math.hypot(...wanted.map((v, a) => v - state.position[b + a]!));
      assert.ok(error <= LATTICE_ERROR, `state ${n}, grain ${g}, ball ${k}: off by ${error} mm`);
    }));
  }
});

test("pebbles follow the pose of their clump; radii and bodies are of the right balls", async () => {
  const geometry = await decodeGeometry(view);
  const state = await decodeState(view, geometry, 1);
  assert.equal(geometry.balls, 76);
  second.clumps.forEach(({ centre, turn }, c) => PEBBLES.forEach((place, p) => {
    const wanted = turned(turn, place).map((v, a) => v + centre[a]!), ball = 70 + 3 * c + p;
    const error = Math.hypot(...wanted.map((v, a) => v - state.position[3 * ball + a]!));
    assert.ok(error <= LATTICE_ERROR + 1e-4, `clump ${c}, pebble ${p}: off by ${error} mm`);
    assert.equal(geometry.body[ball], 2 + c);
    assert.equal(geometry.radius[ball], [1, 0.5, 0.75][p]);
  }));
  assert.deepEqual([geometry.body[34], geometry.body[35], geometry.radius[35]], [0, 1, 1]);
});

test("stress, strain, contacts and force chains", async () => {
  const geometry = await decodeGeometry(view);
  const state = await decodeState(view, geometry, 0);
  assert.deepEqual(Array.from(state.stress), [50, -2, 3.5, 150]);
  assert.deepEqual(Array.from(state.strain, (v) => Math.round(1000 * v)), [12, -3]);
  assert.equal(strongShare(state), 1 / 3);
  assert.deepEqual([contactKind(2, 2, 3), contactKind(2, 0, 2), contactKind(2, 0, 1)], [0, 1, 2]);
  const all = () => true;
  assert.deepEqual([0, 0.5, 1, 2.5].map((threshold) => chainRods(geometry, state, threshold, "contact", all).count), [3, 2, 1, 0]);
  const rods = chainRods(geometry, state, 1, "force", all);
  assert.deepEqual(Array.from(rods.start), Array.from(state.centre.subarray(6, 9)), "from body 2");
  assert.deepEqual(Array.from(rods.end), Array.from(state.centre.subarray(9, 12)), "to body 3");
  const thick = chainRods(geometry, state, 0, "contact", all).radius;
  assert.ok(Math.abs(thick[1]! / thick[0]! - Math.SQRT2) < 1e-5, "twice the force, twice the area");
});

test("displacement and rotation since the first state", async () => {
  const geometry = await decodeGeometry(view);
  const [from, to] = await Promise.all([decodeState(view, geometry, 0), decodeState(view, geometry, 1)]);
  const way = bodyDisplacement(from, to), angle = bodyRotation(geometry, from, to);
  [5, 1, 2, 0].forEach((wanted, body) => assert.ok(Math.abs(way[body]! - wanted) < 0.01, `body ${body} moved ${way[body]} mm, expected ${wanted}`));
  // Rounding of the lattice over the size of a grain (4 mm), averaged over 35 balls; of a quaternion: 1/32767.
  ANGLES.forEach((wanted, body) => assert.ok(Math.abs(angle[body]! - wanted) < 0.03, `body ${body} turned by ${angle[body]}°, expected ${wanted}`));
});

test("the fitted rotation of a squeezed grain is its rotation alone", () => {
  const turn = about([1, -2, 0.5], 63);
  // Squeezed along its own axes before it turns: the best rotation of a symmetric stretch is none.
  const before = Float32Array.from(LATTICE.flat());
  const after = Float32Array.from(LATTICE.flatMap(([x, y, z]) => turned(turn, [1.1 * x, 0.95 * y, 0.8 * z]).map((v, a) => v + [5, 6, 7][a]!)));
  const found = fitRotation(before, after, 0, 35);
  const same = Math.abs(found.reduce((sum, v, k) => sum + v * turn[k]!, 0));
  assert.ok(1 - same < 1e-6, `quaternions ${found} and ${turn} differ: product ${same}`);
});

test("a prediction from a later ball and a missing state are refused", async () => {
  const geometry = await decodeGeometry(view);
  const bad = { ...view, rubber_prediction: view.rubber_prediction.map((row, k) => (k === 4 ? [9, -1, -1] : row)) as typeof view.rubber_prediction };
  await assert.rejects(decodeState(bad, geometry, 0), /ball 4 of a rubber grain is predicted from a later one/);
  await assert.rejects(decodeState(view, geometry, 2), /no state 2, states are 0 to 1/);
});
