// SPDX-License-Identifier: BSD-3-Clause
// Light and dark: as the system has it, until the reader chooses. The choice stands in data-theme of the root element.
import { el } from "./dom.ts";
import { keep, setting } from "./settings.ts";

export function themeSwitch(): HTMLElement {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const button = el("button", { type: "button", class: "theme" });
  const apply = () => {
    const chosen = setting("theme", "");
    const dark = chosen === "" ? system.matches : chosen === "dark";
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    button.textContent = dark ? "Light" : "Dark";
    button.setAttribute("aria-label", dark ? "Switch to light colours" : "Switch to dark colours");
  };
  button.addEventListener("click", () => {
    keep("theme", document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    apply();
  });
  system.addEventListener("change", apply);
  // What is drawn by the graphics processor knows no style sheet of paper.
  addEventListener("beforeprint", () => (document.documentElement.dataset.theme = "light"));
  addEventListener("afterprint", apply);
  apply();
  return button;
}
