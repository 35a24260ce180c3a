// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page: src/main.ts and src/page.css become page.js and page.css in ../build/page, or in the folder that the first
// argument or the environment variable DEM4GRM_PAGE_DIR names.
import { build } from "esbuild";
import { mkdir } from "node:fs/promises";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? process.env.DEM4GRM_PAGE_DIR ?? resolve(here, "../build/page"));

await mkdir(out, { recursive: true });
const result = await build({
  absWorkingDir: here,
  entryPoints: { page: "src/main.ts" },
  outdir: out,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "utf8",
  // The page is one file that anybody may copy: the licences of what is in it travel with it.
  legalComments: "inline",
  metafile: true,
  logLevel: "warning",
});
for (const [file, { bytes }] of Object.entries(result.metafile.outputs)) {
  console.log(`${resolve(here, file)}  ${(bytes / 1024).toFixed(0)} kB`);
}
