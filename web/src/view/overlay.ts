// SPDX-License-Identifier: BSD-3-Clause
// What lies over the picture, on the screen and in exported pictures alike: caption, legends, scale bar and directions of the axes.
import type * as THREE from "three";
import { formatNumber } from "../numbers.ts";
import { css, scaleColour, type Range, type Rgb, type Scale } from "./palettes.ts";

export interface ColourBar {
  title: string;
  unit: string;
  scale: Scale;
  range: Range;
}

export interface Swatches {
  title: string;
  items: { text: string; colour: Rgb }[];
}

export interface Overlay {
  caption: string;
  legends: (ColourBar | Swatches)[];
  /** Pixels of the page for one mm. */
  pixelsPerMillimetre: number;
  camera: THREE.OrthographicCamera;
  ink: string;
  paper: string;
}

const FONT = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif";
const MARGIN = 14, LINE = 18;

/** Text with a rim of the paper's colour, readable on whatever lies under it. */
function text(context: CanvasRenderingContext2D, words: string, x: number, y: number, overlay: Overlay): void {
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = overlay.paper;
  context.strokeText(words, x, y);
  context.fillStyle = overlay.ink;
  context.fillText(words, x, y);
}

function colourBar(context: CanvasRenderingContext2D, bar: ColourBar, right: number, bottom: number, overlay: Overlay): number {
  const width = 160, height = 11, left = right - width, top = bottom - LINE - height;
  for (let x = 0; x < width; ++x) {
    context.fillStyle = css(scaleColour(bar.scale, (x + 0.5) / width));
    context.fillRect(left + x, top, 1.5, height);
  }
  context.strokeStyle = overlay.ink;
  context.lineWidth = 0.75;
  context.strokeRect(left, top, width, height);
  const { low, high, below, above } = bar.range;
  const lowest = (below ? "≤ " : "") + formatNumber(low, 3), highest = (above ? "≥ " : "") + formatNumber(high, 3);
  const middle = formatNumber((low + high) / 2, 3);
  context.textAlign = "left";
  text(context, lowest, left, bottom - 3, overlay);
  const room = width - context.measureText(middle).width - 2 * Math.max(context.measureText(lowest).width, context.measureText(highest).width);
  context.textAlign = "center";
  if (room > 12) text(context, middle, left + width / 2, bottom - 3, overlay);
  context.textAlign = "right";
  text(context, highest, right, bottom - 3, overlay);
  text(context, `${bar.title}, ${bar.unit}`, right, top - 7, overlay);
  return top - 7 - LINE;
}

function swatches(context: CanvasRenderingContext2D, legend: Swatches, right: number, bottom: number, overlay: Overlay): number {
  context.textAlign = "left";
  const widest = Math.max(...legend.items.map((item) => context.measureText(item.text).width));
  const left = right - widest - 20;
  let y = bottom - 3;
  for (const item of [...legend.items].reverse()) {
    context.fillStyle = css(item.colour);
    context.strokeStyle = overlay.ink;
    context.lineWidth = 0.75;
    context.beginPath();
    context.arc(left + 6, y - 4, 5.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    text(context, item.text, left + 20, y, overlay);
    y -= LINE;
  }
  context.textAlign = "right";
  text(context, legend.title, right, y, overlay);
  return y - LINE;
}

/** A round length that takes up to about a fifth of the width. */
export function scaleBarLength(pixelsPerMillimetre: number, width: number): number {
  const most = Math.min(130, 0.22 * width) / pixelsPerMillimetre;
  const ten = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].map((k) => k * ten).find((length) => length <= most) ?? ten;
}

function scaleBar(context: CanvasRenderingContext2D, left: number, bottom: number, width: number, overlay: Overlay): void {
  const length = scaleBarLength(overlay.pixelsPerMillimetre, width), size = length * overlay.pixelsPerMillimetre;
  const path = () => {
    context.beginPath();
    context.moveTo(left, bottom - 5);
    context.lineTo(left, bottom);
    context.lineTo(left + size, bottom);
    context.lineTo(left + size, bottom - 5);
    context.stroke();
  };
  for (const [style, thick] of [[overlay.paper, 4], [overlay.ink, 1.5]] as const) {
    context.strokeStyle = style;
    context.lineWidth = thick;
    path();
  }
  context.textAlign = "center";
  text(context, `${formatNumber(length)} mm`, left + size / 2, bottom - 8, overlay);
}

function axes(context: CanvasRenderingContext2D, x: number, y: number, overlay: Overlay): void {
  const view = overlay.camera.matrixWorldInverse.elements;
  // The far end of the box first, so that nearer arrows lie over it.
  const order = [0, 1, 2].sort((a, b) => view[4 * a + 2]! - view[4 * b + 2]!);
  for (const axis of order) {
    const dx = view[4 * axis]! * 30, dy = -view[4 * axis + 1]! * 30, size = Math.hypot(dx, dy);
    if (size < 4) continue;
    for (const [style, thick] of [[overlay.paper, 4.5], [overlay.ink, 1.5]] as const) {
      context.strokeStyle = style;
      context.fillStyle = style;
      context.lineWidth = thick;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + dx, y + dy);
      context.stroke();
      const ux = dx / size, uy = dy / size;
      context.beginPath();
      context.moveTo(x + dx + 5 * ux, y + dy + 5 * uy);
      context.lineTo(x + dx - 3 * uy, y + dy + 3 * ux);
      context.lineTo(x + dx + 3 * uy, y + dy - 3 * ux);
      context.fill();
    }
    context.textAlign = "center";
    text(context, "xyz"[axis]!, x + dx + 12 * (dx / size), y + dy + 12 * (dy / size) + 4, overlay);
  }
}

/** `width` and `height` are those of the picture in pixels of the page, whatever the resolution of the canvas. */
export function drawOverlay(context: CanvasRenderingContext2D, width: number, height: number, overlay: Overlay): void {
  context.font = `13px ${FONT}`;
  let bottom = height - MARGIN;
  for (const legend of overlay.legends) {
    bottom = "scale" in legend
      ? colourBar(context, legend, width - MARGIN, bottom, overlay)
      : swatches(context, legend, width - MARGIN, bottom, overlay);
  }
  axes(context, MARGIN + 38, height - MARGIN - 66, overlay);
  scaleBar(context, MARGIN, height - MARGIN, width, overlay);
  context.textAlign = "left";
  context.font = `600 14px ${FONT}`;
  text(context, overlay.caption, MARGIN, MARGIN + 10, overlay);
}
