// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page: src/main.ts and the styles become page.js and page.css in ../build/page, or in the folder that the first
// argument or the environment variable DEM4GRM_PAGE_DIR names.
import { build } from "esbuild";
import { existsSync, readFileSync } from "node:fs";
import { mkdir, writeFile } from "node:fs/promises";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? process.env.DEM4GRM_PAGE_DIR ?? resolve(here, "../build/page"));

/** The page is one file that anybody may copy: the licences of the packages in it travel with it, each text once. */
function licences(inputs) {
  const texts = new Map();
  const packages = new Set(Object.keys(inputs).map((path) => path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean));
  for (const name of [...packages].sort()) {
    const file = ["LICENSE", "LICENSE.md", "LICENSE.txt"].map((one) => join(here, "node_modules", name, one)).find(existsSync);
    if (!file) throw new Error(`${name} is in the page, but its folder holds no licence`);
    const text = readFileSync(file, "utf8").trim();
    texts.set(text, [...(texts.get(text) ?? []), name]);
  }
  return [...texts].map(([text, names]) => `/*! ${names.join(", ")}\n\n${text.replace(/\*\//g, "* /")}\n*/\n`).join("");
}

const result = await build({
  absWorkingDir: here,
  entryPoints: { page: "src/main.ts" },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "utf8",
  legalComments: "none",
  metafile: true,
  write: false,
  logLevel: "warning",
});
await mkdir(out, { recursive: true });
for (const { path, text } of result.outputFiles) {
  const content = (path.endsWith(".js") ? licences(result.metafile.inputs) : "/*! SPDX-License-Identifier: BSD-3-Clause */\n") + text;
  await writeFile(join(out, basename(path)), content);
  console.log(`${join(out, basename(path))}  ${(Buffer.byteLength(content) / 1024).toFixed(0)} kB`);
}
