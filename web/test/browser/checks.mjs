// SPDX-License-Identifier: BSD-3-Clause
// Single checks of a page in a browser. Each gives its problems, empty when there are none, and a fact for the report.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Opens what is folded and waits until its charts are drawn: of the first test all but the many numbers behind its charts, or
 * everything. */
export async function unfold(page, everything) {
  const opened = await page.evaluate(async (all) => {
    let count = 0;
    // Opening a test makes further folded parts.
    for (let round = 0; round < 4; round += 1) {
      for (const box of document.querySelectorAll("details:not([open])")) {
        const test = box.closest("details.test");
        if (!all && ((test && test !== document.querySelector("details.test")) || (box.matches(".tools") && box !== document.querySelector(".tools")))) continue;
        box.open = true;
        count += 1;
      }
      await new Promise((done) => setTimeout(done, 40));
    }
    for (let wait = 0; wait < 400 && document.querySelector("svg.plot:not([viewBox])"); wait += 1) await new Promise((done) => setTimeout(done, 25));
    return count;
  }, everything);
  return { problems: [], fact: `${opened} parts` };
}

/** Every chart holds a line, a symbol or a sector, and tells its content in words. */
export async function charts(page) {
  return page.evaluate(() => {
    const problems = [];
    const figures = [...document.querySelectorAll("figure.chart")];
    for (const figure of figures) {
      const title = figure.querySelector(".subtitle").textContent;
      for (const plot of figure.querySelectorAll("svg.plot")) {
        const marks = [...plot.querySelectorAll(".series .line, .series .symbol, .series .bin")];
        if (!marks.some((mark) => (mark.getAttribute("d") ?? "").length > 8)) problems.push(`${title}: nothing is drawn`);
        if (!plot.getAttribute("aria-label")) problems.push(`${title}: no text alternative`);
        if (plot.innerHTML.includes("NaN")) problems.push(`${title}: a coordinate is no number`);
      }
      if (!figure.querySelector("svg.plot")) problems.push(`${title}: no picture`);
      if (!figure.querySelector(".tools td")) problems.push(`${title}: no numbers behind it`);
    }
    if (figures.length === 0) problems.push("the page has no chart");
    return { problems, fact: `${figures.length} charts` };
  });
}

/** Every number that names its source has the value that stands there, and a text that reads as this value. */
export async function numbers(page) {
  return page.evaluate(() => {
    const data = JSON.parse(document.getElementById("data").textContent);
    const tables = { shear: "shear", walls: "walls", micro: "micro", profiles: "profiles", grain: "compression" };
    const places = new Map();
    const at = (root, path) => path.split(/[.[\]]+/).filter(Boolean).reduce((here, key) => here?.[key], root);
    const valueOf = (source, name) => {
      const test = name === undefined ? undefined : data.tests.find((one) => one.name === name);
      const cell = source.match(/^(shear|walls|micro|profiles|grain)\.(\w+)\[(\d+)\]$/);
      if (cell) {
        const table = test?.tables[tables[cell[1]]];
        const key = `${name}:${cell[1]}:${cell[2]}`;
        if (!places.has(key)) places.set(key, table?.columns.indexOf(cell[2]));
        return table?.values[places.get(key)]?.[Number(cell[3])];
      }
      return source.startsWith("published.") || source.startsWith("campaign.") ? at(data, source) : at(test, source);
    };
    const read = (text) => {
      const raised = { "⁰": 0, "¹": 1, "²": 2, "³": 3, "⁴": 4, "⁵": 5, "⁶": 6, "⁷": 7, "⁸": 8, "⁹": 9, "⁻": "-" };
      const plain = text.replace(/−/g, "-").replace(/(\d)\u202f(?=\d)/g, "$1");
      const power = plain.match(/^(-?[\d.]+) × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/);
      if (power) return Number(`${power[1]}e${[...power[2]].map((sign) => raised[sign]).join("")}`);
      return parseFloat(plain);
    };
    const problems = [];
    const all = document.querySelectorAll("[data-source]");
    for (const element of all) {
      const { source } = element.dataset;
      const value = Number(element.dataset.value);
      const expected = valueOf(source, element.closest("[data-test]")?.dataset.test);
      const shown = read(element.textContent);
      if (value !== expected) problems.push(`${source}: the page has ${element.dataset.value}, the data have ${expected}`);
      else if (Math.abs(shown - value) > 6e-3 * Math.abs(value)) problems.push(`${source}: ${value} is shown as ${element.textContent}`);
    }
    const hasNumbers = data.tests.some((test) => Object.keys(test.summary).length > 0 || test.tables.shear);
    if (all.length === 0 && hasNumbers) problems.push("no number names its source");
    return { problems: problems.slice(0, 20), fact: `${all.length} numbers` };
  });
}

/** Each slider and each choice of the charts changes the picture that it belongs to. */
export async function sliders(page) {
  return page.evaluate(async () => {
    const problems = [];
    const found = [...document.querySelectorAll(".controls input[type=range], .controls fieldset")];
    for (const control of found) {
      const owner = control.closest("figure") ?? control.closest("section");
      const picture = () => [...owner.querySelectorAll("svg.plot")].map((plot) => plot.outerHTML).join("");
      const before = picture();
      const other = control.querySelector("input:not(:checked)");
      if (control.tagName === "FIELDSET" && !other) continue;
      if (other) other.click();
      else {
        control.value = String(Number(control.value) > 0 ? Number(control.value) - 1 : 1);
        control.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise((done) => requestAnimationFrame(() => setTimeout(done, 0)));
      }
      const name = control.querySelector("legend")?.textContent ?? control.labels?.[0]?.textContent;
      if (!name) problems.push("a slider has no label");
      if (picture() === before) problems.push(`"${name}" changes nothing`);
    }
    return { problems, fact: `${found.length} controls` };
  });
}

/** Where the page shows the specimen, it is drawn, and the cut plane changes what is seen. */
export async function cutPlane(page) {
  const box = page.locator(".specimen-view").first();
  if ((await box.count()) === 0) return { problems: [], fact: "no view" };
  const begun = Date.now();
  await box.scrollIntoViewIfNeeded();
  const canvas = box.locator("canvas").first();
  await canvas.waitFor({ state: "visible", timeout: 10000 });
  // The canvas keeps its picture; a screenshot would wait for two quiet frames, which software rendering may not give.
  const picture = () => canvas.evaluate((element) => element.toDataURL());
  /** The next picture that differs and stays; null when none comes. */
  const changes = async (before) => {
    let last = before;
    for (let wait = 0; wait < 40; wait += 1) {
      const now = await picture();
      if (now !== before && now === last) return now;
      last = now;
      await page.waitForTimeout(100);
    }
    return null;
  };
  const whole = await changes("");
  const drawn = Date.now() - begun;
  const cut = box.locator("fieldset", { has: page.locator("legend", { hasText: /^Cut/ }) });
  if ((await cut.count()) === 0) return { problems: ["the view has no cut plane"], fact: "" };
  await cut.locator("select").first().selectOption("y");
  const half = await changes(whole);
  if (half === null) return { problems: ["the cut plane changes nothing"], fact: "" };
  await cut.locator("input[type=range]").first().press("Home");
  const problems = (await changes(half)) === null ? ["moving the cut plane changes nothing"] : [];
  await cut.locator("select").first().selectOption("none");
  return { problems, fact: `in sight after ${drawn} ms` };
}

/** Tab reaches every control that can be seen. */
export async function keyboard(page) {
  const count = await page.evaluate(() => {
    // What is folded away again shortens the walk; tables of numbers are many and alike.
    for (const box of document.querySelectorAll("details.tools, details.inputs")) box.open = false;
    const controls = [...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']")].filter((control) => {
      if (control.disabled || control.closest("details:not([open]) > :not(summary)")) return false;
      if (control.type === "radio" && !control.checked) return false;
      return control.getClientRects().length > 0;
    });
    controls.forEach((control, place) => (control.dataset.walk = String(place)));
    document.activeElement?.blur();
    scrollTo(0, 0);
    getSelection()?.removeAllRanges();
    window.walked = new Set();
    document.addEventListener("focusin", (event) => window.walked.add(event.target.dataset?.walk));
    return controls.length;
  });
  // Beginning at the top of the document, wherever earlier checks have left the focus.
  await page.evaluate(() => {
    const start = document.createElement("span");
    start.tabIndex = -1;
    document.body.prepend(start);
    start.focus();
    start.remove();
  });
  // The view of the specimen may come into being on the way, with some thirty controls of its own.
  for (let step = 0; step < count + 60; step += 1) await page.keyboard.press("Tab");
  return page.evaluate((all) => {
    const missed = [...document.querySelectorAll("[data-walk]")].filter((control) => !window.walked.has(control.dataset.walk));
    return { problems: missed.slice(0, 8).map((control) => `not reached: ${control.outerHTML.slice(0, 120)}`), fact: `${all} controls` };
  }, count);
}

/** All rules of axe in light; in dark those of colours, since nothing else depends on them. At the top of the page, where the bar that
 * stays in sight covers nothing: farther down it lies over whatever scrolls by, which axe takes for targets too close to each other. */
export async function accessibility(page, dark) {
  await page.evaluate(() => {
    scrollTo({ top: 0, behavior: "instant" });
    return new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
  });
  if (dark) await page.evaluate(() => document.querySelector("button.theme").click());
  else await page.evaluate(axe);
  const found = await page.evaluate(async (rules) => {
    const result = await window.axe.run(document, { resultTypes: ["violations"], runOnly: rules, preload: false, iframes: false });
    return result.violations.map(({ id, impact, help, nodes }) => ({ id, impact, help, count: nodes.length, first: nodes[0]?.html.slice(0, 160), why: nodes[0]?.failureSummary }));
  }, dark ? { type: "rule", values: ["color-contrast"] } : { type: "tag", values: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] });
  if (dark) await page.evaluate(() => document.querySelector("button.theme").click());
  const serious = found.filter(({ impact }) => impact === "serious" || impact === "critical");
  const lesser = found.filter((one) => !serious.includes(one)).map(({ id, first }) => `${id} at ${first}`);
  return {
    problems: serious.map(({ id, help, count, first, why }) => `${id} (${count}): ${help}; first ${first}; ${why}`),
    fact: lesser.length > 0 ? `lesser findings: ${lesser.join("; ")}` : "",
  };
}

/** The files of a chart: SVG that stands by itself, PNG, CSV with all rows. */
export async function files(page) {
  const box = page.locator("figure.chart .tools").first();
  await box.evaluate((details) => (details.open = true));
  const problems = [];
  const take = async (name) => {
    const [download] = await Promise.all([page.waitForEvent("download", { timeout: 20000 }), box.locator("button", { hasText: name }).first().click()]);
    return readFileSync(await download.path());
  };
  const svg = (await take("SVG")).toString();
  if (!/^<svg xmlns/.test(svg) || /class=|var\(/.test(svg) || !/stroke="rgb/.test(svg)) problems.push("the SVG needs the style of the page");
  const png = await take("PNG");
  if (png.subarray(1, 4).toString() !== "PNG" || png.length < 5000) problems.push("the PNG is empty");
  const lines = (await take("CSV")).toString().trim().split("\r\n");
  const rows = await box.evaluate((details) => details.querySelectorAll("tbody tr").length);
  if (lines.length < rows + 1 || new Set(lines.map((line) => line.replace(/"[^"]*"/g, "").split(",").length)).size !== 1) problems.push("the CSV lacks rows or cells");
  return { problems, fact: `SVG ${svg.length} B, PNG ${png.length} B, CSV ${lines.length} lines` };
}

/** On paper the page is light, without navigation, and no chart is wider than the sheet. */
export async function printing(page) {
  await page.emulateMedia({ media: "print" });
  const result = await page.evaluate(() => {
    const problems = [];
    if (getComputedStyle(document.body).backgroundColor !== "rgb(255, 255, 255)") problems.push("the ground is not white");
    if (document.querySelector(".page-nav").getClientRects().length > 0) problems.push("the navigation is printed");
    for (const plot of document.querySelectorAll("svg.plot")) {
      if (plot.getBoundingClientRect().width > document.documentElement.clientWidth + 1) problems.push("a chart is wider than the sheet");
    }
    return { problems, fact: "" };
  });
  await page.emulateMedia({ media: null });
  return result;
}
