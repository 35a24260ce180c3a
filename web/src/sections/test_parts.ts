// SPDX-License-Identifier: BSD-3-Clause
// All that the page has to say of one test, in the order in which it is read.
import type { PageData, Test } from "../data.ts";
import { el } from "../dom.ts";
import { ChartGroup } from "../chart/group.ts";
import { rowsOf } from "../tables.ts";
import { compressionCharts } from "./compression.ts";
import { networkCharts, rubberCharts } from "./network.ts";
import { overview } from "./overview.ts";
import { charts, type Part } from "./part.ts";
import { polarFigure } from "./polar.ts";
import { profileCharts } from "./profiles.ts";
import { inputs, provenance } from "./provenance.ts";
import { qualityPanel } from "./quality.ts";
import { energyChart, equilibriumChart, shearCharts } from "./shear_curves.ts";
import { sieveChart, wallCharts } from "./specimen.ts";
import { viewSection } from "./view_section.ts";

function directShear(test: Test, data: PageData, id: (name: string) => string): Part[] {
  // Charts over the displacement share the cursor.
  const shear = new ChartGroup(`shear:${test.name}`);
  const rubber = rubberCharts(test, shear);
  return [
    { id: id("curves"), title: "Stress and volume change", short: "Stress", body: [charts(...shearCharts(test, data.laboratory, shear))] },
    { id: id("network"), title: "Contact network", short: "Network", body: [charts(...networkCharts(test, shear), polarFigure(test))] },
    { id: id("rubber"), title: "Rubber strain", short: "Rubber", body: rubber ? [charts(...rubber)] : [el("p", {}, rowsOf(test.tables.micro) > 0 ? "The specimen holds no rubber." : "There are no rows of micro.csv yet.")] },
    { id: id("profiles"), title: "Profiles over the height", short: "Profiles", body: profileCharts(test) },
    { id: id("specimen"), title: "Grading and walls", short: "Grading", body: [charts(sieveChart(test), ...wallCharts(test, shear))] },
    { id: id("quality"), title: "Quality", body: [...qualityPanel(test), charts(energyChart(test, shear), equilibriumChart(test, shear))] },
  ];
}

/** `prefix` keeps the ids of several tests apart. */
export function testParts(test: Test, data: PageData, prefix: string): Part[] {
  const id = (name: string) => (prefix ? `${prefix}-${name}` : name);
  const middle: Record<Test["kind"], () => Part[]> = {
    direct_shear: () => directShear(test, data, id),
    grain_compression: () => [
      { id: id("curves"), title: "Load and stiffness", short: "Load", body: [charts(...compressionCharts(test))] },
      { id: id("quality"), title: "Quality", body: qualityPanel(test) },
    ],
    specimen: () => [
      { id: id("specimen"), title: "Grading", body: [charts(sieveChart(test))] },
      { id: id("quality"), title: "Quality", body: qualityPanel(test) },
    ],
  };
  const view: Part[] = test.kind === "grain_compression" && !test.view ? [] : [{ id: id("view"), title: "Specimen", body: [viewSection(test)] }];
  return [
    { id: id("results"), title: "Results", body: overview(test) },
    ...view,
    ...middle[test.kind](),
    { id: id("inputs"), title: "Inputs", body: inputs(test) },
    { id: id("provenance"), title: "Provenance", body: provenance(test) },
  ];
}
