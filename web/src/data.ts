// SPDX-License-Identifier: BSD-3-Clause
// What the program writes into the page: the contract between src/dem4grm/report and this page. Numbers carry their units in
// their names. null stands where the program has no number.

/** Content of `<script id="data" type="application/json">`. */
export interface PageData {
  format: 1;
  kind: "tests" | "campaign";
  /** Set while a test runs: the page loads itself anew after so many seconds. */
  live_seconds: number | null;
  title: string;
  program: {
    version: string;
    commit: string;
    /** UTC, ISO 8601. */
    written: string;
    /** That makes this page again. */
    command: string;
  };
  tests: Test[];
  campaign: Campaign | null;
  /** Values of the literature that stand beside ours. */
  published: PublishedValue[];
  /** A laboratory's own curves, as given with --lab. */
  laboratory: LaboratoryCurve[];
  /** What could not be shown and why. */
  notes: string[];
}

export type Kind = "direct_shear" | "grain_compression" | "specimen";

export interface Test {
  /** Unique in the page, also the fragment of links to it. */
  name: string;
  folder: string;
  kind: Kind;
  /** As in status.json: finished, running, stopped, failed ... */
  state: string;
  /** That repeats the test. */
  command: string;
  /** Of the last stored state; empty without one. */
  state_hash: string;
  /** Resolved case, in the order of the file; text as written, units included. */
  inputs: { section: string; rows: { key: string; value: string; comment: string }[] }[];
  /** summary.json as it is (or specimen.json); empty object while there is none. */
  summary: Record<string, unknown>;
  /** status.json as it is; empty object when there is none. */
  status: Record<string, unknown>;
  tables: {
    /** shear.csv, walls.csv, micro.csv, profiles.csv, grain.csv, each null when it is not there. */
    shear: Table | null;
    walls: Table | null;
    micro: Table | null;
    profiles: Table | null;
    compression: Table | null;
  };
  histograms: StateHistograms[];
  sieve: Sieve | null;
  quality: QualityLine[];
  view: View | null;
}

/** A CSV file, column by column, with its numbers as they are written there. */
export interface Table {
  columns: string[];
  /** [column][row] */
  values: (number | null)[][];
}

/** Polar histograms of one stored state. */
export interface StateHistograms {
  displacement_mm: number;
  sets: HistogramSet[];
}

export interface HistogramSet {
  /** all, g-g, g-r, r-r */
  set: string;
  contacts: number;
  /** Over the full circle; angle of the middle of the bin from the shear direction, 90 is up. */
  angle_deg: number[];
  /** Contacts per radian over all contacts; mean normal force, N; mean size of the tangential force, N; mean of the tangential
   * force with its sign in the shear plane, N. null: no contact in that direction. */
  density: (number | null)[];
  normal_force_N: (number | null)[];
  shear_force_N: (number | null)[];
  signed_shear_force_N: (number | null)[];
  /** Fitted curves; null where the set is too small. Density: (1/2pi) (1 + a cos 2(theta - theta_a)); normal force: mean_N
   * (1 + a cos 2(theta - theta)); shear: f_n mean (or its own mean) ...: the values of the curve at angle_deg are given, so that
   * the page draws and does not calculate. */
  fit: {
    density: (number | null)[];
    normal_force_N: (number | null)[];
    shear_force_N: (number | null)[];
    signed_shear_force_N: (number | null)[];
  };
  /** 95 % bands of amplitude and direction from resamples; null without them. */
  bands: {
    a: [number, number] | null;
    theta_a_deg: [number, number] | null;
    a_n: [number, number] | null;
    theta_n_deg: [number, number] | null;
    a_t: [number, number] | null;
    theta_t_deg: [number, number] | null;
    /** Of the signed tangential force; may be left out. */
    a_s?: [number, number] | null;
    theta_s_deg?: [number, number] | null;
  };
}

/** Simulated sieve analysis of the specimen beside the gradings that were asked for. */
export interface Sieve {
  materials: {
    /** gravel, rubber or both */
    name: string;
    sieve_mm: number[];
    /** Per cent by mass that passes: simulated (square openings), and asked for (null for both). */
    passing_per_cent: (number | null)[];
    target_per_cent: (number | null)[];
  }[];
}

/** One line of the quality panel. */
export interface QualityLine {
  name: string;
  /** null: not known. */
  value: number | null;
  unit: string;
  /** In words: what is good and why. */
  limit: string;
  verdict: "good" | "warning" | "bad" | "unknown";
}

export interface Campaign {
  name: string;
  /** Columns by which tests differ, in the order of the study. */
  columns: string[];
  tests: { name: string; values: Record<string, string | number>; state: string; reason: string }[];
  /** Mohr-Coulomb envelopes of each mixture, as in envelopes.csv. */
  envelopes: Envelope[];
}

export interface Envelope {
  /** Values of the mixture, as {rubber_content: 0.25}. */
  values: Record<string, string | number>;
  quantity: "peak" | "residual";
  points: { normal_stress_kPa: number; shear_stress_kPa: number; test: string }[];
  tests_still_rising: number;
  friction_angle_deg: number | null;
  friction_angle_low_deg: number | null;
  friction_angle_high_deg: number | null;
  cohesion_kPa: number | null;
  cohesion_low_kPa: number | null;
  cohesion_high_kPa: number | null;
}

/** One row of cases/paper/published.csv. */
export interface PublishedValue {
  rubber_content: number;
  normal_stress_kPa: number | null;
  /** A name of summary.json. */
  quantity: string;
  value: number;
  /** Where it stands in the article. */
  source: string;
}

export interface LaboratoryCurve {
  name: string;
  /** Test of the page that it belongs to; null: shown with all. */
  test: string | null;
  displacement_mm: number[];
  shear_stress_kPa: (number | null)[] | null;
  vertical_displacement_mm: (number | null)[] | null;
  /** What was understood of the file. */
  note: string;
}

// ---- the view of the specimen ----------------------------------------------------------------------------------------------

/** Whole numbers, packed: `count` numbers of `bytes` bytes each, as byte planes (all lowest bytes, then all next ones, ...),
 * compressed with zlib (RFC 1950, what DecompressionStream calls "deflate"), in base64. With `delta` each number but the first is
 * the difference to the one before it, modulo 2^(8 bytes). With `zigzag` the numbers are signed: 0, -1, 1, -2 ... are 0, 1, 2, 3;
 * zigzag is undone first (of the differences), then delta. */
export interface PackedIntegers {
  count: number;
  bytes: 1 | 2 | 4;
  zigzag: boolean;
  delta: boolean;
  data: string;
}

/** Geometry of a test that does not change, and its stored states. Lengths in mm, z up, x the shear direction. Bodies are rubber
 * grains first, then clumps; balls are 35 for each rubber grain in the order of the grains, then the pebbles of the clumps. */
export interface View {
  /** Position = origin + step * whole number. */
  origin_mm: [number, number, number];
  step_mm: [number, number, number];
  rubber_grains: number;
  clumps: number;
  /** Radius of each rubber ball of a grain, one for each grain: radius = radius_step_mm * whole number. */
  radius_step_mm: number;
  rubber_radius: PackedIntegers;
  /** How the 35 balls of a grain are predicted: position[k] = position[a] + position[b] - position[c] + residual[k], with
   * [a, b, c] the row of k; a row of [-1, -1, -1]: position[k] = residual[k] + position of ball 0 of the grain before (of the
   * origin for the first grain) when k is 0; [0, -1, -1]: position[k] = position[0] + residual[k]. */
  rubber_prediction: [number, number, number][];
  /** Number of pebbles of each clump. */
  clump_pebbles: PackedIntegers;
  /** For every pebble: place in the frame of its clump, in units of radius_step_mm, three numbers each; and its radius. */
  pebble_position: PackedIntegers;
  pebble_radius: PackedIntegers;
  states: ViewState[];
}

export interface ViewState {
  displacement_mm: number;
  /** Residuals of the rubber balls: all x, then all y, then all z. */
  rubber: PackedIntegers;
  /** Clumps: all x, all y, all z of the centre, in steps of the lattice of positions. */
  clump_position: PackedIntegers;
  /** Unit quaternions (w, x, y, z) that take the frame of the clump to space, times 32767: all w, all x, all y, all z. */
  clump_orientation: PackedIntegers;
  /** Mean stress of each body, kPa = step * whole number (compression positive). */
  stress_step_kPa: number;
  body_stress: PackedIntegers;
  /** Mean strain of the bonds of each rubber grain (compression positive) = step * whole number. */
  strain_step: number;
  bond_strain: PackedIntegers;
  /** Contacts between bodies that carry force, sorted by body_i: force = step * whole number, N. */
  contact_body_i: PackedIntegers;
  contact_body_j: PackedIntegers;
  force_step_N: number;
  contact_force: PackedIntegers;
  /** Mean normal force: contacts above it are strong. */
  strong_threshold_N: number;
  /** Walls as parallelograms: corner, two edges (mm), and their name: base_lower_..., plate_top ... */
  walls: { name: string; corner_mm: [number, number, number]; u_mm: [number, number, number]; v_mm: [number, number, number] }[];
}
