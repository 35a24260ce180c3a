// SPDX-License-Identifier: BSD-3-Clause
// Native sliders and choices with labels, whose settings outlive a reload.
import { el, uniqueId } from "./dom.ts";
import { keep, setting } from "./settings.ts";

/** Chooses one of several values; calls back at once with the first choice. */
export function slider(name: string, label: string, texts: string[], start: number, choose: (place: number) => void): HTMLElement {
  const id = uniqueId("slider");
  const last = texts.length - 1;
  const output = el("output", { for: id });
  const input = el("input", { type: "range", id, min: 0, max: last, step: 1 });
  const use = (place: number) => {
    output.textContent = texts[place] ?? "";
    input.setAttribute("aria-valuetext", texts[place] ?? "");
    choose(place);
  };
  input.addEventListener("input", () => {
    keep(name, Number(input.value));
    use(Number(input.value));
  });
  const first = Math.min(last, Math.max(0, setting(name, start)));
  input.value = String(first);
  use(first);
  if (texts.length < 2) return el("p", { class: "control" }, `${label}: `, output);
  return el("div", { class: "control" }, el("label", { for: id }, label), input, output);
}

export function choice(name: string, label: string, options: [string, string][], choose: (value: string) => void): HTMLElement {
  const group = uniqueId("choice");
  const box = el("fieldset", { class: "control choice" }, el("legend", {}, label));
  const kept = setting(name, options[0]?.[0] ?? "");
  const first = options.some(([value]) => value === kept) ? kept : (options[0]?.[0] ?? "");
  for (const [value, text] of options) {
    const input = el("input", { type: "radio", name: group, value, onchange: () => (keep(name, value), choose(value)) });
    input.checked = value === first;
    box.append(el("label", {}, input, el("span", {}, text)));
  }
  choose(first);
  return box;
}

export function copyButton(text: string): HTMLElement {
  const button = el("button", { type: "button", class: "copy" }, "Copy");
  const done = (word: string) => {
    button.textContent = word;
    setTimeout(() => (button.textContent = "Copy"), 1500);
  };
  // Pages opened from disk may not be trusted with the clipboard: then the text is selected, ready for Ctrl+C.
  button.addEventListener("click", () => {
    const select = () => {
      const code = button.parentElement?.querySelector("code");
      if (code) getSelection()?.selectAllChildren(code);
      done("Selected");
    };
    if (!navigator.clipboard) select();
    else navigator.clipboard.writeText(text).then(() => done("Copied"), select);
  });
  return button;
}

export function command(text: string): HTMLElement {
  return el("div", { class: "command" }, el("code", { tabindex: 0 }, text), copyButton(text));
}
