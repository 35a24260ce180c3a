// SPDX-License-Identifier: BSD-3-Clause
// Region that curves mean (1 + a cos k (theta - theta_0)) cover while amplitude and direction run through their 95 % bands.

export type Range = [number, number];

/** Smallest and largest cosine of the angles from low to high, degrees. */
function cosines(low: number, high: number): Range {
  const cos = (degrees: number) => Math.cos((degrees * Math.PI) / 180);
  const ends = [cos(low), cos(high)];
  // A whole turn, or the half turn after it, between the ends takes the cosine to its limit.
  const passes = (degrees: number) => Math.ceil((low - degrees) / 360) * 360 + degrees <= high;
  return [passes(180) ? -1 : Math.min(...ends), passes(0) ? 1 : Math.max(...ends)];
}

export interface Band {
  mean: number;
  /** What the amplitude multiplies, the mean of the curve unless told otherwise. */
  unit: number;
  harmonic: 2 | 4;
  amplitude: Range;
  direction_deg: Range;
}

export function bandAt(band: Band, angle_deg: number): Range {
  const k = band.harmonic;
  const [low, high] = cosines(k * (angle_deg - band.direction_deg[1]), k * (angle_deg - band.direction_deg[0]));
  const products = band.amplitude.flatMap((amplitude) => [amplitude * low, amplitude * high]);
  return [band.mean + band.unit * Math.min(...products), band.mean + band.unit * Math.max(...products)];
}

/** The signed tangential force is -unit a sin 2 (theta - theta_0): the same curve about zero, turned by 45 degrees. */
export function signedBand(unit: number, amplitude: Range, direction_deg: Range): Band {
  return { mean: 0, unit, harmonic: 2, amplitude, direction_deg: [direction_deg[0] - 45, direction_deg[1] - 45] };
}
