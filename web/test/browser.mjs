// SPDX-License-Identifier: BSD-3-Clause
// Opens pages from disk in one headless Chromium and checks what a reader relies on: nothing is asked of a network, nothing fails,
// every chart has data, controls change pictures, keyboard and contrast serve everybody, numbers equal those of the data.
//
//   node test/browser.mjs [--shots FOLDER] [--variants] [--chromium PROGRAM] PAGE.html...
//
// --variants also changes the data of the first page of one direct shear test: running, failed, full of holes, with hostile names.
//
// Not tested: that the pictures are beautiful (look at the screenshots), and the physics of the numbers.
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { accessibility, charts, cutPlane, files, keyboard, numbers, printing, sliders, unfold } from "./browser/checks.mjs";
import { soundness, writeVariants } from "./browser/variants.mjs";

const FLAGS = [
  "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--no-first-run",
];
const WIDTHS = [400, 900, 1600];
const SHEET = 1800;

function options(words) {
  const found = { pages: [], shots: "", variants: false, program: "/usr/bin/chromium" };
  for (let k = 0; k < words.length; k += 1) {
    if (words[k] === "--shots") found.shots = resolve(words[(k += 1)] ?? "");
    else if (words[k] === "--variants") found.variants = true;
    else if (words[k] === "--chromium") found.program = words[(k += 1)] ?? "";
    else found.pages.push(resolve(words[k]));
  }
  return found;
}

/** What the page asked for beside itself, and what went wrong in it. */
function listen(page, address) {
  const seen = { requests: [], errors: [] };
  page.on("request", (request) => {
    const url = request.url();
    if (url !== address && !url.startsWith("data:") && !url.startsWith("blob:")) seen.requests.push(url);
  });
  page.on("console", (message) => message.type() === "error" && seen.errors.push(message.text()));
  page.on("pageerror", (error) => seen.errors.push(String(error)));
  return seen;
}

/** Sheets of one height below each other: a whole long page is more than the graphics of a headless browser hold in one picture. */
async function sheets(page, width, path) {
  await page.setViewportSize({ width, height: SHEET });
  const height = await page.evaluate(() => document.documentElement.scrollHeight);
  for (let sheet = 0; sheet * SHEET < height; sheet += 1) {
    await page.evaluate((top) => scrollTo({ top, behavior: "instant" }), sheet * SHEET);
    await page.waitForTimeout(250);
    await page.screenshot({ path: `${path}-${width}-${sheet + 1}.png` });
  }
}

async function screenshots(page, folder, name) {
  mkdirSync(folder, { recursive: true });
  for (const width of WIDTHS) await sheets(page, width, join(folder, name));
  await page.evaluate(() => document.querySelector("button.theme").click());
  await sheets(page, 1200, join(folder, `${name}-dark`));
  await page.evaluate(() => {
    document.querySelector("button.theme").click();
    scrollTo({ top: 0, behavior: "instant" });
  });
  await page.setViewportSize({ width: 1280, height: 900 });
}

async function checkAll(check, page) {
  await check("keyboard", keyboard);
  await check("unfolding one test", () => unfold(page, false));
  await check("accessibility, light", () => accessibility(page, false));
  await check("accessibility, dark", () => accessibility(page, true));
  await check("sliders", sliders);
  await check("cut plane", cutPlane);
  await check("print", printing);
  await check("unfolding all", () => unfold(page, true));
  await check("charts", charts);
  await check("files", files);
  await check("numbers", numbers);
  await check("soundness", soundness);
}

async function checkPage(browser, file, shots, isVariant) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  const page = await context.newPage();
  const address = pathToFileURL(file).href;
  const seen = listen(page, address);
  const failures = [];
  const facts = [];
  const check = async (name, work) => {
    const begun = performance.now();
    const { problems, fact } = await work(page).catch((error) => ({ problems: [String(error).split("\n")[0]], fact: "" }));
    facts.push(`${name}: ${problems.length === 0 ? "ok" : "FAILED"}${fact ? `, ${fact}` : ""} (${Math.round(performance.now() - begun)} ms)`);
    failures.push(...problems.slice(0, 8).map((problem) => `${name}: ${problem}`));
  };
  await page.goto(address, { waitUntil: "load" });
  await page.waitForSelector("html[data-ready]");
  const paint = await page.evaluate(() => new Promise((done) => {
    const found = () => performance.getEntriesByName("first-contentful-paint")[0]?.startTime;
    requestAnimationFrame(() => setTimeout(() => done(found() ?? performance.now()), 0));
  }));
  facts.push(`first paint after ${Math.round(paint)} ms`);
  if (paint > 3000) failures.push(`first paint after ${Math.round(paint)} ms, more than 3000`);
  if (shots) await screenshots(page, shots, basename(file, ".html"));
  if (isVariant) {
    await check("unfolding all", () => unfold(page, true));
    await check("soundness", soundness);
    await check("numbers", numbers);
  } else await checkAll(check, page);
  failures.push(...seen.requests.map((url) => `request: ${url}`), ...seen.errors.map((text) => `console: ${text}`));
  facts.push(`${seen.requests.length} requests, ${seen.errors.length} errors`);
  await context.close();
  return { failures, facts };
}

const { pages, shots, variants, program } = options(process.argv.slice(2));
if (pages.length === 0) {
  console.error("usage: node test/browser.mjs [--shots FOLDER] [--variants] [--chromium PROGRAM] PAGE.html...");
  process.exit(64);
}
const browser = await chromium.launch({ executablePath: program, args: FLAGS, chromiumSandbox: false });
const folder = mkdtempSync(join(tmpdir(), "dem4grm-variants-"));
let failed = 0;
try {
  const changed = variants ? pages.flatMap((file) => writeVariants(file, folder)).slice(0, 4) : [];
  if (variants && changed.length === 0) throw new Error("--variants needs a page of one direct shear test");
  for (const file of [...pages, ...changed]) {
    const { failures, facts } = await checkPage(browser, file, shots, changed.includes(file));
    console.log(`${file}\n  ${facts.join("\n  ")}`);
    for (const failure of failures) console.error(`  FAILED ${failure}`);
    failed += failures.length;
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
console.log(failed === 0 ? "all pages passed" : `${failed} failures`);
process.exitCode = failed === 0 ? 0 : 1;
