// SPDX-License-Identifier: BSD-3-Clause
// What a viewer can choose.

export type Colour = "kind" | "displacement" | "rotation" | "stress" | "strain";
export type ChainColour = "contact" | "force";
/** Solid grains; a pale backdrop behind the force chains; none. */
export type Grains = "solid" | "pale" | "hidden";
export type Axis = "none" | "x" | "y" | "z";

export interface ViewSettings {
  state: number;
  colour: Colour;
  /** The range of colours covers all stored states, not only the one that is shown. */
  sameRange: boolean;
  grains: Grains;
  chainColour: ChainColour;
  /** Chains are shown above this multiple of the mean force. */
  threshold: number;
  cut: Axis;
  /** Where the cut is, as a share of the specimen from 0 to 1. */
  cutAt: number;
  /** Hides the other side of the cut: beyond it in place of before it (x and y), below it in place of above it (z). */
  cutOther: boolean;
  /** Leaves grains whole: those whose centre is on the hidden side are hidden. */
  cutWhole: boolean;
  gravel: boolean;
  rubber: boolean;
  chains: boolean;
  walls: boolean;
}

export const DEFAULTS: ViewSettings = {
  state: 0, colour: "kind", sameRange: false, grains: "solid", chainColour: "contact", threshold: 1, cut: "none", cutAt: 0.5, cutOther: false,
  cutWhole: false, gravel: true, rubber: true, chains: false, walls: true,
};
