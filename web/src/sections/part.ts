// SPDX-License-Identifier: BSD-3-Clause
// Parts of the page: a heading that the navigation links to, and what stands under it.
import { type Child, el } from "../dom.ts";

export interface Part {
  id: string;
  title: string;
  /** For the navigation, where the title is long. */
  short?: string;
  /** One sentence under the heading; none when it would only say what is seen. */
  note?: Child[];
  body: Child[];
}

export function charts(...figures: (HTMLElement | null)[]): HTMLElement {
  return el("div", { class: "charts" }, ...figures);
}

/** `level` of the heading: 2 for parts of the page, 3 for parts of a test. */
export function section(part: Part, level: 2 | 3): HTMLElement {
  const heading = el(level === 2 ? "h2" : "h3", { id: `${part.id}-heading` }, part.title);
  // Parts of the page are landmarks; those of a test, which every test has, are not.
  const landmark = level === 2 ? `${part.id}-heading` : null;
  return el("section", { id: part.id, class: level === 2 ? "part" : "subpart", "aria-labelledby": landmark },
    heading, part.note ? el("p", { class: "note" }, ...part.note) : null, ...part.body);
}
