// SPDX-License-Identifier: BSD-3-Clause
// One polar histogram: bins as sectors, fitted curve, and the region of its 95 % bands. 0 degrees is the shear direction, 90 is up.
import { scaleLinear } from "d3-scale";
import { arc, areaRadial, curveCatmullRomClosed, curveLinearClosed, lineRadial } from "d3-shape";
import { svg } from "../dom.ts";
import { formatNumber } from "../numbers.ts";
import { type Band, bandAt } from "./polar_band.ts";
import { colourClass } from "./style.ts";

export interface PolarPanel {
  title: string;
  angle_deg: number[];
  values: (number | null)[];
  fit: (number | null)[];
  band: Band | null;
  /** Value at the outer ring; the same in panels that are compared. */
  limit: number;
  /** Values of both signs: zero is the middle ring, outwards is positive. */
  signed?: boolean;
  colour?: number;
  /** Key numbers, for those who do not see the picture. */
  description: string;
}

const WIDTH = 284;
const HEIGHT = 262;
const CENTRE = [142, 138] as const;
const RADIUS = 98;

/** d3 counts from up, clockwise. */
function clockwise(angle_deg: number): number {
  return Math.PI / 2 - (angle_deg * Math.PI) / 180;
}

function rings(scale: (value: number) => number, limit: number, signed: boolean): SVGElement[] {
  const parts: SVGElement[] = [];
  const ticks = scaleLinear([signed ? -limit : 0, limit], [0, 1]).ticks(signed ? 4 : 3).filter((tick) => Math.abs(tick) <= limit);
  for (const tick of ticks) {
    if (scale(tick) <= 2) continue;
    parts.push(svg("circle", { class: signed && tick === 0 ? "grid zero" : "grid", r: scale(tick), fill: "none" }));
  }
  for (let angle = 0; angle < 180; angle += 30) {
    const [x, y] = [Math.cos((angle * Math.PI) / 180) * RADIUS, Math.sin((angle * Math.PI) / 180) * RADIUS];
    parts.push(svg("line", { class: angle % 90 ? "grid" : "grid zero", x1: -x, y1: y, x2: x, y2: -y }));
  }
  return parts;
}

function labels(scale: (value: number) => number, limit: number, signed: boolean): SVGElement[] {
  const parts: SVGElement[] = [];
  const ticks = scaleLinear([signed ? -limit : 0, limit], [0, 1]).ticks(signed ? 4 : 3);
  const [x, y] = [Math.cos((-52 * Math.PI) / 180), Math.sin((-52 * Math.PI) / 180)];
  let free = 16;
  for (const tick of ticks) {
    const at = scale(tick);
    if (at < free || Math.abs(tick) > limit) continue;
    free = at + 20;
    parts.push(svg("text", { class: "tick ring", x: x * at, y: -y * at + 4, "text-anchor": "middle" }, formatNumber(Number(tick.toPrecision(8)))));
  }
  for (const [text, dx, dy, anchor] of [["0°", RADIUS + 5, 4, "start"], ["90°", 0, -RADIUS - 6, "middle"], ["180°", -RADIUS - 5, 4, "end"], ["270°", 0, RADIUS + 15, "middle"]] as const) {
    parts.push(svg("text", { class: "tick", x: dx, y: dy, "text-anchor": anchor }, text));
  }
  return parts;
}

function bins(panel: PolarPanel, scale: (value: number) => number): SVGElement[] {
  const width = panel.angle_deg.length > 1 ? Math.abs((panel.angle_deg[1] ?? 0) - (panel.angle_deg[0] ?? 0)) : 10;
  const sector = arc<[number, number, number]>()
    .innerRadius(([, low]) => low)
    .outerRadius(([, , high]) => high)
    .startAngle(([angle]) => clockwise(angle + width / 2))
    .endAngle(([angle]) => clockwise(angle - width / 2));
  return panel.angle_deg.flatMap((angle, row) => {
    const value = panel.values[row] ?? null;
    if (value === null) return [];
    const ends = [scale(0), Math.max(0, scale(value))].sort((one, other) => one - other) as [number, number];
    return [svg("path", { class: panel.signed && value < 0 ? "bin negative" : "bin", d: sector([angle, ...ends]) ?? "" })];
  });
}

function curve(panel: PolarPanel, scale: (value: number) => number): SVGElement[] {
  const parts: SVGElement[] = [];
  const { band } = panel;
  if (band) {
    const angles = Array.from({ length: 121 }, (_, step) => step * 3);
    const region = areaRadial<number>().curve(curveLinearClosed).angle(clockwise)
      .innerRadius((angle) => Math.max(0, scale(bandAt(band, angle)[0])))
      .outerRadius((angle) => Math.max(0, scale(bandAt(band, angle)[1])));
    parts.push(svg("path", { class: "band", d: region(angles) ?? "", "fill-rule": "evenodd" }));
  }
  const fitted = panel.angle_deg.map((angle, row) => [angle, panel.fit[row] ?? null] as const).filter(([, value]) => value !== null);
  if (fitted.length > 2) {
    const path = lineRadial<(typeof fitted)[number]>().curve(curveCatmullRomClosed)
      .angle(([angle]) => clockwise(angle)).radius(([, value]) => Math.max(0, scale(value ?? 0)));
    parts.push(svg("path", { class: "line", d: path(fitted) ?? "" }));
  }
  return parts;
}

export function polarPanel(panel: PolarPanel): SVGSVGElement {
  const limit = panel.limit > 0 ? panel.limit : 1;
  const signed = panel.signed ?? false;
  const scale = scaleLinear([signed ? -limit : 0, limit], [0, RADIUS]);
  const picture = svg("svg", { class: "plot polar", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": panel.description });
  picture.append(
    svg("text", { class: "panel-title", x: WIDTH / 2, y: 13, "text-anchor": "middle" }, panel.title),
    svg("g", { class: `series ${colourClass(panel.colour ?? 0)}`, transform: `translate(${CENTRE.join(" ")})` },
      ...rings(scale, limit, signed), ...bins(panel, scale), ...curve(panel, scale), ...labels(scale, limit, signed)),
  );
  return picture;
}
