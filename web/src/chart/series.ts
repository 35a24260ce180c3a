// SPDX-License-Identifier: BSD-3-Clause
// Series of a chart with two axes and how they are drawn: lines with gaps, symbols, bands, marks.
import { area as areaPath, line as linePath } from "d3-shape";
import { svg } from "../dom.ts";
import type { Column } from "../tables.ts";
import type { PlotArea } from "./plot_area.ts";
import { colourClass, dashOf, type Look, symbolPath } from "./style.ts";

export interface Series extends Look {
  name: string;
  x: Column;
  y: Column;
  draw: "line" | "points" | "both";
  low?: Column;
  high?: Column;
  /** What switches it, when several series belong together; its name otherwise. */
  key?: string;
  /** In the background, without legend. */
  quiet?: boolean;
  /** Stands in the legend with the series of the same key. */
  unlisted?: boolean;
  /** In the legend, where it stands for several. */
  sample?: "line" | "points" | "both";
  /** Columns of the data, as shear.displacement_mm, and the test that they belong to; or what names the place of each row. */
  sourceX?: string | ((row: number) => string);
  sourceY?: string | ((row: number) => string);
  test?: string;
  /** One test for each point. */
  pointTests?: string[];
}

export interface Mark {
  along: "x" | "y";
  at: number;
  text: string;
}

export type Point = [number, number];

export function span(values: Iterable<number | null>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value === null) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** Points in pixels, null where the line has a gap; points that the eye cannot part from the one before are left out. */
function pixels(series: Series, area: PlotArea): (Point | null)[] {
  const points: (Point | null)[] = [];
  let last: Point | null = null;
  series.x.forEach((x, row) => {
    const y = series.y[row] ?? null;
    if (x === null || y === null) {
      if (last) points.push(null);
      last = null;
      return;
    }
    const here: Point = [Math.round(area.x(x) * 10) / 10, Math.round(area.y(y) * 10) / 10];
    if (last && Math.abs(here[0] - last[0]) < 0.3 && Math.abs(here[1] - last[1]) < 0.3) return;
    points.push(here);
    last = here;
  });
  return points;
}

function drawBand(series: Series, area: PlotArea): SVGElement | null {
  const { low, high } = series;
  if (!low || !high) return null;
  const rows = series.x.map((x, row) => [x, low[row] ?? null, high[row] ?? null] as const);
  const path = areaPath<(typeof rows)[number]>()
    .defined(([x, from, to]) => x !== null && from !== null && to !== null)
    .x(([x]) => Math.round(area.x(x ?? 0) * 10) / 10)
    .y0(([, from]) => Math.round(area.y(from ?? 0) * 10) / 10)
    .y1(([, , to]) => Math.round(area.y(to ?? 0) * 10) / 10)(rows);
  return svg("path", { class: "band", d: path ?? "" });
}

export function drawSeries(series: Series, area: PlotArea, clip: string): SVGElement {
  const points = pixels(series, area);
  const group = svg("g", { class: `series ${colourClass(series.colour)}${series.quiet ? " quiet" : ""}`, "clip-path": `url(#${clip})` });
  const band = drawBand(series, area);
  if (band) group.append(band);
  if (series.draw !== "points") {
    const path = linePath<Point | null>().defined((point) => point !== null).x((point) => point?.[0] ?? 0).y((point) => point?.[1] ?? 0);
    group.append(svg("path", { class: "line", d: path(points) ?? "", "stroke-dasharray": dashOf(series.dash) }));
  }
  if (series.draw !== "line") {
    const shape = symbolPath(series.symbol);
    for (const point of points) if (point) group.append(svg("path", { class: "symbol", d: shape, transform: `translate(${point.join(" ")})` }));
  }
  return group;
}

export function drawMarks(marks: Mark[], area: PlotArea): SVGElement[] {
  return marks.flatMap(({ along, at, text }) => {
    const [from, to] = (along === "x" ? area.x : area.y).domain() as [number, number];
    if (at < Math.min(from, to) || at > Math.max(from, to)) return [];
    if (along === "y") {
      const y = area.y(at);
      return [
        svg("line", { class: "mark", x1: area.left, x2: area.right, y1: y, y2: y }),
        svg("text", { class: "mark-text", x: area.right, y: y - 5, "text-anchor": "end" }, text),
      ];
    }
    const x = area.x(at);
    const right = x > (area.left + area.right) / 2;
    return [
      svg("line", { class: "mark", x1: x, x2: x, y1: area.top, y2: area.bottom }),
      svg("text", { class: "mark-text", x: x + (right ? -5 : 5), y: area.top + 10, "text-anchor": right ? "end" : "start" }, text),
    ];
  });
}
