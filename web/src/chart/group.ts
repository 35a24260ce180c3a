// SPDX-License-Identifier: BSD-3-Clause
// What charts have in common: which series are switched off, and where the cursor stands.
import { keep, setting } from "../settings.ts";

export class ChartGroup {
  private readonly hidden: Set<string>;
  private readonly onSeries: (() => void)[] = [];
  private readonly onCursor: ((x: number | null) => void)[] = [];

  /** With a name the switches are kept over a reload. */
  constructor(private readonly name = "") {
    this.hidden = new Set(name ? setting(`hidden:${name}`, "").split("\n").filter(Boolean) : []);
  }

  shows(series: string): boolean {
    return !this.hidden.has(series);
  }

  show(series: string, visible: boolean): void {
    if (visible) this.hidden.delete(series);
    else this.hidden.add(series);
    if (this.name) keep(`hidden:${this.name}`, [...this.hidden].join("\n"));
    for (const listener of this.onSeries) listener();
  }

  moveCursor(x: number | null): void {
    for (const listener of this.onCursor) listener(x);
  }

  listen(series: () => void, cursor?: (x: number | null) => void): void {
    this.onSeries.push(series);
    if (cursor) this.onCursor.push(cursor);
  }
}
