// SPDX-License-Identifier: BSD-3-Clause
// Entry of the page: reads the data that the program wrote into it and builds the sections.
import "./page.css";
import type { PageData } from "./data.ts";

const data = JSON.parse(document.getElementById("data")?.textContent ?? "null") as PageData | null;
if (data) document.title = data.title;
