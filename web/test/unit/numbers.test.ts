// SPDX-License-Identifier: BSD-3-Clause
// Numbers as the page shows them: expected texts are written by hand.
import assert from "node:assert/strict";
import { test } from "node:test";
import { formatNumber, labelOf, splitUnit, withUnit } from "../../src/numbers.ts";

test("four significant digits, whole numbers whole", () => {
  assert.equal(formatNumber(118.5998775544916), "118.6");
  assert.equal(formatNumber(0.6254757088669642), "0.6255");
  assert.equal(formatNumber(1.0000314501494876), "1");
  assert.equal(formatNumber(16971), "16\u202f971");
  assert.equal(formatNumber(4483), "4483");
  assert.equal(formatNumber(12345.678), "12\u202f346");
  assert.equal(formatNumber(0), "0");
});

test("small and large numbers as powers of ten, negative ones with a true minus", () => {
  assert.equal(formatNumber(0.00029513545), "2.95 × 10⁻⁴");
  assert.equal(formatNumber(-0.14438), "−0.1444");
  assert.equal(formatNumber(3.2e9 + 0.5), "3.20 × 10⁹");
  assert.equal(formatNumber(-1.4e-15), "−1.40 × 10⁻¹⁵");
});

test("what is no number says so", () => {
  for (const nothing of [null, undefined, Number.NaN, Infinity]) assert.equal(formatNumber(nothing), "–");
});

test("units come from the names of the files, the longest first", () => {
  assert.deepEqual(splitUnit("secant_stiffness_kPa_per_mm"), ["secant_stiffness", "kPa/mm"]);
  assert.deepEqual(splitUnit("peak_shear_stress_kPa"), ["peak_shear_stress", "kPa"]);
  assert.deepEqual(splitUnit("theta_n_all_deg"), ["theta_n_all", "°"]);
  assert.deepEqual(splitUnit("bond_moment_mN_m"), ["bond_moment", "mN·m"]);
  assert.deepEqual(splitUnit("void_ratio"), ["void_ratio", ""]);
  assert.deepEqual(splitUnit("energy_closure_per_cent"), ["energy_closure", "%"]);
});

test("a unit of 1 is not written, degrees stand close", () => {
  assert.equal(withUnit("5", "1"), "5");
  assert.equal(withUnit("45", "°"), "45°");
  assert.equal(withUnit("5", "kPa"), "5\u202fkPa");
  assert.equal(labelOf("residual_shear_stress_kPa"), "Residual shear stress");
});
