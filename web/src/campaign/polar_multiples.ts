// SPDX-License-Identifier: BSD-3-Clause
// Polar histograms of all tests at the peak side by side: one column for each mixture, one row for each normal stress.
import type { HistogramSet } from "../data.ts";
import { el } from "../dom.ts";
import { emptyFigure, figure } from "../chart/figure.ts";
import { polarPanel } from "../chart/polar_panel.ts";
import { choice } from "../controls.ts";
import { formatNumber, withUnit } from "../numbers.ts";
import { limitOf, panelOf, QUANTITIES, QUANTITY_NAMES, type Quantity, SET_NAMES, stateAtPeak } from "../sections/polar.ts";
import type { Member, Members } from "./members.ts";

interface Shown {
  member: Member;
  set: HistogramSet;
  state: number;
  place: number;
  displacement: number;
}

function shown(members: Member[], name: string): Shown[] {
  return members.flatMap((member) => {
    const state = stateAtPeak(member.test);
    const here = member.test.histograms[state];
    const place = here?.sets.findIndex((one) => one.set === name) ?? -1;
    const set = here?.sets[place];
    return here && set && set.contacts > 0 ? [{ member, set, state, place, displacement: here.displacement_mm }] : [];
  });
}

export function polarMultiples({ members, mixtures, stresses }: Members): HTMLElement {
  const title = "Polar histograms at the peak";
  if (shown(members, "all").length === 0) return emptyFigure(title, "No state of these tests is stored.");
  const picture = el("div", { class: "panels multiples" });
  picture.style.setProperty("--columns", String(Math.max(2, mixtures.length)));
  let quantity: Quantity = "density";
  let chosen = "";
  const draw = () => {
    const all = shown(members, chosen);
    const ordered = [...all].sort((one, other) => one.member.stress - other.member.stress || one.member.mixture - other.member.mixture);
    picture.replaceChildren(...ordered.map(({ member, set, displacement }) => {
      const name = [mixtures[member.mixture]?.name, stresses[member.stress]?.name].filter(Boolean).join(", ");
      // Forces grow with the normal stress: panels of one stress have one scale.
      const peers = quantity === "density" ? all : all.filter((one) => one.member.stress === member.stress);
      const limit = limitOf(peers.map((one) => one.set), quantity);
      const description = `${QUANTITIES[quantity].title} of ${name} at ${withUnit(formatNumber(displacement, 3), "mm")}, ${formatNumber(set.contacts)} contacts`;
      return polarPanel(panelOf(set, quantity, limit, name, description));
    }));
  };
  const controls = el("div", { class: "controls" },
    choice("multiples-quantity", "Quantity", QUANTITY_NAMES.map((name) => [name, QUANTITIES[name].title]), (name) => {
      quantity = name as Quantity;
      draw();
    }),
    choice("multiples-set", "Contacts", Object.entries(SET_NAMES).filter(([name]) => shown(members, name).length > 0), (name) => {
      chosen = name;
      draw();
    }));
  const element = figure({
    title, picture, wide: true,
    caption: ["Stored state nearest to the peak. Panels of one normal stress share their scale; 1/rad or N. Line: fitted curve; shaded: curves whose amplitude and direction lie in their 95 % bands."],
    table: () => ({
      columns: ["Test", "Displacement (mm)", "Angle (°)", `${QUANTITIES[quantity].title} (${QUANTITIES[quantity].unit})`, "fit"],
      rows: shown(members, chosen).flatMap(({ member, set, state, place, displacement }) => set.angle_deg.map((angle, row) => {
        const at = `histograms.${state}.sets.${place}`;
        return [
          { value: member.test.name }, { value: displacement }, { value: angle },
          { value: set[quantity][row] ?? null, source: `${at}.${quantity}.${row}`, test: member.test.name },
          { value: set.fit[quantity][row] ?? null, source: `${at}.fit.${quantity}.${row}`, test: member.test.name },
        ];
      })),
    }),
  });
  picture.before(controls);
  return element;
}
