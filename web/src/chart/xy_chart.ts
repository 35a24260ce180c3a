// SPDX-License-Identifier: BSD-3-Clause
// Chart with two axes: lines, points and bands, with a cursor that the pointer or the arrow keys move.
import { append, type Child, el, svg } from "../dom.ts";
import { formatNumber, withUnit } from "../numbers.ts";
import { type Cell, type DataTable, figure } from "./figure.ts";
import { ChartGroup } from "./group.ts";
import { legend } from "./legend.ts";
import { type Axis, axisText, drawAxes, plotArea, type PlotArea } from "./plot_area.ts";
import { drawMarks, drawSeries, type Mark, type Point, type Series, span } from "./series.ts";
import { colourClass } from "./style.ts";

export type { Mark, Series } from "./series.ts";

export interface XyChart {
  title: string;
  x: Axis;
  y: Axis;
  series: Series[];
  marks?: Mark[];
  caption?: Child[];
  height?: number;
  group?: ChartGroup;
  /** "x": the cursor reads all series at one x; "nearest": the nearest point. */
  cursor?: "x" | "nearest";
  legend?: boolean;
  wide?: boolean;
  /** Draws more into the plot, under the series. */
  decorate?: (area: PlotArea) => SVGElement[];
}

/** Series on the same rows side by side, else one block below the other. */
export function xyTable(spec: Pick<XyChart, "x" | "y" | "series">): DataTable {
  const series = spec.series;
  const cell = (one: Series, axis: "x" | "y", row: number): Cell => {
    const value = one[axis][row] ?? null;
    const source = axis === "x" ? one.sourceX : one.sourceY;
    if (!source || value === null) return { value };
    return { value, source: typeof source === "string" ? `${source}[${row}]` : source(row), test: one.pointTests?.[row] ?? one.test };
  };
  const first = series[0];
  if (first && series.every((one) => one.x === first.x)) {
    return {
      columns: [axisText(spec.x), ...series.map((one) => (series.length > 1 ? one.name : axisText(spec.y)))],
      rows: first.x.map((_, row) => [cell(first, "x", row), ...series.map((one) => cell(one, "y", row))]),
    };
  }
  const rows = series.flatMap((one) =>
    one.x.map((_, row) => [{ value: one.name }, cell(one, "x", row), cell(one, "y", row)]));
  return { columns: ["Series", axisText(spec.x), axisText(spec.y)], rows };
}

interface Hit {
  series: Series;
  row: number;
}

class Plot {
  readonly element = el("div", { class: "plot-box" });
  readonly picture = svg("svg", { class: "plot", role: "img" });
  private readonly cursor = svg("g", { class: "cursor" });
  private area: PlotArea | null = null;
  private width = 0;

  constructor(private readonly spec: XyChart, private readonly group: ChartGroup, private readonly clip: string) {
    this.element.append(this.picture);
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  private fit(): void {
    const width = Math.round(this.element.clientWidth);
    if (width > 0 && width !== this.width && !matchMedia("print").matches) {
      this.width = width;
      this.draw();
    }
  }

  visible(): Series[] {
    return this.spec.series.filter((series) => series.quiet || this.group.shows(series.key ?? series.name));
  }

  draw(): void {
    const { spec, width } = this;
    if (width === 0) return;
    const height = spec.height ?? Math.round(Math.min(300, Math.max(220, width * 0.62)));
    const all = spec.series;
    const spanX = span(all.flatMap((one) => one.x));
    // Scales belong to all series, so that a switch does not move what stays.
    const spanY = span(all.flatMap((one) => [...one.y, ...(one.low ?? []), ...(one.high ?? [])]));
    const area = plotArea(width, height, spec.x, spec.y, spanX, spanY);
    this.area = area;
    this.picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const window = svg("clipPath", { id: this.clip },
      svg("rect", { x: area.left - 6, y: area.top - 6, width: area.right - area.left + 12, height: area.bottom - area.top + 8 }));
    this.cursor.replaceChildren();
    this.picture.replaceChildren(window, ...drawAxes(area, spec.x, spec.y), ...(spec.decorate?.(area) ?? []),
      ...drawMarks(spec.marks ?? [], area), ...this.visible().map((one) => drawSeries(one, area, this.clip)), this.cursor);
  }

  /** Place under the pointer in the units of the axes. */
  at(event: PointerEvent): Point | null {
    if (!this.area) return null;
    const box = this.picture.getBoundingClientRect();
    const scale = this.area.width / box.width;
    return [this.area.x.invert((event.clientX - box.left) * scale), this.area.y.invert((event.clientY - box.top) * scale)];
  }

  nearest(x: number, y: number): Hit | null {
    const area = this.area;
    if (!area) return null;
    let best: Hit | null = null;
    let distance = 60;
    for (const series of this.visible()) {
      series.x.forEach((here, row) => {
        const there = series.y[row] ?? null;
        if (here === null || there === null) return;
        const away = Math.hypot(area.x(here) - area.x(x), area.y(there) - area.y(y));
        if (away < distance) {
          distance = away;
          best = { series, row };
        }
      });
    }
    return best;
  }

  showCursor(hits: Hit[], x: number | null): void {
    const area = this.area;
    this.cursor.replaceChildren();
    if (!area) return;
    if (x !== null) this.cursor.append(svg("line", { x1: area.x(x), x2: area.x(x), y1: area.top, y2: area.bottom }));
    for (const { series, row } of hits) {
      const [here, there] = [series.x[row] ?? null, series.y[row] ?? null];
      if (here === null || there === null) continue;
      this.cursor.append(svg("circle", { class: colourClass(series.colour), cx: area.x(here), cy: area.y(there), r: 4 }));
    }
  }
}

/** Row nearest to x, if x lies within the rows. */
function rowAt(series: Series, x: number): number {
  let best = -1;
  let distance = Infinity;
  series.x.forEach((value, row) => {
    if (value === null || (series.y[row] ?? null) === null) return;
    const away = Math.abs(value - x);
    if (away < distance) [best, distance] = [row, away];
  });
  return best;
}

function valueText(spec: XyChart, series: Series, row: number): string {
  return withUnit(formatNumber(series.y[row] ?? null), spec.y.unit ?? "");
}

function positionText(spec: XyChart, x: number): string {
  return `${spec.x.label} ${withUnit(formatNumber(x), spec.x.unit ?? "")}`;
}

let charts = 0;

export function xyChart(spec: XyChart): HTMLElement {
  charts += 1;
  const group = spec.group ?? new ChartGroup();
  const plot = new Plot(spec, group, `clip-${charts}`);
  const listed = spec.series.filter((series) => !series.quiet && !series.unlisted);
  const entries = listed.map((series) => ({ ...series, key: series.key ?? series.name, draw: series.sample ?? series.draw }));
  const names = spec.legend === false ? null : legend(entries, group, spec.title);
  const readout = el("p", { class: "readout", "aria-live": "polite" });

  const read = (x: number | null) => {
    if (x === null) {
      plot.showCursor([], null);
      names?.setValues(null);
      readout.textContent = "";
      return;
    }
    const hits = plot.visible().filter((one) => !one.quiet).map((series) => ({ series, row: rowAt(series, x) })).filter((hit) => hit.row >= 0);
    plot.showCursor(hits, x);
    names?.setValues(listed.map((series) => {
      const hit = hits.find((one) => one.series === series);
      return hit ? valueText(spec, series, hit.row) : null;
    }));
    readout.textContent = positionText(spec, x);
  };
  const readNearest = (hit: Hit | null) => {
    plot.showCursor(hit ? [hit] : [], null);
    const x = hit ? (hit.series.x[hit.row] ?? null) : null;
    readout.textContent = hit && x !== null ? `${hit.series.name}: ${positionText(spec, x)}, ${valueText(spec, hit.series, hit.row)}` : "";
  };
  followPointer(spec, plot, group, readNearest);
  group.listen(() => plot.draw(), spec.cursor === "nearest" ? undefined : read);

  const element = figure({ title: spec.title, picture: plot.element, legend: names?.element, caption: spec.caption, table: () => xyTable(spec), wide: spec.wide });
  const caption = element.querySelector("figcaption");
  plot.picture.setAttribute("aria-label", `${spec.title}: ${axisText(spec.y)} against ${axisText(spec.x)}. ${caption?.textContent ?? ""}`.trim());
  append(plot.element, [readout]);
  return element;
}

/** Pointer and arrow keys move the cursor; the charts of a group that share x move theirs with it. */
function followPointer(spec: XyChart, plot: Plot, group: ChartGroup, readNearest: (hit: Hit | null) => void): void {
  const box = plot.element;
  box.tabIndex = 0;
  box.setAttribute("role", "group");
  box.setAttribute("aria-label", `${spec.title}, arrow keys read the values`);
  const nearest = spec.cursor === "nearest";
  let row = -1;
  const leave = () => (nearest ? readNearest(null) : group.moveCursor(null));
  box.addEventListener("pointermove", (event) => {
    const place = plot.at(event);
    if (!place) return;
    if (nearest) readNearest(plot.nearest(...place));
    else {
      const [low = 0, high = 0] = spec.series[0] ? span(spec.series.flatMap((one) => one.x)) : [];
      group.moveCursor(Math.min(high, Math.max(low, place[0])));
    }
  });
  box.addEventListener("pointerleave", leave);
  box.addEventListener("blur", leave);
  box.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const series = plot.visible().find((one) => !one.quiet);
    if (!step || !series) return;
    event.preventDefault();
    const stride = Math.max(1, Math.round(series.x.length / 100));
    row = Math.min(series.x.length - 1, Math.max(0, row + step * stride));
    const x = series.x[row] ?? null;
    if (nearest) readNearest({ series, row });
    else if (x !== null) group.moveCursor(x);
  });
}
