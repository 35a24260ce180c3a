// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them: rounded to sensible digits, with the unit that the name of a quantity carries.

const SUPERSCRIPT = "⁰¹²³⁴⁵⁶⁷⁸⁹";
export const NO_NUMBER = "–";

function groupThousands(digits: string): string {
  return digits.replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

export function powerOfTen(exponent: number): string {
  const raised = [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPT[Number(digit)]).join("");
  return `10${exponent < 0 ? "⁻" : ""}${raised}`;
}

/** Rounds to `digits` significant digits. Whole numbers keep all of theirs. */
export function formatNumber(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NO_NUMBER;
  if (value === 0) return "0";
  const sign = value < 0 ? "−" : "";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e12) return sign + (size >= 10000 ? groupThousands(String(size)) : String(size));
  if (size < 1e-3 || size >= 1e6) {
    const [mantissa = "", exponent = "0"] = size.toExponential(Math.min(digits, 3) - 1).split("e");
    return `${sign}${mantissa} × ${powerOfTen(Number(exponent))}`;
  }
  const rounded = size >= 10 ** digits ? String(Math.round(size)) : String(Number(size.toPrecision(digits)));
  const [whole = "", fraction] = rounded.split(".");
  return sign + (whole.length > 4 ? groupThousands(whole) : whole) + (fraction ? `.${fraction}` : "");
}

// Longest first: kPa_per_mm ends in mm.
const UNITS: [string, string][] = [
  ["kPa_per_mm", "kPa/mm"],
  ["mm_per_s", "mm/s"],
  ["N_per_mm", "N/mm"],
  ["kg_per_m3", "kg/m³"],
  ["per_cent", "%"],
  ["per_rad", "1/rad"],
  ["mN_m", "mN·m"],
  ["kPa", "kPa"],
  ["deg", "°"],
  ["mm", "mm"],
  ["MB", "MB"],
  ["us", "µs"],
  ["N", "N"],
  ["J", "J"],
  ["s", "s"],
];

/** peak_shear_stress_kPa: ["peak_shear_stress", "kPa"]; a name without unit: [name, ""]. */
export function splitUnit(name: string): [string, string] {
  for (const [suffix, unit] of UNITS) {
    if (name.endsWith(`_${suffix}`)) return [name.slice(0, -suffix.length - 1), unit];
  }
  return [name, ""];
}

export function unitOf(name: string): string {
  return splitUnit(name)[1];
}

/** Units stand behind a narrow space, the degree sign does not; 1 is the unit of plain numbers. */
export function withUnit(text: string, unit: string): string {
  return unit === "" || unit === "1" ? text : unit === "°" ? `${text}°` : `${text}\u202f${unit}`;
}

const LABELS: Record<string, string> = {
  k0_x: "K₀ along shear",
  k0_y: "K₀ across shear",
  void_ratio_before_shear: "Void ratio before shear",
  void_ratio_min: "Smallest void ratio",
  void_ratio_max: "Largest void ratio",
  rubber_content: "Rubber content (VRC)",
  clumps: "Gravel grains",
  rubber_grains: "Rubber grains",
  balls: "Balls",
  normal_stress: "Normal stress",
  shear_stress: "Shear stress",
  displacement: "Displacement",
  theta_n: "Direction of normal forces θₙ",
  a: "Fabric a",
  a_n: "Normal force aₙ",
  a_t: "Tangential force aₜ",
  vrc: "Rubber content (VRC)",
  displacement_at_peak: "Displacement at peak",
  displacement_at_contraction: "Displacement at largest contraction",
  poisson_ratio_initial: "Poisson's ratio, initial",
  knee_strain: "Strain at the knee",
  load_at_end: "Load at the end",
  strain: "Strain reached",
};

/** A name of the files in words, without its unit. */
export function labelOf(name: string): string {
  const [stem] = splitUnit(name);
  const known = LABELS[name] ?? LABELS[stem];
  if (known) return known;
  const words = stem.replace(/_/g, " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
