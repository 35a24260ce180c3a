// SPDX-License-Identifier: BSD-3-Clause
// The stored states of one test, decoded when they are asked for; a few are kept.
import type { View } from "../data.ts";
import { decodeGeometry, decodeState, type BodyState, type Geometry } from "./bodies.ts";
import { bodyDisplacement, bodyRotation } from "./rotation.ts";
import type { Colour } from "./settings.ts";

const KEPT_STATES = 5;

export class Specimen {
  private readonly states = new Map<number, Promise<BodyState>>();
  private readonly values = new Map<string, Float32Array>();

  private constructor(readonly view: View, readonly geometry: Geometry, private readonly first: BodyState) {}

  static async open(view: View): Promise<Specimen> {
    const geometry = await decodeGeometry(view);
    return new Specimen(view, geometry, await decodeState(view, geometry, 0));
  }

  /** The first state is always kept: displacements and rotations count from it. */
  async state(index: number): Promise<BodyState> {
    if (index === 0) return this.first;
    let state = this.states.get(index);
    this.states.delete(index);
    state ??= decodeState(this.view, this.geometry, index);
    this.states.set(index, state);
    const oldest = this.states.keys().next().value;
    if (this.states.size > KEPT_STATES && oldest !== undefined) this.states.delete(oldest);
    return state;
  }

  /** Of each body (bond strain: of each rubber grain), in the unit of QUANTITIES. */
  async quantity(colour: Exclude<Colour, "kind">, index: number): Promise<Float32Array> {
    const key = `${colour} ${index}`;
    let values = this.values.get(key);
    if (!values) {
      const state = await this.state(index);
      if (colour === "displacement") values = bodyDisplacement(this.first, state);
      else if (colour === "rotation") values = bodyRotation(this.geometry, this.first, state);
      else if (colour === "stress") values = state.stress;
      else values = state.strain.map((strain) => 100 * strain);
      this.values.set(key, values);
    }
    return values;
  }
}
