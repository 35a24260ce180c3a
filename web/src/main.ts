// SPDX-License-Identifier: BSD-3-Clause
// Entry of the page: reads the data that the program wrote into it and builds everything from it.
import "./page.css";
import type { PageData } from "./data.ts";
import { el } from "./dom.ts";
import { restoreScroll } from "./live.ts";
import { buildPage } from "./page.ts";

async function start(): Promise<void> {
  const main = document.getElementById("page") ?? document.body.appendChild(el("main", { id: "page" }));
  const source = document.getElementById("data")?.textContent ?? "";
  try {
    const data = JSON.parse(source) as PageData;
    if (data.format !== 1) throw new Error(`the page reads format 1, the data have format ${String(data.format)}`);
    document.title = data.title;
    await buildPage(data, main);
    restoreScroll();
    // Tests wait for it.
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    main.replaceChildren(el("h1", {}, "The page cannot be shown"), el("p", {}, error instanceof Error ? error.message : String(error)));
    throw error;
  }
}

void start();
