// SPDX-License-Identifier: BSD-3-Clause
// The numbers that a reader wants first, and how far a test has come while it is not finished.
import type { Test } from "../data.ts";
import { el } from "../dom.ts";
import { labelOf } from "../numbers.ts";
import { lookUp, measured, numberSpan, numberAt } from "../value.ts";

const FIRST: Record<Test["kind"], string[]> = {
  direct_shear: [
    "peak_shear_stress_kPa", "displacement_at_peak_mm", "residual_shear_stress_kPa", "dilation_angle_deg",
    "secant_stiffness_kPa_per_mm", "vertical_displacement_at_end_mm", "void_ratio_before_shear", "normal_stress_mean_kPa",
    "rubber_content", "clumps", "rubber_grains", "balls",
  ],
  grain_compression: [
    "load_at_end_N", "strain", "initial_stiffness_N_per_mm", "late_stiffness_N_per_mm", "knee_strain", "poisson_ratio_initial",
    "grain_height_mm", "balls",
  ],
  specimen: [
    "void_ratio_before_shear", "relative_density", "height_before_shear_mm", "rubber_content", "clumps", "rubber_grains", "balls",
    "contacts_before_shear", "k0_x", "k0_y",
  ],
};
const WHILE_RUNNING = [
  "displacement_mm", "shear_stress_kPa", "normal_stress_kPa", "void_ratio", "inertial_number", "unbalanced_ratio", "step", "steps_per_second",
];

function keyNumbers(record: Record<string, unknown>, name: "summary" | "status", keys: string[]): HTMLElement {
  const shown = keys.filter((key) => typeof lookUp(record, key) === "number");
  return el("dl", { class: "key-numbers" }, ...shown.map((key) =>
    el("div", {}, el("dt", {}, labelOf(key)), el("dd", {}, measured(record, name, key)))));
}

function progress(test: Test): HTMLElement {
  const done = numberAt(test.status, "progress");
  const { stage, eta, cause } = test.status;
  const rows: [string, unknown][] = [["Stage", stage], ["Expected end (UTC)", eta], ["Cause", cause]];
  const label = typeof stage === "string" && stage ? `Progress of ${stage}` : "Progress";
  const bar = done === null ? null : el("label", { class: "progress" }, label, el("progress", { max: 1, value: Math.min(1, done) }),
    numberSpan(done, "status.progress", "", 3));
  return el("div", { class: "running" }, bar, el("dl", { class: "plain" },
    ...rows.filter(([, value]) => typeof value === "string" && value !== "").flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, String(value))])));
}

export function overview(test: Test): HTMLElement[] {
  const parts: HTMLElement[] = [];
  const finished = Object.keys(test.summary).length > 0;
  if (test.state !== "finished" && test.state !== "specimen ready") parts.push(progress(test));
  if (finished) parts.push(keyNumbers(test.summary, "summary", FIRST[test.kind]));
  else if (Object.keys(test.status).length > 0) parts.push(keyNumbers(test.status, "status", WHILE_RUNNING));
  else parts.push(el("p", {}, "There are no numbers of this test yet."));
  if (test.summary.hardening === true) {
    parts.push(el("p", { class: "hint" }, "The shear stress was still rising at the end: the peak is a lower bound, and a residual stress was not reached."));
  }
  return parts;
}

