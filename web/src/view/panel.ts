// SPDX-License-Identifier: BSD-3-Clause
// The controls of the view: native elements with labels. They read and write the settings; what follows is the view's matter.
import { el, uniqueId } from "../dom.ts";
import type { Direction } from "./viewpoint.ts";
import type { ViewSettings } from "./settings.ts";

export interface PanelActions {
  /** A setting was changed by hand. */
  changed: (change: Partial<ViewSettings>) => void;
  look: (direction: Direction) => void;
  play: () => void;
  picture: () => void;
  film: () => void;
}

export interface PanelFacts {
  displacements_mm: number[];
  hasRubber: boolean;
  hasGravel: boolean;
  /** Why no film can be made; empty: it can. */
  noFilm: string;
}

interface Slider {
  row: HTMLElement;
  set: (value: number) => void;
}

export class Panel {
  readonly element: HTMLElement;
  private readonly update: ((settings: ViewSettings) => void)[] = [];
  private readonly playButton: HTMLButtonElement;
  private readonly pictureButton: HTMLButtonElement;
  private readonly filmButton: HTMLButtonElement;

  constructor(private readonly facts: PanelFacts, private readonly actions: PanelActions, settings: ViewSettings) {
    const button = (text: string, run: () => void) => el("button", { type: "button", onclick: run }, text);
    this.playButton = button("Play", actions.play);
    this.pictureButton = button("Save picture (PNG)", actions.picture);
    this.pictureButton.title = "Twice the size of the screen, on white paper, with legend and scale";
    this.filmButton = button("Save film (WebM)", actions.film);
    this.filmButton.disabled = facts.noFilm !== "";
    this.element = el(
      "div", { class: "view-panel" },
      this.stateGroup(), this.lookGroup(), this.grainGroup(), this.chainGroup(), this.cutGroup(), this.saveGroup(),
    );
    this.show(settings);
  }

  /** Brings the controls in line with the settings. */
  show(settings: ViewSettings): void {
    for (const update of this.update) update(settings);
  }

  setPlaying(playing: boolean): void {
    this.playButton.textContent = playing ? "Pause" : "Play";
  }

  /** While a picture or a film is made, no other can be ordered; `words` tell how far it is. */
  setBusy(busy: boolean, words: string): void {
    this.pictureButton.disabled = busy;
    this.filmButton.disabled = busy || this.facts.noFilm !== "";
    this.filmButton.textContent = busy && words ? words : "Save film (WebM)";
  }

  private slider(label: string, min: number, max: number, step: number, words: (value: number) => string, changed: (value: number) => void): Slider {
    const id = uniqueId("view");
    const output = el("output", { for: id });
    const input = el("input", { type: "range", id, min, max, step });
    const say = () => {
      output.textContent = words(Number(input.value));
      input.setAttribute("aria-valuetext", output.textContent);
    };
    input.addEventListener("input", () => {
      say();
      changed(Number(input.value));
    });
    const set = (value: number) => {
      input.value = String(value);
      say();
    };
    return { row: el("div", { class: "view-row" }, el("label", { for: id }, label), input, output), set };
  }

  private choice<K extends keyof ViewSettings>(label: string, key: K, options: [string, string][]): HTMLElement {
    const id = uniqueId("view");
    const select = el("select", { id }, ...options.map(([value, text]) => el("option", { value }, text)));
    select.addEventListener("change", () => this.actions.changed({ [key]: select.value } as Partial<ViewSettings>));
    this.update.push((settings) => (select.value = String(settings[key])));
    return el("div", { class: "view-row" }, el("label", { for: id }, label), select);
  }

  private box(label: string, key: keyof ViewSettings, enabled: (settings: ViewSettings) => boolean = () => true): HTMLElement {
    const input = el("input", { type: "checkbox" });
    input.addEventListener("change", () => this.actions.changed({ [key]: input.checked } as Partial<ViewSettings>));
    this.update.push((settings) => {
      input.checked = Boolean(settings[key]);
      input.disabled = !enabled(settings);
    });
    return el("label", { class: "view-box" }, input, label);
  }

  private group(title: string, ...rows: (HTMLElement | null)[]): HTMLElement {
    return el("fieldset", {}, el("legend", {}, title), ...rows);
  }

  private stateGroup(): HTMLElement {
    const places = this.facts.displacements_mm;
    if (places.length < 2) return this.group("State", el("p", {}, `One stored state, at ${(places[0] ?? 0).toFixed(2)} mm.`));
    const words = (k: number) => `${(places[k] ?? 0).toFixed(2)} mm`;
    const slider = this.slider("Displacement", 0, places.length - 1, 1, words, (state) => this.actions.changed({ state }));
    this.update.push((settings) => slider.set(settings.state));
    return this.group("State", slider.row, el("div", { class: "view-row" }, this.playButton));
  }

  private lookGroup(): HTMLElement {
    const button = (text: string, direction: Direction) => el("button", { type: "button", onclick: () => this.actions.look(direction) }, text);
    return this.group("Look from", el("div", { class: "view-row" }, button("Front", "front"), button("Top", "top"), button("Oblique", "oblique")));
  }

  private grainGroup(): HTMLElement {
    const colours: [string, string][] = [["kind", "Kind"], ["displacement", "Displacement"], ["rotation", "Rotation"], ["stress", "Mean stress"]];
    if (this.facts.hasRubber) colours.push(["strain", "Bond strain of rubber"]);
    const { hasGravel, hasRubber } = this.facts;
    return this.group(
      "Grains",
      this.choice("Colour", "colour", colours),
      this.choice("Draw", "grains", [["solid", "Solid"], ["pale", "Pale, behind the chains"], ["hidden", "Not at all"]]),
      el(
        "div", { class: "view-row" },
        hasGravel ? this.box("Gravel", "gravel") : null, hasRubber ? this.box("Rubber", "rubber") : null, this.box("Walls", "walls"),
      ),
      this.facts.displacements_mm.length > 1
        ? el("div", { class: "view-row" }, this.box("One colour range for all states", "sameRange", (settings) => settings.colour !== "kind"))
        : null,
    );
  }

  private chainGroup(): HTMLElement {
    const slider = this.slider("Above", 0, 5, 0.1, (value) => `${value.toFixed(1)} × mean`, (threshold) => this.actions.changed({ threshold }));
    this.update.push((settings) => slider.set(settings.threshold));
    return this.group(
      "Force chains",
      el("div", { class: "view-row" }, this.box("Show force chains", "chains")),
      slider.row,
      this.choice("Colour", "chainColour", [["contact", "Kind of contact"], ["force", "Force"]]),
    );
  }

  private cutGroup(): HTMLElement {
    const slider = this.slider("At", 0, 100, 1, (value) => `${value} %`, (value) => this.actions.changed({ cutAt: value / 100 }));
    this.update.push((settings) => slider.set(Math.round(100 * settings.cutAt)));
    this.update.push((settings) => ((slider.row.querySelector("input") as HTMLInputElement).disabled = settings.cut === "none"));
    const cuts = (settings: ViewSettings) => settings.cut !== "none";
    return this.group(
      "Cut",
      this.choice("Across", "cut", [["none", "No cut"], ["x", "x, along shear"], ["y", "y, across shear"], ["z", "z, height"]]),
      slider.row,
      el("div", { class: "view-row" }, this.box("Other side", "cutOther", cuts), this.box("Whole grains", "cutWhole", cuts)),
    );
  }

  private saveGroup(): HTMLElement {
    const reason = this.facts.noFilm === "" ? null : el("p", { class: "view-note", id: uniqueId("view") }, this.facts.noFilm);
    if (reason) this.filmButton.setAttribute("aria-describedby", reason.id);
    return this.group("Save", el("div", { class: "view-row" }, this.pictureButton, this.filmButton), reason);
  }
}
