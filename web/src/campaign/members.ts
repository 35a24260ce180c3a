// SPDX-License-Identifier: BSD-3-Clause
// Orders the tests of a campaign: mixtures (all values but normal stress and seed) and normal stresses.
import type { PageData, Test } from "../data.ts";
import { formatNumber, labelOf, unitOf, withUnit } from "../numbers.ts";

export type Values = Record<string, string | number>;

export interface Member {
  test: Test;
  values: Values;
  /** Place among the mixtures and among the normal stresses, for colours and dashes. */
  mixture: number;
  stress: number;
}

export interface Members {
  members: Member[];
  mixtures: { values: Values; name: string }[];
  /** null: the study names no normal stress. */
  stresses: { value: number | null; name: string }[];
  /** Column that charts have on their x axis; null when no number varies. */
  across: string | null;
}

const NOT_A_MIXTURE = ["normal_stress_kPa", "seed"];

export function mixtureOf(values: Values): Values {
  return Object.fromEntries(Object.entries(values).filter(([name]) => !NOT_A_MIXTURE.includes(name)));
}

export function mixtureName(values: Values): string {
  const words = Object.entries(values).map(([name, value]) => {
    if (name === "rubber_content" && typeof value === "number") return `VRC\u00a0${formatNumber(100 * value)}\u202f%`;
    return `${labelOf(name)} ${typeof value === "number" ? withUnit(formatNumber(value), unitOf(name)) : value}`;
  });
  return words.join(", ") || "All tests";
}

/** Same names and values; numbers as the files round them. */
export function sameValues(one: Values, other: Values): boolean {
  const names = Object.keys(one);
  return names.length === Object.keys(other).length && names.every((name) => {
    const [here, there] = [one[name], other[name]];
    return typeof here === "number" && typeof there === "number" ? Math.abs(here - there) <= 1e-9 * Math.max(1, Math.abs(here)) : here === there;
  });
}

function placeOf<T>(list: T[], item: T, same: (one: T, other: T) => boolean): number {
  const place = list.findIndex((one) => same(one, item));
  return place >= 0 ? place : list.push(item) - 1;
}

export function membersOf(data: PageData): Members {
  const campaign = data.campaign;
  const mixtures: Values[] = [];
  const stresses: (number | null)[] = [];
  const found = (campaign?.tests ?? []).map(({ name, values }) => {
    const stress = values.normal_stress_kPa;
    return {
      test: data.tests.find((test) => test.name === name), values,
      mixture: placeOf(mixtures, mixtureOf(values), sameValues),
      stress: placeOf(stresses, typeof stress === "number" ? stress : null, (one, other) => one === other),
    };
  });
  const varies = (name: string) => new Set(mixtures.map((values) => values[name])).size > 1 && mixtures.every((values) => typeof values[name] === "number");
  const candidates = ["rubber_content", ...(campaign?.columns ?? [])].filter((name) => !NOT_A_MIXTURE.includes(name));
  return {
    members: found.filter((one): one is Member => one.test !== undefined),
    mixtures: mixtures.map((values) => ({ values, name: mixtureName(values) })),
    stresses: stresses.map((value) => ({ value, name: value === null ? "" : withUnit(formatNumber(value), "kPa") })),
    across: candidates.find(varies) ?? null,
  };
}
