// SPDX-License-Identifier: BSD-3-Clause
// Legend whose entries switch series on and off and show the values under the cursor.
import { el } from "../dom.ts";
import type { ChartGroup } from "./group.ts";
import { type Look, swatch } from "./style.ts";

export interface LegendEntry extends Look {
  name: string;
  key: string;
  draw: "line" | "points" | "both";
}

export interface Legend {
  element: HTMLElement;
  /** Values at the cursor, in the order of the entries; null takes them away. */
  setValues(values: (string | null)[] | null): void;
}

export function legend(entries: LegendEntry[], group: ChartGroup, label: string): Legend {
  const values: HTMLElement[] = [];
  const boxes: [string, HTMLInputElement][] = [];
  const element = el("div", { class: "legend", role: "group", "aria-label": `Series of ${label}` });
  for (const entry of entries) {
    const value = el("span", { class: "at-cursor" });
    values.push(value);
    if (entries.length === 1) {
      element.append(el("span", { class: "entry" }, swatch(entry, entry.draw), entry.name, value));
      continue;
    }
    const box = el("input", { type: "checkbox", onchange: () => group.show(entry.key, box.checked) });
    box.checked = group.shows(entry.key);
    boxes.push([entry.key, box]);
    element.append(el("label", { class: "entry" }, box, swatch(entry, entry.draw), entry.name, value));
  }
  group.listen(() => {
    for (const [key, box] of boxes) box.checked = group.shows(key);
  });
  return {
    element,
    setValues: (texts) => values.forEach((value, place) => (value.textContent = texts?.[place] ?? "")),
  };
}
