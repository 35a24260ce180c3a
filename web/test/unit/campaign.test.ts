// SPDX-License-Identifier: BSD-3-Clause
// How the tests of a campaign are ordered, which published rows speak of them, and what the verdicts say.
import assert from "node:assert/strict";
import { test } from "node:test";
import { membersOf, mixtureName, sameValues } from "../../src/campaign/members.ts";
import { speaksOf } from "../../src/campaign/published.ts";
import type { PageData, QualityLine, Test } from "../../src/data.ts";
import { qualityVerdict, testVerdict } from "../../src/sections/verdict.ts";

function testNamed(name: string, more: Partial<Test> = {}): Test {
  return {
    name, folder: "", kind: "direct_shear", state: "finished", command: "", state_hash: "", inputs: [], summary: {}, status: {},
    tables: { shear: null, walls: null, micro: null, profiles: null, compression: null }, histograms: [], sieve: null, quality: [], view: null, ...more,
  };
}

function campaignOf(rows: [string, Record<string, string | number>][]): PageData {
  return {
    format: 1, kind: "campaign", live_seconds: null, title: "", program: { version: "", commit: "", written: "", command: "" },
    tests: rows.map(([name]) => testNamed(name)), published: [], laboratory: [], notes: [],
    campaign: { name: "", columns: [...new Set(rows.flatMap(([, values]) => Object.keys(values)))], tests: rows.map(([name, values]) => ({ name, values, state: "done", reason: "" })), envelopes: [] },
  };
}

test("mixtures are what differs beside normal stress and seed", () => {
  const { members, mixtures, stresses, across } = membersOf(campaignOf([
    ["a", { rubber_content: 0, normal_stress_kPa: 50, seed: 1 }], ["b", { rubber_content: 0, normal_stress_kPa: 100, seed: 1 }],
    ["c", { rubber_content: 0.25, normal_stress_kPa: 50, seed: 2 }],
  ]));
  assert.deepEqual(mixtures.map(({ name }) => name), ["VRC\u00a00\u202f%", "VRC\u00a025\u202f%"]);
  assert.deepEqual(stresses.map(({ value }) => value), [50, 100]);
  assert.deepEqual(members.map(({ mixture, stress }) => [mixture, stress]), [[0, 0], [0, 1], [1, 0]]);
  assert.equal(across, "rubber_content");
});

test("a study of another key has this key on the axis; one without numbers has none", () => {
  assert.equal(membersOf(campaignOf([["a", { gravel_friction: 0.5 }], ["b", { gravel_friction: 0.7 }]])).across, "gravel_friction");
  assert.equal(membersOf(campaignOf([["a", { generation: "grown" }], ["b", { generation: "overlapping" }]])).across, null);
  assert.equal(mixtureName({ generation: "grown" }), "Generation grown");
  assert.ok(!sameValues({ a: 1 }, { a: 1, b: 2 }));
});

test("published rows speak of tests of the same content and stress", () => {
  const row = { rubber_content: 0.25, normal_stress_kPa: 60, quantity: "void_ratio_before_shear", value: 0.5, source: "" };
  const made = testNamed("a", { summary: { rubber_content: 0.2499, normal_stress_target_kPa: 60 } });
  assert.ok(speaksOf(row, made, null));
  assert.ok(!speaksOf({ ...row, normal_stress_kPa: 100 }, made, null));
  assert.ok(speaksOf({ ...row, normal_stress_kPa: null }, made, null));
  assert.ok(!speaksOf({ ...row, rubber_content: 0.4 }, made, null));
  assert.ok(!speaksOf(row, made, { rubber_content: 0.4, normal_stress_kPa: 60 }), "what the study asks for comes first");
});

test("the verdict is that of the worst line and names it", () => {
  const line = (name: string, verdict: QualityLine["verdict"]): QualityLine => ({ name, value: 1, unit: "", limit: "", verdict });
  assert.deepEqual(qualityVerdict([line("energy", "good")]), { tone: "good", text: "all checks passed" });
  assert.deepEqual(qualityVerdict([line("Inertial number, largest", "warning"), line("warning of the run", "warning"), line("warning of the run", "warning")]),
    { tone: "warning", text: "look at: inertial number and 2 warnings of the run" });
  assert.equal(qualityVerdict([line("a", "bad"), line("b", "warning")]).tone, "bad");
  assert.equal(qualityVerdict([]).tone, "unknown");
  assert.deepEqual(testVerdict(testNamed("a", { state: "failed", status: { cause: "the plate left the box" } })), { tone: "bad", text: "failed: the plate left the box" });
  assert.equal(testVerdict(testNamed("a", { state: "running", status: { stage: "shear", progress: 0.456 } })).text, "running, shear, 46 %");
});
