// SPDX-License-Identifier: BSD-3-Clause
// Paper and ink of the page around the view, read from its style sheet.
import { rgb, type Rgb } from "./palettes.ts";

export interface Theme {
  paper: Rgb;
  ink: Rgb;
}

/** For exported pictures: a thesis is printed on white, whatever the screen shows. */
export const WHITE_PAPER: Theme = { paper: rgb("#ffffff"), ink: rgb("#1b1e23") };

/** A colour in any notation of CSS as numbers: a canvas knows them all. */
function resolve(colour: string): Rgb {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return rgb("#ffffff");
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  return [r!, g!, b!];
}

/** `stage` has the colours that view.css gives it: background paper, text ink. */
export function themeOf(stage: HTMLElement): Theme {
  const style = getComputedStyle(stage);
  return { paper: resolve(style.backgroundColor), ink: resolve(style.color) };
}

/** Calls back when the page may have changed from light to dark or back. */
export function watchTheme(changed: () => void): () => void {
  const query = matchMedia("(prefers-color-scheme: dark)");
  query.addEventListener("change", changed);
  const observer = new MutationObserver(changed);
  for (const element of [document.documentElement, document.body]) {
    observer.observe(element, { attributes: true, attributeFilter: ["class", "style", "data-theme"] });
  }
  return () => {
    query.removeEventListener("change", changed);
    observer.disconnect();
  };
}
