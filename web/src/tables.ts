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
