// SPDX-License-Identifier: BSD-3-Clause
// Colours of page.css: contrast by the formula of WCAG 2.2, and distance of the series for colour-blind readers by the matrices of
// Machado, Oliveira and Fernandes (2009) at full severity.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

// The tests run from a temporary folder; npm starts them in web/.
const css = readFileSync("src/page.css", "utf8");
type Colour = [number, number, number];

function block(selector: string): Record<string, Colour> {
  const start = css.indexOf(`${selector} {`);
  assert.ok(start >= 0, `${selector} is not in page.css`);
  const body = css.slice(start, css.indexOf("}", start));
  const colours: Record<string, Colour> = {};
  for (const [, name = "", hex = ""] of body.matchAll(/--([\w-]+): #([0-9a-f]{6})/g)) {
    colours[name] = [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255) as Colour;
  }
  return colours;
}

const linear = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const luminance = ([r, g, b]: Colour) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);

function contrast(one: Colour, other: Colour): number {
  const [low = 0, high = 0] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

const THEMES: [string, Record<string, Colour>][] = [
  ["light", block(".light-colours")], ["dark", block(':root[data-theme="dark"]')], ["print", block(':root, :root[data-theme="dark"]')],
];
const SERIES = ["c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"];

for (const [name, colours] of THEMES) {
  test(`${name}: text has 4.5 to 1, series and axes 3 to 1`, () => {
    const at = (key: string): Colour => colours[key] ?? assert.fail(`${name} has no --${key}`);
    for (const text of ["text", "muted", "accent", "good", "warning", "bad"]) {
      for (const ground of ["ground", "raised"]) {
        const found = contrast(at(text), at(ground));
        assert.ok(found >= 4.5, `${text} on ${ground}: ${found.toFixed(2)}`);
      }
    }
    for (const zone of ["zone-rigid", "zone-intermediate", "zone-soft"]) assert.ok(contrast(at("text"), at(zone)) >= 4.5, zone);
    for (const line of [...SERIES, "axis"]) {
      const found = contrast(at(line), at("ground"));
      assert.ok(found >= 3, `${line}: ${found.toFixed(2)}`);
    }
  });
}

const BLINDNESS: Record<string, number[][]> = {
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};

/** CIE L*a*b* under D65 of linear sRGB. */
function lab(rgb: number[]): number[] {
  const [r = 0, g = 0, b = 0] = rgb.map((value) => Math.min(1, Math.max(0, value)));
  const white = [0.95047, 1, 1.08883];
  const xyz = [0.4124 * r + 0.3576 * g + 0.1805 * b, 0.2126 * r + 0.7152 * g + 0.0722 * b, 0.0193 * r + 0.1192 * g + 0.9505 * b];
  const [x = 0, y = 0, z = 0] = xyz.map((value, k) => {
    const t = value / (white[k] ?? 1);
    return t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116;
  });
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

for (const [name, colours] of THEMES) {
  test(`${name}: the first four series differ for every kind of colour blindness`, () => {
    for (const [blindness, matrix] of Object.entries(BLINDNESS)) {
      const seen = SERIES.slice(0, 4).map((key) => {
        const rgb = (colours[key] ?? assert.fail(key)).map(linear);
        return lab(matrix.map((row) => row.reduce((sum, weight, k) => sum + weight * (rgb[k] ?? 0), 0)));
      });
      seen.forEach((one, k) => seen.slice(k + 1).forEach((other, step) => {
        const distance = Math.hypot(...one.map((value, axis) => value - (other[axis] ?? 0)));
        // About ten is what the eye tells apart at a glance; dashes and symbols come on top.
        assert.ok(distance > 10, `${blindness}: c${k} and c${k + 1 + step} differ by ${distance.toFixed(1)} only`);
      }));
    }
  });
}
