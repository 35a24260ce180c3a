// SPDX-License-Identifier: BSD-3-Clause
// Scales, grid, axes and their labels of a chart with two axes.
import { scaleLinear, scaleLog, type ScaleContinuousNumeric } from "d3-scale";
import { svg } from "../dom.ts";
import { formatNumber, powerOfTen } from "../numbers.ts";

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
  const [from = 1, to = 10] = scale.domain();
  const decades = Math.log10(to / from);
  // Whole decades where there are many; else 1, 2, 5 and their multiples; within one decade every digit.
  const shown = decades > 3 ? /^1e/ : decades > 1 ? /^[125]e/ : /^\de/;
  return scale.ticks(20).filter((tick) => shown.test(Number(tick.toPrecision(6)).toExponential()));
}

/** Ticks of one linear axis have the same decimals; those of a log axis are powers where they are small. */
function tickText(axis: Axis, scale: Scale, count: number): (tick: number) => string {
  if (axis.tickText) return axis.tickText;
  if (axis.log) {
    const exponent = (tick: number) => Math.round(Math.log10(tick));
    return (tick) => (tick < 0.005 && tick === Number(`1e${exponent(tick)}`) ? powerOfTen(exponent(tick)) : formatNumber(Number(tick.toPrecision(6)), 1));
  }
  if (axis.ticks) return (tick) => formatNumber(tick);
  const text = scale.tickFormat(count);
  return (tick) => text(tick).replace(/,/g, "\u202f");
}

/** `span`: [lowest, highest] of the data in x and y. */
export function plotArea(width: number, height: number, x: Axis, y: Axis, spanX: [number, number], spanY: [number, number]): PlotArea {
  const top = 26;
  const bottom = height - 40;
  const ticksY = Math.max(3, Math.round((bottom - top) / 48));
  const scaleY = scaleOf(y, spanY[0], spanY[1], [bottom, top], ticksY);
  const textY = tickText(y, scaleY, ticksY);
  const longest = Math.max(...ticksOf(y, scaleY, ticksY).map((tick) => textY(tick).length), 1);
  const left = 14 + 7.2 * longest;
  const right = width - 14;
  const scaleX = scaleOf(x, spanX[0], spanX[1], [left, right], Math.max(3, Math.round((right - left) / 80)));
  return { width, height, left, right, top, bottom, x: scaleX, y: scaleY };
}

export function drawAxes(area: PlotArea, x: Axis, y: Axis): SVGElement[] {
  const { left, right, top, bottom } = area;
  const [countX, countY] = [Math.max(3, Math.round((right - left) / 80)), Math.max(3, Math.round((bottom - top) / 48))];
  const [ticksX, ticksY] = [ticksOf(x, area.x, countX), ticksOf(y, area.y, countY)];
  const [textX, textY] = [tickText(x, area.x, countX), tickText(y, area.y, countY)];
  const parts: SVGElement[] = [];
  const inside = (value: number, from: number, to: number) => value >= from - 0.5 && value <= to + 0.5;
  for (const tick of ticksY) {
    const at = area.y(tick);
    if (!inside(at, top, bottom)) continue;
    parts.push(svg("line", { class: tick === 0 ? "grid zero" : "grid", x1: left, x2: right, y1: at, y2: at }));
    parts.push(svg("text", { class: "tick", x: left - 7, y: at + 4, "text-anchor": "end" }, textY(tick)));
  }
  let free = -Infinity;
  for (const tick of ticksX) {
    const at = area.x(tick);
    if (!inside(at, left, right)) continue;
    parts.push(svg("line", { class: "axis", x1: at, x2: at, y1: bottom, y2: bottom + 5 }));
    const text = textX(tick);
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
