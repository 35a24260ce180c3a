// SPDX-License-Identifier: BSD-3-Clause
// The whole page: header, navigation and the parts of the tests or of the campaign.
import { campaignParts, missingTests } from "./campaign/campaign_parts.ts";
import { publishedTables } from "./campaign/published.ts";
import { command } from "./controls.ts";
import type { PageData, Test } from "./data.ts";
import { el, slug } from "./dom.ts";
import { liveBar } from "./live.ts";
import { overlay, testTable } from "./sections/overlay.ts";
import { type Part, section } from "./sections/part.ts";
import { testParts } from "./sections/test_parts.ts";
import { badge, testVerdict, type Verdict } from "./sections/verdict.ts";
import { keep, setting } from "./settings.ts";
import { themeSwitch } from "./theme.ts";

function pageVerdict(data: PageData): Verdict {
  const only = data.tests[0];
  if (data.campaign) {
    const missing = missingTests(data.campaign, data).length;
    const all = data.campaign.tests.length;
    const tones = data.tests.map((test) => testVerdict(test).tone);
    const count = (tone: Verdict["tone"], words: string) => {
      const number = tones.filter((one) => one === tone).length;
      return number > 0 ? `, ${number} ${words}` : "";
    };
    const doubts = `${count("bad", "not to be used without care")}${count("warning", "to be looked at")}`;
    const tone = worstOf(data.tests);
    return missing === 0
      ? { tone, text: `all ${all} tests finished${doubts || ", all checks passed"}` }
      : { tone: tone === "bad" ? tone : "warning", text: `${all - missing} of ${all} tests finished${doubts}` };
  }
  if (only && data.tests.length === 1) return testVerdict(only);
  if (!only) return { tone: "unknown", text: "no tests" };
  return { tone: worstOf(data.tests), text: `${data.tests.length} tests` };
}

function worstOf(tests: Test[]): Verdict["tone"] {
  const tones = tests.map((test) => testVerdict(test).tone);
  return (["bad", "warning", "unknown"] as const).find((tone) => tones.includes(tone)) ?? "good";
}

const KINDS: Record<Test["kind"], string> = { direct_shear: "Direct shear test", grain_compression: "Grain compression", specimen: "Specimen" };

function header(data: PageData): HTMLElement {
  const only = data.tests.length === 1 && !data.campaign ? data.tests[0] : undefined;
  const what = data.campaign ? "Campaign of direct shear tests" : only ? KINDS[only.kind] : `${data.tests.length} tests`;
  const facts: [string, string][] = [
    ["DEM4GRM", data.program.version], ["Commit", data.program.commit], ...(only?.state_hash ? [["State hash", only.state_hash] as [string, string]] : []),
    ["Written", data.program.written.replace("T", " ").replace("Z", " UTC")],
  ];
  return el("header", { class: "page-header" },
    el("p", { class: "kind" }, what),
    el("h1", {}, data.title), el("p", {}, badge(pageVerdict(data))),
    el("dl", { class: "facts" }, ...facts.map(([name, value]) => el("div", {}, el("dt", {}, name), el("dd", {}, value)))),
    el("div", { class: "repeat" }, el("span", { class: "label" }, only ? "Repeats the test" : "Makes this page again"), command(only ? only.command : data.program.command)),
    data.notes.length > 0 ? el("ul", { class: "notes" }, ...data.notes.map((note) => el("li", {}, note))) : null);
}

function navigation(parts: Part[], data: PageData, theme: HTMLElement): HTMLElement {
  const links = parts.map(({ id, title, short }) => el("li", {}, el("a", { href: `#${id}` }, short ?? title)));
  const nav = el("nav", { class: "page-nav", "aria-label": "Parts of the page" },
    el("div", { class: "nav-inner" }, el("ul", {}, ...links), data.live_seconds === null ? null : liveBar(data.live_seconds), theme));
  const byId = new Map(parts.map(({ id }, place) => [id, links[place]?.firstElementChild]));
  const observer = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const link = byId.get(entry.target.id);
      if (entry.isIntersecting) link?.setAttribute("aria-current", "true");
      else link?.removeAttribute("aria-current");
    }
  }, { rootMargin: "-30% 0px -60% 0px" });
  requestAnimationFrame(() => {
    for (const { id } of parts) {
      const target = document.getElementById(id);
      if (target) observer.observe(target);
    }
  });
  return nav;
}

/** A test among others: folded, its charts made when it is opened. */
function foldedTest(test: Test, data: PageData, id: string): HTMLElement {
  const body = el("div", { class: "test-body" });
  const summary = el("summary", {}, el("h3", {}, test.name), badge(testVerdict(test)));
  const box = el("details", { class: "test", id, "data-test": test.name }, summary, body);
  const open = () => {
    keep(`open:${id}`, box.open);
    if (box.open && body.childElementCount === 0) {
      body.append(...testParts(test, data, id).map((part) => section(part, 3)));
    }
  };
  box.addEventListener("toggle", open);
  if (setting(`open:${id}`, false)) box.open = true;
  return box;
}

/** Headline and verdict are there at once; the charts follow when they have been painted. */
export async function buildPage(data: PageData, main: HTMLElement): Promise<void> {
  const theme = themeSwitch();
  main.tabIndex = -1;
  main.replaceChildren(header(data));
  await new Promise<void>((painted) => {
    requestAnimationFrame(() => setTimeout(painted, 0));
    // A tab behind others gets no frames.
    setTimeout(painted, 200);
  });
  buildParts(data, main, theme);
}

function buildParts(data: PageData, main: HTMLElement, theme: HTMLElement): void {
  const ids = new Map(data.tests.map((test, place) => [test, `test-${slug(test.name)}${data.tests.findIndex((one) => slug(one.name) === slug(test.name)) < place ? `-${place}` : ""}`]));
  const addressOf = (test: Test) => `#${ids.get(test) ?? ""}`;
  const only = data.tests.length === 1 && !data.campaign ? data.tests[0] : undefined;
  const parts: Part[] = [];
  if (data.campaign) parts.push(...campaignParts(data.campaign, data, addressOf));
  else if (only) parts.push(...testParts(only, data, ""));
  else {
    parts.push({ id: "tests", title: "Tests", body: [testTable(data.tests, addressOf)] });
    parts.push({ id: "comparison", title: "Side by side", body: overlay(data.tests, data.laboratory) });
  }
  const published = data.campaign ? [] : publishedTables(data);
  if (published.length > 0) parts.splice(Math.max(1, parts.length - 3), 0, { id: "published", title: "Published values", body: published });
  if (data.laboratory.length > 0) {
    parts.push({ id: "laboratory", title: "Laboratory curves", body: [el("ul", {}, ...data.laboratory.map(({ name, note }) => el("li", {}, el("strong", {}, name), `: ${note}`)))] });
  }
  if (!only) {
    const folded = data.tests.map((test) => foldedTest(test, data, ids.get(test) ?? ""));
    parts.push({ id: "each", title: "Each test", body: folded });
    parts.push({ id: "provenance", title: "Provenance", body: [el("p", { class: "subtitle" }, "Command that makes this page again"), command(data.program.command)] });
  }
  const article = el("div", { class: "parts" }, ...parts.map((part) => section(part, 2)));
  if (only) article.dataset.test = only.name;
  main.before(el("a", { class: "skip", href: "#page" }, "Skip to the content"), navigation(parts, data, theme));
  main.append(article);
  openTarget();
  addEventListener("hashchange", openTarget);
}

/** A link to a folded test unfolds it. */
function openTarget(): void {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!(target instanceof HTMLDetailsElement)) return;
  target.open = true;
  target.scrollIntoView();
}
