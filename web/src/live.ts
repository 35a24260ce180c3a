// SPDX-License-Identifier: BSD-3-Clause
// Follows a running test: the page loads itself anew and goes back to where the reader was.
import { el } from "./dom.ts";
import { keep, setting } from "./settings.ts";

export function restoreScroll(): void {
  const scroll = setting("scroll", 0);
  if (scroll > 0) requestAnimationFrame(() => scrollTo({ top: scroll, behavior: "instant" }));
}

/** Counts down and reloads; a switch holds it. */
export function liveBar(seconds: number): HTMLElement {
  let left = seconds;
  const words = el("span", { class: "countdown" });
  const box = el("input", { type: "checkbox", onchange: () => keep("live", box.checked) });
  box.checked = setting("live", true);
  const say = () => (words.textContent = box.checked ? `next in ${left} s` : "held");
  setInterval(() => {
    if (box.checked && !document.hidden) left -= 1;
    say();
    if (left > 0 || !box.checked) return;
    keep("scroll", scrollY);
    location.reload();
  }, 1000);
  say();
  return el("div", { class: "live" }, el("label", {}, box, "Follow the running test"), words);
}
