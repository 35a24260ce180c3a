// SPDX-License-Identifier: BSD-3-Clause
// Small calculations of the charts against closed forms: bands of polar curves, slopes, CSV.
import assert from "node:assert/strict";
import { test } from "node:test";
import { bandAt, signedBand } from "../../src/chart/polar_band.ts";
import { csvText } from "../../src/chart/export.ts";
import { slope } from "../../src/tables.ts";

const near = (value: number | null | undefined, expected: number) => assert.ok(value !== null && value !== undefined && Math.abs(value - expected) < 1e-9, `${value} is not ${expected}`);

test("a band without width is the curve", () => {
  const band = { mean: 2, unit: 2, harmonic: 2 as const, amplitude: [0.3, 0.3] as [number, number], direction_deg: [40, 40] as [number, number] };
  for (let angle = 0; angle < 360; angle += 7) {
    const curve = 2 * (1 + 0.3 * Math.cos((2 * (angle - 40) * Math.PI) / 180));
    near(bandAt(band, angle)[0], curve);
    near(bandAt(band, angle)[1], curve);
  }
});

test("a band holds every curve inside its bounds and touches the outermost", () => {
  const band = { mean: 1, unit: 1, harmonic: 4 as const, amplitude: [0.05, 0.2] as [number, number], direction_deg: [-10, 35] as [number, number] };
  for (let angle = 0; angle < 360; angle += 5) {
    const [low, high] = bandAt(band, angle);
    let [least, most] = [Infinity, -Infinity];
    for (let direction = -10; direction <= 35; direction += 0.25) {
      for (const amplitude of [0.05, 0.1, 0.2]) {
        const curve = 1 + amplitude * Math.cos((4 * (angle - direction) * Math.PI) / 180);
        assert.ok(curve >= low - 1e-12 && curve <= high + 1e-12, `${curve} is outside ${low} to ${high} at ${angle}`);
        [least, most] = [Math.min(least, curve), Math.max(most, curve)];
      }
    }
    // The steps of a quarter degree miss the extremes by less than this.
    assert.ok(least - low < 1e-4 && high - most < 1e-4, `the band is too wide at ${angle}`);
  }
});

test("the signed tangential force is -f a sin 2 (theta - theta_s)", () => {
  const band = signedBand(3, [0.1, 0.1], [30, 30]);
  for (let angle = 0; angle < 360; angle += 11) near(bandAt(band, angle)[0], -3 * 0.1 * Math.sin((2 * (angle - 30) * Math.PI) / 180));
});

test("slope of a parabola is its tangent; gaps and ends have none", () => {
  const x = Array.from({ length: 11 }, (_, row) => row * 0.1);
  const found = slope(x, x.map((value) => value * value), 2);
  assert.deepEqual([found[0], found[1], found[9], found[10]], [null, null, null, null]);
  for (let row = 2; row <= 8; row += 1) near(found[row], 2 * (x[row] ?? 0));
  assert.equal(slope(x, x.map((value, row) => (row === 5 ? null : value)), 2)[4], null);
});

test("CSV quotes what needs it and keeps all digits", () => {
  assert.equal(csvText(["a", 'say "b", c'], [[1.0000314501494876, "x\ny"], [null, "plain"]]), 'a,"say ""b"", c"\r\n1.0000314501494876,"x\ny"\r\n,plain\r\n');
});
