// SPDX-License-Identifier: BSD-3-Clause
// The view of a specimen: balls, force chains and walls of the stored states, with controls, legend and exports.
import * as THREE from "three";
import type { View } from "../data.ts";
import { el } from "../dom.ts";
import { drawOverlay, type Overlay } from "./overlay.ts";
import { legendsOf } from "./legend.ts";
import { Painter } from "./painter.ts";
import { css } from "./palettes.ts";
import { Panel } from "./panel.ts";
import { Pipeline, type Look } from "./pipeline.ts";
import { recordFilm, save, savePicture, whyNoFilm } from "./save.ts";
import { asColour, SpecimenScene } from "./scene.ts";
import { DEFAULTS, type Axis, type Colour, type ViewSettings } from "./settings.ts";
import { Specimen } from "./specimen.ts";
import { themeOf, watchTheme, WHITE_PAPER, type Theme } from "./theme.ts";
import { Viewpoint, type Direction } from "./viewpoint.ts";
import { describe, describeBody } from "./words.ts";
import "./view.css";

export interface ViewHandle {
  readonly canvas: HTMLCanvasElement;
  readonly settings: Readonly<ViewSettings>;
  /** All of these resolve when the new picture is on the canvas. */
  setState(index: number): Promise<void>;
  setColour(colour: Colour): Promise<void>;
  /** Shows the force chains above this multiple of the mean force. */
  setThreshold(multiple: number): Promise<void>;
  /** `at`: from 0 to 1 through the specimen. */
  setCut(axis: Axis, at?: number): Promise<void>;
  set(change: Partial<ViewSettings>): Promise<void>;
  look(direction: Direction): Promise<void>;
  /** Resolves when the picture is as smooth as it gets. */
  render(): Promise<void>;
  stats(): { balls: number; firstPaintMilliseconds: number; drawMilliseconds: number; renderer: string };
  dispose(): void;
}

const TOO_OLD =
  "The view of the specimen needs WebGL 2, which this browser or its settings do not offer; all numbers of the page are there without it.";
const HINT =
  "Drag to turn, right button or two fingers to shift; click first for the wheel. Keys: arrows, + and −. A click names the grain.";
const PLAY_MILLISECONDS = 700;
const GHOST = { solid: 0, pale: 0.76, hidden: 1 };

function rendererName(gl: WebGL2RenderingContext): string {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

class SpecimenView implements ViewHandle {
  readonly canvas: HTMLCanvasElement;
  readonly settings: ViewSettings = { ...DEFAULTS };
  private readonly root: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly overlayCanvas = el("canvas", { class: "view-overlay", "aria-hidden": "true" });
  private readonly live = el("p", { class: "view-words", "aria-live": "polite" });
  private readonly scene: SpecimenScene;
  private readonly pipeline: Pipeline;
  private readonly painter: Painter;
  private readonly viewpoint: Viewpoint;
  private readonly panel: Panel;
  private readonly sizes: ResizeObserver;
  private readonly stopTheme: () => void;
  private readonly slow: boolean;
  private readonly rendererName: string;
  private theme: Theme = WHITE_PAPER;
  private updating: Promise<void> = Promise.resolve();
  private playing = 0;
  private printing = false;
  private firstPaint = 0;
  private pressedAt = [0, 0];

  constructor(
    container: HTMLElement, private readonly specimen: Specimen, private readonly name: string, private readonly renderer: THREE.WebGLRenderer,
    private readonly started: number,
  ) {
    this.canvas = renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    const gl = renderer.getContext() as WebGL2RenderingContext;
    this.rendererName = rendererName(gl);
    this.slow = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(this.rendererName);
    this.scene = new SpecimenScene(specimen);
    this.pipeline = new Pipeline(renderer, this.scene.balls, this.scene.chains, this.scene.walls);
    this.viewpoint = new Viewpoint(this.canvas, (moving) => this.painter?.request(moving));
    this.painter = new Painter({
      canvas: this.canvas, gl, pipeline: this.pipeline, camera: this.viewpoint.camera, slow: this.slow,
      look: () => this.lookFor(this.theme, this.pixelRatio), painted: () => this.drawScreenOverlay(),
    });
    const { geometry, view } = specimen;
    this.panel = new Panel({
      displacements_mm: view.states.map((state) => state.displacement_mm), hasRubber: geometry.rubberGrains > 0, hasGravel: geometry.clumps > 0,
      noFilm: whyNoFilm(view.states.length),
    }, {
      changed: (change) => void this.set(change), look: (direction) => void this.look(direction), play: () => this.togglePlay(),
      picture: () => void this.busy("", () => this.savePicture()), film: () => void this.busy("Recording", () => this.saveFilm()),
    }, this.settings);
    const hint = el("p", { class: "view-note" }, HINT);
    this.stage = el("div", { class: "view-stage" }, this.canvas, this.overlayCanvas);
    this.root = el("div", { class: "view-root" }, el("div", { class: "view-main" }, this.stage, this.live, hint), this.panel.element);
    container.append(this.root);
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.stage);
    this.stopTheme = watchTheme(() => this.readTheme());
    this.canvas.addEventListener("pointerdown", (event) => (this.pressedAt = [event.clientX, event.clientY]));
    this.canvas.addEventListener("click", (event) => void this.nameGrain(event));
    this.canvas.addEventListener("webglcontextrestored", () => this.painter.request(false));
    addEventListener("beforeprint", this.print);
    addEventListener("afterprint", this.printed);
  }

  async begin(): Promise<void> {
    await this.scene.update(this.settings);
    this.readTheme();
    this.say();
    this.resize();
    this.viewpoint.look("oblique", this.scene.wholeBox());
    await this.painter.first(true);
    this.firstPaint = performance.now() - this.started;
  }

  set(change: Partial<ViewSettings>): Promise<void> {
    Object.assign(this.settings, change);
    // Solid grains hide the chains inside the specimen: who asks for chains sees them.
    if (change.chains === true && this.settings.grains === "solid" && change.grains === undefined) this.settings.grains = "pale";
    if (change.chains === false && this.settings.grains === "pale") this.settings.grains = "solid";
    this.panel.show(this.settings);
    const sliding = change.threshold !== undefined || change.cutAt !== undefined;
    // Sliders give many changes while one state is decoded: each update takes the settings as they are when it begins.
    this.updating = this.updating.then(() => this.scene.update(this.settings)).then(() => {
      this.say();
      this.painter.request(sliding);
    });
    return this.updating.then(() => this.painter.first());
  }

  setState(index: number): Promise<void> {
    return this.set({ state: Math.min(this.specimen.view.states.length - 1, Math.max(0, Math.round(index))) });
  }

  setColour(colour: Colour): Promise<void> {
    return this.set({ colour });
  }

  setThreshold(multiple: number): Promise<void> {
    return this.set({ threshold: multiple, chains: true });
  }

  setCut(axis: Axis, at = this.settings.cutAt): Promise<void> {
    return this.set({ cut: axis, cutAt: Math.min(1, Math.max(0, at)) });
  }

  async look(direction: Direction): Promise<void> {
    this.viewpoint.look(direction, this.scene.wholeBox());
    await this.painter.first();
  }

  async render(): Promise<void> {
    await this.updating;
    await this.painter.finished();
  }

  stats() {
    return {
      balls: this.specimen.geometry.balls, firstPaintMilliseconds: this.firstPaint, drawMilliseconds: this.painter.drawMilliseconds,
      renderer: this.rendererName,
    };
  }

  dispose(): void {
    clearTimeout(this.playing);
    this.sizes.disconnect();
    this.stopTheme();
    removeEventListener("beforeprint", this.print);
    removeEventListener("afterprint", this.printed);
    this.painter.dispose();
    this.viewpoint.dispose();
    this.scene.dispose();
    this.pipeline.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.root.remove();
  }

  private get pixelRatio(): number {
    return this.slow ? 1 : Math.min(2, devicePixelRatio);
  }

  private lookFor(theme: Theme, pixelRatio: number): Look {
    const { grains, colour } = this.settings;
    return {
      paper: asColour(theme.paper), ghost: GHOST[grains], plain: colour === "kind" ? 0 : 1,
      fog: grains === "solid" ? 0 : 0.6, depths_mm: this.viewpoint.depths(this.scene.visibleBox(this.settings)),
      reachOfShade_mm: 1.1 * this.scene.branch_mm, shadeSamples: this.slow ? 8 : 12, pixelRatio,
    };
  }

  private overlay(theme: Theme, pixelsPerMillimetre: number): Overlay {
    return {
      caption: `${this.name}, ${this.scene.state.displacement_mm.toFixed(2)} mm`,
      legends: legendsOf(this.specimen.geometry, this.settings, this.scene.range, this.scene.rods.range),
      pixelsPerMillimetre, camera: this.viewpoint.camera, ink: css(theme.ink), paper: css(theme.paper),
    };
  }

  private readonly readTheme = (): void => {
    this.theme = themeOf(this.stage);
    this.painter.request(false);
  };

  private readonly print = (): void => {
    this.printing = true;
    this.theme = WHITE_PAPER;
    this.painter.paintNow();
    this.drawScreenOverlay();
  };

  private readonly printed = (): void => {
    this.printing = false;
    this.readTheme();
    this.resize();
  };

  private resize(): void {
    if (this.printing) return;
    const width = Math.max(1, this.stage.clientWidth), height = Math.max(1, this.stage.clientHeight);
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    const ratio = Math.min(2, Math.max(1, devicePixelRatio));
    this.overlayCanvas.width = Math.round(width * ratio);
    this.overlayCanvas.height = Math.round(height * ratio);
    this.viewpoint.resize(width / height);
  }

  private drawScreenOverlay(): void {
    const context = this.overlayCanvas.getContext("2d");
    if (!context || !this.scene.state) return;
    const width = this.stage.clientWidth, height = this.stage.clientHeight;
    context.setTransform(this.overlayCanvas.width / width, 0, 0, this.overlayCanvas.height / height, 0, 0);
    context.clearRect(0, 0, width, height);
    // Printers do not see what the graphics processor drew last.
    if (this.printing) context.drawImage(this.canvas, 0, 0, width, height);
    drawOverlay(context, width, height, this.overlay(this.theme, this.viewpoint.pixelsPerMillimetre));
  }

  private say(): void {
    const words = describe(this.specimen.geometry, this.scene.state, this.settings, this.scene.range, this.scene.rods.count);
    this.live.textContent = words;
    this.canvas.setAttribute("aria-label", `Specimen of ${this.name} in space. ${words}`);
  }

  private async nameGrain(event: MouseEvent): Promise<void> {
    if (Math.hypot(event.clientX - this.pressedAt[0]!, event.clientY - this.pressedAt[1]!) > 4) return;
    await this.painter.sharp();
    const scale = this.canvas.width / this.canvas.clientWidth;
    const ball = this.pipeline.ballAt(Math.floor(event.offsetX * scale), Math.floor(event.offsetY * scale));
    if (ball < 0) return this.say();
    const k = this.settings.state, quantity = (colour: Exclude<Colour, "kind">) => this.specimen.quantity(colour, k);
    const [displacement, rotation, stress, strain] = await Promise.all([
      quantity("displacement"), quantity("rotation"), quantity("stress"), quantity("strain"),
    ]);
    this.live.textContent = describeBody(this.specimen.geometry, this.specimen.geometry.body[ball]!, { displacement, rotation, stress, strain });
  }

  private togglePlay(): void {
    if (this.playing !== 0) return this.stopPlaying();
    const last = this.specimen.view.states.length - 1;
    const step = async () => {
      await this.setState(this.settings.state >= last ? 0 : this.settings.state + 1);
      if (this.playing === 0) return;
      if (this.settings.state >= last) this.stopPlaying();
      else this.playing = window.setTimeout(step, PLAY_MILLISECONDS);
    };
    this.panel.setPlaying(true);
    this.playing = window.setTimeout(step, 0);
  }

  private stopPlaying(): void {
    clearTimeout(this.playing);
    this.playing = 0;
    this.panel.setPlaying(false);
  }

  private async busy(words: string, work: () => Promise<void>): Promise<void> {
    this.stopPlaying();
    this.panel.setBusy(true, words);
    try {
      await work();
    } catch (error) {
      this.live.textContent = `Not saved: ${error instanceof Error ? error.message : String(error)}`;
    } finally {
      this.panel.setBusy(false, "");
    }
  }

  /** Picture of the present settings, `scale` times as many pixels as the page shows, with legend and caption. */
  private async compose(scale: number, theme: Theme): Promise<HTMLCanvasElement> {
    const width = this.stage.clientWidth, height = this.stage.clientHeight;
    const samples = !this.pipeline.canAverage ? 1 : this.slow ? 4 : 16;
    const image = await this.painter.hold(async () => {
      this.pipeline.resize(Math.round(width * scale), Math.round(height * scale));
      for (let k = 0; k < samples; ++k) {
        this.pipeline.draw(this.viewpoint.camera, this.lookFor(theme, scale), k, samples === 1);
        await new Promise((resolve) => setTimeout(resolve));
      }
      return this.pipeline.read();
    });
    const canvas = el("canvas", { width: image.width, height: image.height });
    const context = canvas.getContext("2d")!;
    context.putImageData(image, 0, 0);
    context.setTransform(scale, 0, 0, scale, 0, 0);
    drawOverlay(context, width, height, this.overlay(theme, this.viewpoint.pixelsPerMillimetre));
    return canvas;
  }

  private fileName(ending: string): string {
    return `${this.name.replace(/[^A-Za-z0-9._-]+/g, "-")}-${ending}`;
  }

  private async savePicture(): Promise<void> {
    await this.updating;
    await savePicture(await this.compose(2, WHITE_PAPER), this.fileName(`${this.scene.state.displacement_mm.toFixed(2)}mm.png`));
  }

  private async saveFilm(): Promise<void> {
    const before = { state: this.settings.state, sameRange: this.settings.sameRange };
    const states = this.specimen.view.states.length;
    try {
      const film = await recordFilm(states, async (index) => {
        this.panel.setBusy(true, `Recording ${index + 1} of ${states}`);
        // In a film a colour must mean the same number from beginning to end.
        await this.set({ state: index, sameRange: true });
        return this.compose(this.pixelRatio, this.theme);
      });
      save(film, this.fileName("shear.webm"));
    } finally {
      await this.set(before);
    }
  }
}

/** Puts the view into `container`; the promise is fulfilled with the first picture. Where nothing can be shown a sentence says why
 * in its place, and the promise is fulfilled with null. */
export async function createSpecimenView(container: HTMLElement, view: View, name: string): Promise<ViewHandle | null> {
  const started = performance.now();
  const instead = (words: string) => {
    container.append(el("p", { class: "view-missing", role: "note" }, words));
    return null;
  };
  if (view.states.length === 0) return instead("No state of the specimen is stored yet.");
  // Numbers are unpacked while the browser starts its graphics.
  const opening = typeof DecompressionStream === "undefined" ? null : Specimen.open(view);
  opening?.catch(() => {});
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl2", {
    antialias: false, depth: false, alpha: false, preserveDrawingBuffer: true, powerPreference: "high-performance",
  });
  if (!gl || !opening) return instead(TOO_OLD);
  try {
    const specimen = await opening;
    const renderer = new THREE.WebGLRenderer({ canvas, context: gl });
    // Asking for errors of the programs, which the tests would show, makes the first picture wait for each of them in turn.
    renderer.debug.checkShaderErrors = false;
    const made = new SpecimenView(container, specimen, name, renderer, started);
    await made.begin();
    return made;
  } catch (error) {
    return instead(`The specimen cannot be shown: ${error instanceof Error ? error.message : String(error)}`);
  }
}
