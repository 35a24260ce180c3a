// SPDX-License-Identifier: BSD-3-Clause
// Which legends belong to the settings.
import type { Geometry } from "./bodies.ts";
import type { ColourBar, Swatches } from "./overlay.ts";
import { CONTACT_COLOURS, KIND_COLOURS, type Range } from "./palettes.ts";
import { QUANTITIES } from "./quantities.ts";
import type { ViewSettings } from "./settings.ts";

/** The lowest first. */
export function legendsOf(geometry: Geometry, settings: ViewSettings, range: Range | null, chainRange: Range): (ColourBar | Swatches)[] {
  const legends: (ColourBar | Swatches)[] = [];
  const mixed = geometry.rubberGrains > 0 && geometry.clumps > 0;
  if (settings.grains !== "hidden") {
    if (settings.colour === "kind") {
      const items = [
        ...(geometry.clumps > 0 && settings.gravel ? [{ text: "Gravel", colour: KIND_COLOURS.gravel }] : []),
        ...(geometry.rubberGrains > 0 && settings.rubber ? [{ text: "Rubber", colour: KIND_COLOURS.rubber }] : []),
      ];
      if (items.length > 0) legends.push({ title: "Grains", items });
    } else if (range) {
      const { name, unit, scale } = QUANTITIES[settings.colour];
      legends.push({ title: settings.colour === "strain" && mixed ? `${name} (gravel grey)` : name, unit, scale, range });
    }
  }
  if (settings.chains) {
    if (settings.chainColour === "force") legends.push({ title: "Contact force", unit: "N", scale: "plasma", range: chainRange });
    else {
      const names = ["Gravel–gravel", "Gravel–rubber", "Rubber–rubber"];
      const there = [geometry.clumps > 0, mixed, geometry.rubberGrains > 0];
      const items = names.map((text, k) => ({ text, colour: CONTACT_COLOURS[k]! })).filter((_, k) => there[k]);
      legends.push({ title: `Forces above ${settings.threshold.toFixed(1)} × mean`, items });
    }
  }
  return legends;
}
