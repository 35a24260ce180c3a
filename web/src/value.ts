// SPDX-License-Identifier: BSD-3-Clause
// A number in the text: rounded for the eye, with its full value and the place it comes from in attributes that tests compare.
import { el } from "./dom.ts";
import { formatNumber, unitOf, withUnit } from "./numbers.ts";

/** Value at a path as summary.dilatancy_at_peak.shear_ratio; undefined when there is none. */
export function lookUp(record: unknown, path: string): unknown {
  let here: unknown = record;
  for (const key of path.split(".")) {
    if (here === null || typeof here !== "object") return undefined;
    here = (here as Record<string, unknown>)[key];
  }
  return here;
}

export function numberAt(record: unknown, path: string): number | null {
  const value = lookUp(record, path);
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

/** `source` is read by tests relative to the nearest ancestor with data-test, or to the whole data. */
export function numberSpan(value: number | null, source: string, unit = unitOf(source), digits = 4): HTMLElement {
  const attributes = value === null ? { class: "number none" } : { class: "number", "data-value": value, "data-source": source };
  const text = formatNumber(value, digits);
  return el("span", attributes, value === null ? text : withUnit(text, unit));
}

/** The number of `record` (summary or status) at `path`. */
export function measured(record: unknown, name: "summary" | "status", path: string, digits = 4): HTMLElement {
  return numberSpan(numberAt(record, path), `${name}.${path}`, unitOf(path), digits);
}

/** Any scalar of a file: numbers as above, texts and truth values as they are. */
export function scalar(value: unknown, source: string): HTMLElement {
  if (typeof value === "number") return numberSpan(value, source);
  if (value === null || value === undefined) return el("span", { class: "number none" }, "–");
  if (typeof value === "boolean") return el("span", {}, value ? "yes" : "no");
  return el("span", { class: "text" }, String(value));
}
