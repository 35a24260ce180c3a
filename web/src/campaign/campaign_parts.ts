// SPDX-License-Identifier: BSD-3-Clause
// All that the page has to say of a campaign as a whole.
import type { Campaign, PageData, Test } from "../data.ts";
import { ChartGroup } from "../chart/group.ts";
import { el } from "../dom.ts";
import { formatNumber, labelOf, unitOf, withUnit } from "../numbers.ts";
import { charts, type Part } from "../sections/part.ts";
import { badge, testVerdict, type Verdict } from "../sections/verdict.ts";
import { measured } from "../value.ts";
import { AGAINST, againstContent, strongAgainstContent } from "./against.ts";
import { campaignCurves } from "./curves.ts";
import { envelopes } from "./envelopes.ts";
import { membersOf } from "./members.ts";
import { polarMultiples } from "./polar_multiples.ts";
import { publishedTables, specimenTable } from "./published.ts";

/** A campaign calls its finished tests done. */
const isDone = (state: string) => state === "done" || state === "finished";

export function missingTests(campaign: Campaign, data: PageData): string[] {
  return campaign.tests.filter(({ name, state }) => !isDone(state) || !data.tests.some((test) => test.name === name)).map(({ name }) => name);
}

function campaignTable(campaign: Campaign, data: PageData, addressOf: (test: Test) => string): HTMLElement {
  const values = campaign.columns;
  const head = ["Test", ...values.map(labelOf), "State", "Peak shear stress", "Residual"].map((name) => el("th", { scope: "col" }, name));
  const rows = campaign.tests.map((one) => {
    const test = data.tests.find(({ name }) => name === one.name);
    const verdict: Verdict = test && isDone(one.state) ? testVerdict(test) : { tone: one.state === "failed" ? "bad" : "unknown", text: one.reason ? `${one.state}: ${one.reason}` : one.state };
    return el("tr", { "data-test": one.name },
      el("th", { scope: "row" }, test ? el("a", { href: addressOf(test) }, one.name) : one.name),
      ...values.map((name) => {
        const value = one.values[name];
        const text = typeof value !== "number" ? (value ?? "–") : name === "rubber_content" ? withUnit(formatNumber(100 * value), "%") : withUnit(formatNumber(value), unitOf(name));
        return el("td", { class: "number" }, text);
      }),
      el("td", {}, badge(verdict)),
      ...["peak_shear_stress_kPa", "residual_shear_stress_kPa"].map((name) => el("td", {}, test ? measured(test.summary, "summary", name) : "–")));
  });
  return el("div", { class: "table-box", tabindex: 0, role: "group", "aria-label": "Tests of the campaign" },
    el("table", { class: "wide-table" }, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...rows)));
}

/** Charts of a few points stand three in a row. */
function small(...figures: HTMLElement[]): HTMLElement {
  const box = charts(...figures);
  box.classList.add("small");
  return box;
}

export function campaignParts(campaign: Campaign, data: PageData, addressOf: (test: Test) => string): Part[] {
  const members = membersOf(data);
  const missing = missingTests(campaign, data);
  const against = new ChartGroup("against");
  const published = publishedTables(data);
  const words = missing.length === 0
    ? `All ${campaign.tests.length} tests are finished.`
    : `${campaign.tests.length - missing.length} of ${campaign.tests.length} tests are finished. Missing: ${missing.join(", ")}.`;
  const parts: Part[] = [
    { id: "tests", title: "Tests", note: [words], body: [campaignTable(campaign, data, addressOf)] },
    { id: "strength", title: "Strength", body: envelopes(campaign) },
    { id: "curves", title: "Curves", body: campaignCurves(members) },
    { id: "specimens", title: "Specimens", body: [specimenTable(members.members.map(({ test }) => test), addressOf), ...(published.length > 0 ? [el("h3", {}, "Published values"), ...published] : [])] },
    { id: "content", title: "Strength and density", short: "Density", body: [small(...againstContent(members, AGAINST.strength, against))] },
    { id: "polar", title: "Directions of contacts and forces", short: "Directions", body: [charts(polarMultiples(members))] },
    { id: "fabric", title: "Contact network at the peak", short: "Network", body: [small(...againstContent(members, AGAINST.fabric, against)), small(...strongAgainstContent(members))] },
  ];
  return parts;
}
