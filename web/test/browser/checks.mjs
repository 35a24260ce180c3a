// SPDX-License-Identifier: BSD-3-Clause
// Single checks of a page in a browser. Each gives its problems, empty when there are none, and a fact for the report.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Opens what is folded, so that later checks see it, and waits until all charts are drawn. */
export async function unfold(page) {
  const opened = await page.evaluate(async () => {
    let count = 0;
    // Opening a test makes further folded parts.
    for (let round = 0; round < 4; round += 1) {
      for (const box of document.querySelectorAll("details:not([open])")) {
        box.open = true;
        count += 1;
      }
      await new Promise((done) => setTimeout(done, 60));
    }
    return count;
  });
  return { problems: [], fact: `${opened} parts` };
}

/** Every chart holds a line, a symbol or a sector, and tells its content in words. */
export async function charts(page) {
  return page.evaluate(() => {
    const problems = [];
    const figures = [...document.querySelectorAll("figure.chart")];
    for (const figure of figures) {
      const title = figure.querySelector("h4").textContent;
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
    if (all.length === 0) problems.push("no number names its source");
    return { problems: problems.slice(0, 20), fact: `${all.length} numbers` };
  });
}

/** Each slider of the charts, moved by the keyboard, changes the picture that it belongs to. */
export async function sliders(page) {
  const found = await page.locator("section input[type=range]:not(.specimen-view input)").all();
  const problems = [];
  for (const slider of found) {
    const picture = () => slider.evaluate((input) => {
      const owner = input.closest("figure") ?? input.closest("section");
      return [...owner.querySelectorAll("svg.plot")].map((plot) => plot.outerHTML).join("");
    });
    const name = await slider.evaluate((input) => input.labels[0]?.textContent ?? "without label");
    const before = await picture();
    const key = await slider.evaluate((input) => (Number(input.value) > 0 ? "ArrowLeft" : "ArrowRight"));
    await slider.press(key);
    await page.waitForTimeout(80);
    if ((await picture()) === before) problems.push(`slider "${name}" changes nothing`);
  }
  return { problems, fact: `${found.length} sliders` };
}

/** Where the page shows the specimen, it is drawn, and the cut plane changes what is seen. */
export async function cutPlane(page) {
  const box = page.locator(".specimen-view").first();
  if ((await box.count()) === 0) return { problems: [], fact: "no view" };
  const begun = Date.now();
  await box.scrollIntoViewIfNeeded();
  const canvas = box.locator("canvas").first();
  await canvas.waitFor({ state: "visible", timeout: 10000 });
  await page.waitForFunction(() => document.querySelector(".specimen-view [data-drawn], .specimen-view canvas[data-drawn]") !== null, null, { timeout: 3000 }).catch(() => page.waitForTimeout(1500));
  const unpacked = Date.now() - begun;
  const before = await canvas.screenshot();
  const sliders = await box.locator("input[type=range]").all();
  let cut = null;
  for (const slider of sliders) {
    const words = await slider.evaluate((input) => `${input.getAttribute("aria-label") ?? ""} ${[...(input.labels ?? [])].map((label) => label.textContent).join(" ")}`);
    if (/cut/i.test(words)) cut = slider;
  }
  if (!cut) return { problems: ["the view has no slider for the cut plane"], fact: "" };
  await cut.evaluate((input) => {
    input.value = String((Number(input.min) + Number(input.max)) / 2);
    input.dispatchEvent(new Event("input", { bubbles: true }));
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await page.waitForTimeout(1200);
  const after = await canvas.screenshot();
  return { problems: before.equals(after) ? ["the cut plane changes nothing"] : [], fact: `unpacked in ${unpacked} ms` };
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
  for (let step = 0; step < count + 5; step += 1) await page.keyboard.press("Tab");
  return page.evaluate((all) => {
    const missed = [...document.querySelectorAll("[data-walk]")].filter((control) => !window.walked.has(control.dataset.walk));
    return { problems: missed.slice(0, 8).map((control) => `not reached: ${control.outerHTML.slice(0, 120)}`), fact: `${all} controls` };
  }, count);
}

export async function accessibility(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(async () => {
    const result = await window.axe.run(document, { resultTypes: ["violations"], runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] });
    return result.violations.map(({ id, impact, help, nodes }) => ({ id, impact, help, count: nodes.length, first: nodes[0]?.html.slice(0, 160), why: nodes[0]?.failureSummary }));
  });
  const serious = found.filter(({ impact }) => impact === "serious" || impact === "critical");
  const lesser = found.filter((one) => !serious.includes(one)).map(({ id }) => id);
  return {
    problems: serious.map(({ id, help, count, first, why }) => `${id} (${count}): ${help}; first ${first}; ${why}`),
    fact: lesser.length > 0 ? `lesser findings ${lesser.join(", ")}` : "",
  };
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
