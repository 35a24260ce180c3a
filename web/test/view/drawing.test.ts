// SPDX-License-Identifier: BSD-3-Clause
// Ranges and scales of colours, the scale bar and the walls as they are drawn.
import assert from "node:assert/strict";
import { test } from "node:test";
import { scaleBarLength } from "../../src/view/overlay.ts";
import { robustRange, scaleColour } from "../../src/view/palettes.ts";
import { isLower, wallCorners } from "../../src/view/walls.ts";

test("extreme values do not widen the range of colours, and are told", () => {
  const values = Float32Array.from({ length: 101 }, (_, k) => 50 + k);
  values[100] = 1e6;
  const range = robustRange(values);
  assert.deepEqual([range.low, range.high, range.below, range.above], [52, 147, true, true]);
});

test("ranges from zero, of one value and of none", () => {
  assert.equal(robustRange(Float32Array.from([0.01, 5, 10])).low, 0);
  const one = robustRange(Float32Array.from([3, 3]));
  assert.ok(one.high > one.low);
  assert.deepEqual([robustRange(new Float32Array(0)).low, robustRange(new Float32Array(0)).high], [0, 1]);
});

test("scales begin and end with the colours of their source, and grow lighter on the way", () => {
  assert.deepEqual(scaleColour("viridis", 0), [0x44, 0x01, 0x54]);
  assert.deepEqual(scaleColour("viridis", 1), [0xfd, 0xe7, 0x25]);
  assert.deepEqual(scaleColour("cividis", 2), scaleColour("cividis", 1));
  for (const scale of ["viridis", "cividis", "plasma"] as const) {
    const luminance = Array.from({ length: 33 }, (_, k) => {
      const [r, g, b] = scaleColour(scale, k / 32).map((v) => (v / 255) ** 2.2) as [number, number, number];
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    });
    luminance.slice(1).forEach((value, k) => assert.ok(value > luminance[k]! - 1e-3, `${scale} darkens at ${k}`));
  }
});

test("the scale bar is a round length that fits", () => {
  for (const pixels of [0.7, 3, 6.1, 55, 400]) {
    const length = scaleBarLength(pixels, 800);
    assert.ok(length * pixels <= 130 && length * pixels > 40, `${length} mm at ${pixels} pixels/mm`);
    assert.match(length.toExponential(), /^[125]e/);
  }
});

test("high walls end at the top that is asked for, others stay", () => {
  const walls = [
    { name: "upper wall -x", corner_mm: [0, 0, 26], u_mm: [0, 50, 0], v_mm: [0, 0, 54] },
    { name: "lower wall -x", corner_mm: [4, 0, 0], u_mm: [0, 50, 0], v_mm: [0, 0, 26] },
    { name: "top plate", corner_mm: [0, 0, 55], u_mm: [0, 50, 0], v_mm: [50, 0, 0] },
  ] as Parameters<typeof wallCorners>[0];
  const [upper, lower, plate] = wallCorners(walls, 58);
  assert.deepEqual(upper, [[0, 0, 26], [0, 50, 26], [0, 50, 58], [0, 0, 58]]);
  assert.deepEqual(lower, [[4, 0, 0], [4, 50, 0], [4, 50, 26], [4, 0, 26]]);
  assert.deepEqual(plate, [[0, 0, 55], [0, 50, 55], [50, 50, 55], [50, 0, 55]]);
  assert.deepEqual(walls.map(isLower), [false, true, false]);
});
