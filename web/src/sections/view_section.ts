// SPDX-License-Identifier: BSD-3-Clause
// The specimen in three dimensions, unpacked when the reader comes near it.
import type { Test } from "../data.ts";
import { el } from "../dom.ts";
import { createSpecimenView } from "../view/specimen_view.ts";

export function viewSection(test: Test): HTMLElement {
  const { view } = test;
  if (!view || view.states.length === 0) {
    return el("p", {}, view ? "No state is stored yet." : "The page was written without the states of the specimen.");
  }
  const box = el("div", { class: "specimen-view", "data-view": test.name }, el("p", { class: "waiting" }, "The specimen is unpacked when it comes into sight."));
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    box.replaceChildren();
    // Where it cannot be shown, a sentence takes its place.
    void createSpecimenView(box, view, test.name);
  }, { rootMargin: "300px" });
  observer.observe(box);
  return box;
}
