// SPDX-License-Identifier: BSD-3-Clause
// Colours, dashes and symbols of series. The colours are those of Okabe and Ito, which colour-blind readers tell apart, shaded in
// page.css for light and dark; a series also differs in dash or symbol, so that it survives a copier.
import { symbol, symbolCircle, symbolCross, symbolDiamond, symbolSquare, symbolTriangle, symbolWye } from "d3-shape";
import { svg } from "../dom.ts";

export const COLOURS = 8;
const DASHES = ["", "7 3", "2 2.5", "9 3 2 3", "14 4", "5 2 1 2 1 2"];
const SYMBOLS = [symbolCircle, symbolSquare, symbolTriangle, symbolDiamond, symbolCross, symbolWye];

export interface Look {
  /** Index into the palette; counts on past its end. */
  colour: number;
  dash?: number;
  symbol?: number;
}

export function colourClass(colour: number): string {
  return `c${colour % COLOURS}`;
}

export function dashOf(dash: number | undefined): string | null {
  return DASHES[(dash ?? 0) % DASHES.length] || null;
}

export function symbolPath(index: number | undefined, area = 44): string {
  return symbol(SYMBOLS[(index ?? 0) % SYMBOLS.length], area)() ?? "";
}

export function swatch(look: Look, draw: "line" | "points" | "both"): SVGElement {
  const sample = svg("svg", { class: `swatch ${colourClass(look.colour)}`, width: 30, height: 12, viewBox: "0 0 30 12", "aria-hidden": "true" });
  if (draw !== "points") {
    sample.append(svg("line", { class: "line", x1: 0, x2: 30, y1: 6, y2: 6, "stroke-dasharray": dashOf(look.dash) }));
  }
  if (draw !== "line") sample.append(svg("path", { class: "symbol", d: symbolPath(look.symbol), transform: "translate(15 6)" }));
  return sample;
}
