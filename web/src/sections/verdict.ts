// SPDX-License-Identifier: BSD-3-Clause
// What to think of a test in one line: its state and the worst of its quality lines.
import type { QualityLine, Test } from "../data.ts";
import { el } from "../dom.ts";
import { numberAt } from "../value.ts";

export type Tone = "good" | "warning" | "bad" | "unknown";

export interface Verdict {
  tone: Tone;
  text: string;
}

const SIGNS: Record<Tone, string> = { good: "✓", warning: "!", bad: "✕", unknown: "…" };
const TONE_WORDS: Record<Tone, string> = { good: "good", warning: "warning", bad: "bad", unknown: "not known" };

function list(names: string[]): string {
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names[names.length - 1]}`;
}

/** Names start a row with a capital and stand small inside a sentence, but for those of persons and abbreviations. */
function inSentence(name: string): string {
  return /^[A-Z][a-z]/.test(name) ? name.charAt(0).toLowerCase() + name.slice(1) : name;
}

/** What a line is about, without what is measured of it: "inertial number, largest" is about the inertial number. */
function subjects(lines: QualityLine[], verdict: Tone): string[] {
  const names = lines.filter((line) => line.verdict === verdict).map((line) => inSentence(line.name.split(",")[0] ?? ""));
  return [...new Set(names)].map((name) => {
    const count = names.filter((one) => one === name).length;
    return name.startsWith("warning") ? `${count} ${count === 1 ? name : name.replace("warning", "warnings")}` : name;
  });
}

export function qualityVerdict(lines: QualityLine[]): Verdict {
  const named = (verdict: Tone) => subjects(lines, verdict);
  const bad = named("bad");
  const doubtful = named("warning");
  if (bad.length > 0) return { tone: "bad", text: `do not use without care: ${list(bad)}` };
  if (doubtful.length > 0) return { tone: "warning", text: `look at: ${list(doubtful)}` };
  if (named("good").length === 0) return { tone: "unknown", text: "quality not known yet" };
  return { tone: "good", text: "all checks passed" };
}

export function testVerdict(test: Test): Verdict {
  const quality = qualityVerdict(test.quality);
  const cause = typeof test.status.cause === "string" && test.status.cause ? `: ${test.status.cause}` : "";
  switch (test.state) {
    case "finished":
    case "specimen ready":
      return { tone: quality.tone, text: `${test.state}, ${quality.text}` };
    case "failed":
      return { tone: "bad", text: `failed${cause}` };
    case "stopped":
    case "stopping":
      return { tone: "warning", text: `${test.state}${cause}` };
    default: {
      const progress = numberAt(test.status, "progress");
      const stage = typeof test.status.stage === "string" ? `, ${test.status.stage}` : "";
      return { tone: "unknown", text: `${test.state}${stage}${progress === null ? "" : `, ${Math.min(100, Math.round(100 * progress))} %`}` };
    }
  }
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

export function badge({ tone, text }: Verdict): HTMLElement {
  return el("span", { class: `badge ${tone}` },
    el("span", { class: "sign", "aria-hidden": "true" }, SIGNS[tone]), el("span", {}, capital(text)));
}

export function toneBadge(tone: Tone): HTMLElement {
  return badge({ tone, text: TONE_WORDS[tone] });
}
