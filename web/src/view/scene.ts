// SPDX-License-Identifier: BSD-3-Clause
// What is drawn for given settings: brings balls, chains, walls and the cut up to date, each only when it has to change.
import * as THREE from "three";
import { Balls } from "./balls.ts";
import type { BodyState } from "./bodies.ts";
import { chainRods, meanBranch, type ChainRods } from "./chains.ts";
import { rgb, robustRange, type Range, type Rgb } from "./palettes.ts";
import { joinRanges, kindColour, QUANTITIES, valueColour } from "./quantities.ts";
import { Rods } from "./rods.ts";
import type { Axis, Colour, ViewSettings } from "./settings.ts";
import type { Specimen } from "./specimen.ts";
import { wallCorners, Walls } from "./walls.ts";

const LOWER_HALF = rgb("#3d7fb5"), UPPER_HALF = rgb("#7d8590");
/** The side of a cut that is hidden: the one that is nearer to a viewer in front and to the left, and the upper one. */
const CUT_SIDE: Record<Exclude<Axis, "none">, number> = { x: -1, y: -1, z: 1 };
const NO_CHAINS: ChainRods = {
  count: 0, start: new Float32Array(0), end: new Float32Array(0), radius: new Float32Array(0), colour: new Uint8Array(0),
  range: { low: 0, high: 1, below: false, above: false },
};

function meanRadius(radius: Float32Array): number {
  return radius.reduce((sum, r) => sum + r, 0) / Math.max(1, radius.length);
}

function ballBox(state: BodyState, radius: Float32Array): THREE.Box3 {
  const box = new THREE.Box3(), { position } = state;
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let b = 0; b < radius.length; ++b) {
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis]!, position[3 * b + axis]! - radius[b]!);
      high[axis] = Math.max(high[axis]!, position[3 * b + axis]! + radius[b]!);
    }
  }
  if (radius.length === 0) return box.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
  return box.set(new THREE.Vector3(...low), new THREE.Vector3(...high));
}

export class SpecimenScene {
  readonly balls: Balls;
  readonly chains = new Rods();
  readonly walls = new Walls();
  state!: BodyState;
  rods = NO_CHAINS;
  /** Of the colours of the grains; null when they show the kind. */
  range: Range | null = null;
  /** Of the balls of the present state. */
  box = new THREE.Box3();
  branch_mm = 1;
  private readonly done = new Map<string, string>();

  constructor(readonly specimen: Specimen) {
    this.balls = new Balls(specimen.geometry);
  }

  async update(settings: ViewSettings): Promise<void> {
    const { geometry } = this.specimen;
    const state = await this.specimen.state(settings.state);
    const colour = settings.colour;
    const values = colour === "kind" ? null : await this.specimen.quantity(colour, settings.state);
    let range: Range | null = null;
    if (values && colour !== "kind") range = settings.sameRange ? await this.rangeOfAll(colour) : robustRange(values);
    this.state = state;
    this.range = range;
    this.once("place", [settings.state], () => {
      this.balls.place(state);
      this.box = ballBox(state, geometry.radius);
      this.branch_mm = state.contacts.count > 0 ? meanBranch(state) : 2 * meanRadius(geometry.radius);
      this.walls.set(state.walls, this.wallTop(), LOWER_HALF, UPPER_HALF);
    });
    this.once("paint", [colour, colour !== "kind" && settings.state, settings.sameRange], () => {
      if (values && range && colour !== "kind") this.balls.paint(valueColour(values, range, QUANTITIES[colour].scale));
      else this.balls.paint(kindColour(geometry));
    });
    const cut = [settings.cut, settings.cutAt, settings.cutOther, settings.state];
    const visible = this.cutSide(settings);
    const chosen = [settings.gravel, settings.rubber, settings.grains === "hidden", settings.cutWhole && cut.join()];
    this.once("choose", chosen, () => this.choose(settings, visible));
    this.once("chains", [settings.state, settings.chains, settings.threshold, settings.chainColour, ...cut], () => {
      this.rods = settings.chains ? chainRods(geometry, state, settings.threshold, settings.chainColour, visible) : NO_CHAINS;
      this.chains.set(this.rods.count, this.rods.start, this.rods.end, this.rods.radius, this.rods.colour, true);
    });
    this.walls.show(settings.walls);
  }

  /** Balls and walls of all states together, so that nothing leaves the picture during shear; not the wings, which hold no grains. */
  wholeBox(): THREE.Box3 {
    const box = this.box.clone();
    for (const { walls } of this.specimen.view.states) {
      const holding = walls.filter((wall) => !/wing/i.test(wall.name));
      for (const point of wallCorners(holding, this.wallTop()).flat()) box.expandByPoint(new THREE.Vector3(...point));
    }
    return box;
  }

  /** Of what the cut leaves. */
  visibleBox(settings: ViewSettings): THREE.Box3 {
    const box = this.box.clone();
    if (settings.cut === "none") return box;
    const { axis, sign, at } = this.cutPlane(settings.cut, settings);
    box[sign > 0 ? "max" : "min"][axis] = at;
    return box;
  }

  dispose(): void {
    this.balls.dispose();
    this.chains.dispose();
    this.walls.dispose();
  }

  private wallTop(): number {
    return this.box.max.z + 0.06 * (this.box.max.z - this.box.min.z);
  }

  private once(part: string, inputs: unknown[], work: () => void): void {
    const key = inputs.join(" ");
    if (this.done.get(part) === key) return;
    this.done.set(part, key);
    work();
  }

  /** Over all states, so that a colour means the same number in each of them. */
  private async rangeOfAll(colour: Exclude<Colour, "kind">): Promise<Range> {
    const ranges: Range[] = [];
    for (let k = 0; k < this.specimen.view.states.length; ++k) ranges.push(robustRange(await this.specimen.quantity(colour, k)));
    return joinRanges(ranges);
  }

  /** Points are hidden where `sign` times their coordinate is greater than `sign` times `at` (mm). */
  private cutPlane(axis: Exclude<Axis, "none">, settings: ViewSettings): { axis: Exclude<Axis, "none">; sign: number; at: number } {
    const low = this.box.min[axis], high = this.box.max[axis];
    return { axis, sign: CUT_SIDE[axis] * (settings.cutOther ? -1 : 1), at: low + settings.cutAt * (high - low) };
  }

  /** Sets the plane of the cut; tells of a point whether it stays visible. */
  private cutSide(settings: ViewSettings): (x: number, y: number, z: number) => boolean {
    const plane = this.balls.cut;
    if (settings.cut === "none") {
      plane.set(0, 0, 0, 1e9);
      return () => true;
    }
    const { axis, sign, at } = this.cutPlane(settings.cut, settings);
    const normal = { x: 0, y: 0, z: 0, [axis]: sign };
    const visible = (x: number, y: number, z: number) => normal.x * x + normal.y * y + normal.z * z <= sign * at;
    if (settings.cutWhole) plane.set(0, 0, 0, 1e9);
    else plane.set(normal.x, normal.y, normal.z, sign * at);
    return visible;
  }

  private choose(settings: ViewSettings, visible: (x: number, y: number, z: number) => boolean): void {
    const { rubberGrains } = this.specimen.geometry, { centre } = this.state;
    if (settings.grains === "hidden") return this.balls.choose(() => false);
    this.balls.choose((body) => {
      if (!(body < rubberGrains ? settings.rubber : settings.gravel)) return false;
      return !settings.cutWhole || visible(centre[3 * body]!, centre[3 * body + 1]!, centre[3 * body + 2]!);
    });
  }
}

/** Programs of the view work with the numbers of the screen, so none is converted as three would. */
export function asColour([r, g, b]: Rgb): THREE.Color {
  const colour = new THREE.Color();
  colour.r = r / 255;
  colour.g = g / 255;
  colour.b = b / 255;
  return colour;
}
