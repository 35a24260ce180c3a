// SPDX-License-Identifier: BSD-3-Clause
// Makes of a finished page others that a reader may meet: a running test, a failed one, tests without numbers, hostile names. What
// the page must do with them stands in the check of each.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const HOSTILE = `<img src=x onerror="window.broken=1"></script><b>&amp;"'`;

function shorten(table, rows) {
  return table && { ...table, values: table.values.map((column) => column.slice(0, rows)) };
}

/** Every third number is not there. */
function thin(table) {
  return table && { ...table, values: table.values.map((column, k) => column.map((value, row) => ((row + k) % 3 === 0 ? null : value))) };
}

const EMPTY = { shear: null, walls: null, micro: null, profiles: null, compression: null };

const VARIANTS = {
  running: (data) => {
    const [test] = data.tests;
    data.live_seconds = 600;
    Object.assign(test, {
      state: "running", summary: {}, state_hash: "", histograms: [], sieve: null, quality: [], view: null,
      status: { state: "running", stage: "shear", progress: 0.31, eta: null, displacement_mm: 3.1, shear_stress_kPa: 99.5, cause: null },
      tables: { ...EMPTY, shear: shorten(test.tables.shear, 40), micro: shorten(test.tables.micro, 1) },
    });
  },
  failed: (data) => {
    Object.assign(data.tests[0], {
      state: "failed", inputs: [], summary: {}, state_hash: "", histograms: [], sieve: null, quality: [], view: null, tables: EMPTY,
      status: { state: "failed", cause: `the plate left the box ${HOSTILE}`, progress: null },
    });
  },
  holes: (data) => {
    const [test] = data.tests;
    for (const name of Object.keys(test.tables)) test.tables[name] = thin(test.tables[name]);
    for (const name of Object.keys(test.summary)) if (typeof test.summary[name] === "number") test.summary[name] = null;
    test.summary.micro_at_peak = null;
    for (const line of test.quality) Object.assign(line, { value: null, verdict: "unknown" });
    for (const { sets } of test.histograms) {
      for (const set of sets) Object.assign(set, { normal_force_N: set.angle_deg.map(() => null), fit: Object.fromEntries(Object.keys(set.fit).map((name) => [name, set.angle_deg.map(() => null)])) });
    }
    test.view = null;
  },
  hostile: (data) => {
    const [test] = data.tests;
    data.title = test.name = HOSTILE;
    test.folder = test.command = data.program.command = HOSTILE;
    test.view = null;
    test.summary.warnings = [HOSTILE];
    test.inputs = [{ section: HOSTILE, rows: [{ key: HOSTILE, value: HOSTILE, comment: HOSTILE }] }];
    data.notes = [HOSTILE];
    data.tests.push({ ...structuredClone(test), name: `${HOSTILE} (2)` }, { ...structuredClone(test), name: "third", state: "stopped", tables: EMPTY, summary: {} });
    data.laboratory = [{ name: HOSTILE, test: null, displacement_mm: [0, 1, 2, 4, 8], shear_stress_kPa: [0, 50, 80, 110, 70], vertical_displacement_mm: [0, -0.05, 0, 0.4, 1], note: HOSTILE }];
    data.published = [{ rubber_content: 0.25, normal_stress_kPa: null, quantity: "void_ratio_before_shear", value: 0.6, source: HOSTILE }];
  },
};

/** Writes the variants of a page of one direct shear test into a folder; gives their paths. */
export function writeVariants(page, folder) {
  const html = readFileSync(page, "utf8");
  const open = '<script id="data" type="application/json">';
  const from = html.indexOf(open) + open.length;
  const to = html.indexOf("</script>", from);
  const data = JSON.parse(html.slice(from, to));
  if (data.tests.length !== 1 || data.tests[0].kind !== "direct_shear") return [];
  return Object.entries(VARIANTS).map(([name, change]) => {
    const other = structuredClone(data);
    change(other);
    const path = join(folder, `${name}.html`);
    writeFileSync(path, html.slice(0, from) + JSON.stringify(other).replaceAll("<", "\\u003c") + html.slice(to));
    return path;
  });
}

/** Nothing that is missing shows as undefined, null or NaN, and no text of a user has become markup. */
export async function soundness(page) {
  return page.evaluate(() => {
    const problems = [];
    for (const word of ["undefined", "NaN", "[object", "Infinity"]) {
      const place = document.getElementById("page").innerText.indexOf(word);
      if (place >= 0) problems.push(`the page says ${word}: ${document.getElementById("page").innerText.slice(Math.max(0, place - 60), place + 40)}`);
    }
    if (/(NaN|Infinity|undefined)/.test([...document.querySelectorAll("svg.plot")].map((plot) => plot.outerHTML).join(""))) problems.push("a picture holds NaN");
    if (window.broken !== undefined || document.querySelector("#page img, #page b")) problems.push("a text of a user became markup");
    if (!document.querySelector("h1") || document.querySelectorAll("section.part").length < 4) problems.push("parts are missing");
    return { problems, fact: `${document.querySelectorAll("figure.chart").length} charts` };
  });
}
