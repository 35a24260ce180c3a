// SPDX-License-Identifier: BSD-3-Clause
// Frame of every chart: title, picture, caption with the key numbers, and behind a switch its numbers as a table and as files.
import { append, type Child, el, slug, uniqueId } from "../dom.ts";
import { formatNumber } from "../numbers.ts";
import { csvText, download, downloadPng, downloadSvg } from "./export.ts";

export interface Cell {
  value: number | string | null;
  /** Place in the data, see numberSpan; none for what the page derived. */
  source?: string;
  test?: string;
}

export interface DataTable {
  columns: string[];
  rows: Cell[][];
}

export interface FigureParts {
  title: string;
  /** Holds the svg elements of the chart. */
  picture: HTMLElement;
  legend?: HTMLElement;
  caption?: Child[];
  table: () => DataTable;
  wide?: boolean;
}

const ROWS_AT_ONCE = 100;

function cellElement(cell: Cell): HTMLElement {
  if (typeof cell.value !== "number") return el("td", {}, cell.value ?? "–");
  return el(
    "td",
    { class: "number", "data-value": cell.value, "data-source": cell.source, "data-test": cell.test },
    formatNumber(cell.value, 6),
  );
}

export function dataTable(title: string, table: DataTable): HTMLElement {
  const body = el("tbody");
  const addRows = (to: number) => {
    for (const row of table.rows.slice(body.rows.length, to)) body.append(el("tr", {}, ...row.map(cellElement)));
  };
  addRows(ROWS_AT_ONCE);
  const head = el("tr", {}, ...table.columns.map((name) => el("th", { scope: "col" }, name)));
  const grid = el("table", {}, el("caption", { class: "hidden-text" }, `Numbers of ${title}`), el("thead", {}, head), body);
  const box = el("div", { class: "table-box tall", tabindex: 0, role: "group", "aria-label": `Numbers of ${title}` }, grid);
  if (table.rows.length > ROWS_AT_ONCE) {
    const more = el("button", { type: "button", onclick: () => (addRows(Infinity), more.remove()) },
      `Show all ${table.rows.length} rows`);
    box.append(more);
  }
  return box;
}

function tools(parts: FigureParts): HTMLElement {
  const name = slug(parts.title).toLowerCase();
  const pictures = () => [...parts.picture.querySelectorAll<SVGSVGElement>("svg.plot")];
  const button = (text: string, action: () => void) => el("button", { type: "button", onclick: action }, text);
  const csv = () => {
    const table = parts.table();
    const text = csvText(table.columns, table.rows.map((row) => row.map((cell) => cell.value)));
    download(`${name}.csv`, new Blob([text], { type: "text/csv" }));
  };
  const buttons = el("div", { class: "buttons" },
    button("CSV", csv),
    button("SVG", () => downloadSvg(name, parts.title, pictures())),
    button("PNG", () => void downloadPng(name, parts.title, pictures())));
  const summary = el("summary", {}, "Data", el("span", { class: "hidden-text" }, ` of ${parts.title}`));
  const box = el("details", { class: "tools" }, summary, buttons);
  box.addEventListener("toggle", () => {
    if (box.open && !box.querySelector("table")) box.append(dataTable(parts.title, parts.table()));
  });
  return box;
}

export function figure(parts: FigureParts): HTMLElement {
  const heading = uniqueId("chart");
  const caption = el("figcaption");
  append(caption, parts.caption ?? []);
  return el("figure", { class: parts.wide ? "chart wide" : "chart", "aria-labelledby": heading },
    el("p", { id: heading, class: "subtitle" }, parts.title), parts.picture, parts.legend, caption, tools(parts));
}

/** What stands where a chart has nothing to show; without a title where the heading above says what it is. */
export function emptyFigure(title: string, reason: string): HTMLElement {
  return el("div", { class: "chart empty" }, title ? el("p", { class: "subtitle" }, title) : null, el("p", {}, reason));
}
