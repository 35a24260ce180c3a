// SPDX-License-Identifier: BSD-3-Clause
// Scales, grid, axes and their labels of a chart with two axes.
import { scaleLinear, scaleLog, type ScaleContinuousNumeric } from "d3-scale";
import { svg } from "../dom.ts";
import { formatNumber } from "../numbers.ts";

export interface Axis {
  label: string;
  unit?: string;
  log?: boolean;
  /** Ends of the axis; the data's own without them. */
  low?: number;
  high?: number;
  /** Ends as they are, not at the next tick. */
  exact?: boolean;
  ticks?: number[];
  tickText?: (value: number) => string;
}

export type Scale = ScaleContinuousNumeric<number, number>;

export interface PlotArea {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
  x: Scale;
  y: Scale;
}

export function axisText(axis: Axis): string {
  return axis.unit ? `${axis.label} (${axis.unit})` : axis.label;
}

function scaleOf(axis: Axis, low: number, high: number, range: [number, number], ticks: number): Scale {
  let from = axis.low ?? low;
  let to = axis.high ?? high;
  if (!(to > from)) {
    const spread = Math.abs(from) > 0 ? Math.abs(from) * 0.05 : 1;
    from -= axis.low === undefined ? spread : 0;
    to = from + 2 * spread;
  }
  const scale: Scale = axis.log ? scaleLog([from, to], range) : scaleLinear([from, to], range);
  return axis.exact ? scale : scale.nice(ticks);
}

function ticksOf(axis: Axis, scale: Scale, count: number): number[] {
  if (axis.ticks) return axis.ticks;
  if (!axis.log) return scale.ticks(count);
  // A log axis of less than two decades has no round powers: 1, 2, 5 and their multiples.
  return scale.ticks(20).filter((tick) => /^[125]/.test(tick.toExponential()));
}

function tickText(axis: Axis, tick: number): string {
  return axis.tickText ? axis.tickText(tick) : formatNumber(Number(tick.toPrecision(10)), 6);
}

/** `span`: [lowest, highest] of the data in x and y. */
export function plotArea(width: number, height: number, x: Axis, y: Axis, spanX: [number, number], spanY: [number, number]): PlotArea {
  const top = 26;
  const bottom = height - 40;
  const ticksY = Math.max(3, Math.round((bottom - top) / 48));
  const scaleY = scaleOf(y, spanY[0], spanY[1], [bottom, top], ticksY);
  const longest = Math.max(...ticksOf(y, scaleY, ticksY).map((tick) => tickText(y, tick).length), 1);
  const left = 14 + 7.2 * longest;
  const right = width - 14;
  const scaleX = scaleOf(x, spanX[0], spanX[1], [left, right], Math.max(3, Math.round((right - left) / 80)));
  return { width, height, left, right, top, bottom, x: scaleX, y: scaleY };
}

export function drawAxes(area: PlotArea, x: Axis, y: Axis): SVGElement[] {
  const { left, right, top, bottom } = area;
  const ticksX = ticksOf(x, area.x, Math.max(3, Math.round((right - left) / 80)));
  const ticksY = ticksOf(y, area.y, Math.max(3, Math.round((bottom - top) / 48)));
  const parts: SVGElement[] = [];
  const inside = (value: number, from: number, to: number) => value >= from - 0.5 && value <= to + 0.5;
  for (const tick of ticksY) {
    const at = area.y(tick);
    if (!inside(at, top, bottom)) continue;
    parts.push(svg("line", { class: tick === 0 ? "grid zero" : "grid", x1: left, x2: right, y1: at, y2: at }));
    parts.push(svg("text", { class: "tick", x: left - 7, y: at + 4, "text-anchor": "end" }, tickText(y, tick)));
  }
  let free = -Infinity;
  for (const tick of ticksX) {
    const at = area.x(tick);
    if (!inside(at, left, right)) continue;
    parts.push(svg("line", { class: "axis", x1: at, x2: at, y1: bottom, y2: bottom + 5 }));
    const text = tickText(x, tick);
    const half = text.length * 3.6;
    if (at - half < free) continue;
    free = at + half + 4;
    parts.push(svg("text", { class: "tick", x: at, y: bottom + 18, "text-anchor": "middle" }, text));
  }
  parts.push(svg("line", { class: "axis", x1: left, x2: right, y1: bottom, y2: bottom }));
  parts.push(svg("text", { class: "axis-label", x: 0, y: 12 }, axisText(y)));
  parts.push(svg("text", { class: "axis-label", x: right, y: bottom + 35, "text-anchor": "end" }, axisText(x)));
  return parts;
}
