// SPDX-License-Identifier: BSD-3-Clause
// What a reader has set (theme, sliders, open parts, scroll position), kept over the reloads of a page that follows a running test.

const KEY = `dem4grm:${location.pathname}`;
type Value = string | number | boolean;

// Browsers may forbid storage to pages opened from disk; the history entry of the page then keeps it over a reload.
function read(): Record<string, Value> {
  try {
    const stored = sessionStorage.getItem(KEY);
    if (stored) return JSON.parse(stored) as Record<string, Value>;
  } catch {
    // Falls through to the history entry.
  }
  const state = history.state as { dem4grm?: Record<string, Value> } | null;
  return state?.dem4grm ?? {};
}

const values = read();

export function setting<T extends Value>(name: string, otherwise: T): T {
  const value = values[name];
  return typeof value === typeof otherwise ? (value as T) : otherwise;
}

export function keep(name: string, value: Value): void {
  values[name] = value;
  try {
    sessionStorage.setItem(KEY, JSON.stringify(values));
  } catch {
    try {
      history.replaceState({ dem4grm: values }, "");
    } catch {
      // Without either the settings last until the reload only.
    }
  }
}
