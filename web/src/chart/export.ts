// SPDX-License-Identifier: BSD-3-Clause
// Takes a picture out of the page: SVG with its look written into it, PNG at three times the size, CSV of its numbers.
import { el } from "../dom.ts";

const LOOK = [
  "fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "stroke-linecap", "stroke-linejoin",
  "opacity", "font-family", "font-size", "font-weight", "font-style", "text-anchor", "paint-order",
];

/** A copy in the light colours that does not need the style sheet of the page. */
function standalone(picture: SVGSVGElement): SVGSVGElement {
  const copy = picture.cloneNode(true) as SVGSVGElement;
  const host = el("div", { class: "light-colours off-screen" });
  host.append(copy);
  document.body.append(host);
  for (const element of [copy, ...copy.querySelectorAll<SVGElement>("*")]) {
    const computed = getComputedStyle(element);
    for (const property of LOOK) element.setAttribute(property, computed.getPropertyValue(property));
    element.removeAttribute("class");
    element.removeAttribute("style");
  }
  host.remove();
  return copy;
}

/** All pictures of a chart side by side under its title. */
export function svgText(title: string, pictures: SVGSVGElement[]): { text: string; width: number; height: number } {
  const head = 30;
  let width = 0;
  let height = 0;
  let body = "";
  const serializer = new XMLSerializer();
  for (const picture of pictures) {
    const box = picture.viewBox.baseVal;
    const copy = standalone(picture);
    copy.setAttribute("x", String(width));
    copy.setAttribute("y", String(head));
    copy.setAttribute("width", String(box.width));
    copy.setAttribute("height", String(box.height));
    body += serializer.serializeToString(copy);
    width += box.width;
    height = Math.max(height, box.height + head);
  }
  const text = document.createElementNS("http://www.w3.org/2000/svg", "text");
  const titleAttributes = { x: 8, y: 20, "font-family": "sans-serif", "font-size": 15, "font-weight": 600, fill: "#111" };
  for (const [name, value] of Object.entries(titleAttributes)) text.setAttribute(name, String(value));
  text.textContent = title;
  const open = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">`;
  const ground = `<rect width="${width}" height="${height}" fill="#fff"/>`;
  return { text: `${open}${ground}${serializer.serializeToString(text)}${body}</svg>`, width, height };
}

export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = el("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

export function downloadSvg(name: string, title: string, pictures: SVGSVGElement[]): void {
  download(`${name}.svg`, new Blob([svgText(title, pictures).text], { type: "image/svg+xml" }));
}

export async function downloadPng(name: string, title: string, pictures: SVGSVGElement[]): Promise<void> {
  const scale = 3;
  const { text, width, height } = svgText(title, pictures);
  const image = new Image(width * scale, height * scale);
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = el("canvas", { width: width * scale, height: height * scale });
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => blob && download(`${name}.png`, blob), "image/png");
}

/** RFC 4180, numbers in their full digits, empty where there is none. */
export function csvText(columns: string[], rows: (number | string | null)[][]): string {
  const cell = (value: number | string | null) => {
    const text = value === null ? "" : String(value);
    return /[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return [columns, ...rows].map((row) => row.map(cell).join(",")).join("\r\n") + "\r\n";
}
