// SPDX-License-Identifier: BSD-3-Clause
// Mohr-Coulomb envelopes of the mixtures with their points and the bounds of the friction angle.
import type { Campaign, Envelope } from "../data.ts";
import { el } from "../dom.ts";
import { type Series, xyChart } from "../chart/xy_chart.ts";
import { ChartGroup } from "../chart/group.ts";
import { formatNumber, withUnit } from "../numbers.ts";
import { charts } from "../sections/part.ts";
import { numberSpan } from "../value.ts";
import { mixtureName, sameValues, type Values } from "./members.ts";

const tangent = (degrees: number) => Math.tan((degrees * Math.PI) / 180);

/** Lines of the smallest and largest slope turn about the middle of the points, which every fitted line goes through. */
function boundsAt(envelope: Envelope, sigma: number[]): Pick<Series, "low" | "high"> {
  const { friction_angle_low_deg: low, friction_angle_high_deg: high, points } = envelope;
  if (low === null || high === null || points.length === 0) return {};
  const mean = (pick: (point: Envelope["points"][number]) => number) => points.reduce((sum, point) => sum + pick(point), 0) / points.length;
  const [centre, stress] = [mean((point) => point.normal_stress_kPa), mean((point) => point.shear_stress_kPa)];
  const ends = sigma.map((x) => [stress + (x - centre) * tangent(low), stress + (x - centre) * tangent(high)]);
  return { low: ends.map((pair) => Math.max(0, Math.min(...pair))), high: ends.map((pair) => Math.max(...pair)) };
}

function envelopeSeries(envelope: Envelope, place: number, at: string, far: number): Series[] {
  const name = mixtureName(envelope.values);
  const { friction_angle_deg: angle, cohesion_kPa: cohesion, points } = envelope;
  const series: Series[] = [{
    name, key: name, x: points.map((point) => point.normal_stress_kPa), y: points.map((point) => point.shear_stress_kPa), draw: "points", sample: "both",
    colour: place, symbol: place, dash: place, sourceX: (row) => `${at}.points.${row}.normal_stress_kPa`, sourceY: (row) => `${at}.points.${row}.shear_stress_kPa`,
  }];
  if (angle === null || cohesion === null) return series;
  const sigma = Array.from({ length: 21 }, (_, step) => (far * step) / 20);
  const middle = boundsAt(envelope, sigma);
  return [...series, { name: `${name}, fit`, key: name, unlisted: true, x: sigma, y: sigma.map((x) => cohesion + x * tangent(angle)), draw: "line", colour: place, dash: place, ...middle }];
}

function envelopeTable(campaign: Campaign): HTMLElement {
  const rows = campaign.envelopes.map((envelope, place) => {
    const at = `campaign.envelopes.${place}`;
    const bounds = (name: "friction_angle" | "cohesion", unit: "deg" | "kPa") => {
      const low = envelope[`${name}_low_${unit}` as keyof Envelope] as number | null;
      const high = envelope[`${name}_high_${unit}` as keyof Envelope] as number | null;
      return low === null || high === null ? el("td", {}, "–")
        : el("td", {}, numberSpan(low, `${at}.${name}_low_${unit}`), " to ", numberSpan(high, `${at}.${name}_high_${unit}`));
    };
    return el("tr", {},
      el("th", { scope: "row" }, mixtureName(envelope.values)), el("td", {}, envelope.quantity),
      el("td", {}, numberSpan(envelope.friction_angle_deg, `${at}.friction_angle_deg`)), bounds("friction_angle", "deg"),
      el("td", {}, numberSpan(envelope.cohesion_kPa, `${at}.cohesion_kPa`)), bounds("cohesion", "kPa"),
      el("td", {}, String(envelope.points.length)), el("td", {}, envelope.tests_still_rising > 0 ? String(envelope.tests_still_rising) : "none"));
  });
  const head = ["Mixture", "Stress", "Friction angle φ", "95 %", "Cohesion c", "95 %", "Tests", "still rising"];
  return el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": "Mohr-Coulomb envelopes" },
    el("table", { class: "wide-table" }, el("thead", {}, el("tr", {}, ...head.map((name) => el("th", { scope: "col" }, name)))), el("tbody", {}, ...rows)));
}

export function envelopes(campaign: Campaign): HTMLElement[] {
  if (campaign.envelopes.length === 0) return [el("p", {}, "An envelope needs tests of one mixture under two normal stresses.")];
  const far = 1.08 * Math.max(...campaign.envelopes.flatMap((one) => one.points.map((point) => point.normal_stress_kPa)));
  const mixtures: Values[] = [];
  for (const { values } of campaign.envelopes) if (!mixtures.some((one) => sameValues(one, values))) mixtures.push(values);
  const figures = (["peak", "residual"] as const).flatMap((quantity) => {
    const chosen = campaign.envelopes.map((envelope, place) => ({ envelope, place })).filter(({ envelope }) => envelope.quantity === quantity);
    if (chosen.length === 0) return [];
    const series = chosen.flatMap(({ envelope, place }) =>
      envelopeSeries(envelope, mixtures.findIndex((one) => sameValues(one, envelope.values)), `campaign.envelopes.${place}`, far));
    const words = chosen.map(({ envelope }) =>
      `${mixtureName(envelope.values)}: φ ${withUnit(formatNumber(envelope.friction_angle_deg, 3), "°")}, c ${withUnit(formatNumber(envelope.cohesion_kPa, 3), "kPa")}`);
    return [xyChart({
      title: quantity === "peak" ? "Envelopes of the peak" : "Envelopes of the residual stress", x: { label: "Normal stress", unit: "kPa", low: 0, high: far, exact: true },
      y: { label: "Shear stress", unit: "kPa", low: 0 }, series, group: new ChartGroup(`envelopes-${quantity}`), cursor: "nearest",
      caption: [`${words.join("; ")}.`, series.some((one) => one.low) ? " Shaded: 95 % bounds of the friction angle, about the middle of the points." : " Bounds need three tests."], height: 340,
    })];
  });
  return [charts(...figures), envelopeTable(campaign)];
}
