// SPDX-License-Identifier: BSD-3-Clause
// Reads columns of the tables of a test.
import type { Table } from "./data.ts";

export type Column = (number | null)[];

export function column(table: Table | null, name: string): Column | null {
  if (!table) return null;
  const place = table.columns.indexOf(name);
  return place < 0 ? null : (table.values[place] ?? null);
}

export function hasNumbers(values: Column | null): values is Column {
  return values !== null && values.some((value) => value !== null);
}

export function rowsOf(table: Table | null): number {
  return table?.values[0]?.length ?? 0;
}

/** Row whose value is nearest to the wanted one; -1 when there is none. */
export function nearestRow(values: Column, wanted: number): number {
  let best = -1;
  let distance = Infinity;
  values.forEach((value, row) => {
    if (value === null) return;
    const here = Math.abs(value - wanted);
    if (here < distance) {
      distance = here;
      best = row;
    }
  });
  return best;
}

/** Slope of y over x by least squares in a window of `half` rows to each side; null where the window is cut off. */
export function slope(x: Column, y: Column, half: number): Column {
  return x.map((_, row) => {
    const rows = Array.from({ length: 2 * half + 1 }, (_, step) => row - half + step);
    const points = rows.flatMap((at): [number, number][] => {
      const [here, there] = [x[at] ?? null, y[at] ?? null];
      return here === null || there === null ? [] : [[here, there]];
    });
    if (points.length < rows.length) return null;
    const mean = (place: 0 | 1) => points.reduce((sum, point) => sum + point[place], 0) / points.length;
    const [meanX, meanY] = [mean(0), mean(1)];
    const spread = points.reduce((sum, [here]) => sum + (here - meanX) ** 2, 0);
    return spread > 0 ? points.reduce((sum, [here, there]) => sum + (here - meanX) * (there - meanY), 0) / spread : null;
  });
}
