// SPDX-License-Identifier: BSD-3-Clause
// The box: walls as translucent parallelograms with edges, the two halves in two tints.
import * as THREE from "three";
import type { ViewState } from "../data.ts";
import type { Rgb } from "./palettes.ts";
import { Rods } from "./rods.ts";
import { WALL_FRAGMENT, WALL_VERTEX } from "./shaders.ts";

type Wall = ViewState["walls"][number];
type Point = [number, number, number];

/** Walls of the lower half and the bottom plate move; everything that is not named so counts as the upper half. */
export function isLower(wall: Wall): boolean {
  return /lower|bottom|base/i.test(wall.name);
}

/** Upright edges of the box end a little above the specimen: the walls of a shear box are much higher than what is in it. */
function trimmed(edge: Point, corner: Point, top: number): Point {
  const upright = Math.abs(edge[2]) > 0.99 * Math.hypot(...edge);
  if (!upright || corner[2] + edge[2] <= top || corner[2] >= top) return edge;
  const share = (top - corner[2]) / edge[2];
  return [edge[0] * share, edge[1] * share, edge[2] * share];
}

/** The four corners of each wall, in order around it. */
export function wallCorners(walls: Wall[], top: number): Point[][] {
  return walls.map((wall) => {
    const c = wall.corner_mm, u = trimmed(wall.u_mm, c, top), v = trimmed(wall.v_mm, c, top);
    const at = (s: number, t: number): Point => [c[0] + s * u[0] + t * v[0], c[1] + s * u[1] + t * v[1], c[2] + s * u[2] + t * v[2]];
    return [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
  });
}

export class Walls {
  readonly faces: THREE.Mesh;
  readonly edges = new Rods();
  private readonly material: THREE.RawShaderMaterial;

  constructor() {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: WALL_VERTEX, fragmentShader: WALL_FRAGMENT, side: THREE.DoubleSide,
      transparent: true, depthWrite: false,
    });
    this.faces = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.faces.frustumCulled = false;
  }

  set(walls: Wall[], top: number, lower: Rgb, upper: Rgb): void {
    const corners = wallCorners(walls, top);
    const place = new Float32Array(12 * walls.length), tint = new Float32Array(16 * walls.length);
    const start = new Float32Array(12 * walls.length), end = new Float32Array(12 * walls.length);
    const colour = new Uint8Array(12 * walls.length), index: number[] = [];
    corners.forEach((around, w) => {
      const shade = isLower(walls[w]!) ? lower : upper;
      around.forEach((point, k) => {
        place.set(point, 12 * w + 3 * k);
        tint.set([shade[0] / 255, shade[1] / 255, shade[2] / 255, 0.07], 16 * w + 4 * k);
        start.set(point, 12 * w + 3 * k);
        end.set(around[(k + 1) % 4]!, 12 * w + 3 * k);
        colour.set(shade.map(Math.round), 12 * w + 3 * k);
      });
      index.push(4 * w, 4 * w + 1, 4 * w + 2, 4 * w, 4 * w + 2, 4 * w + 3);
    });
    this.faces.geometry.dispose();
    this.faces.geometry = new THREE.BufferGeometry();
    this.faces.geometry.setAttribute("position", new THREE.BufferAttribute(place, 3));
    this.faces.geometry.setAttribute("tint", new THREE.BufferAttribute(tint, 4));
    this.faces.geometry.setIndex(index);
    this.edges.set(4 * walls.length, start, end, new Float32Array(4 * walls.length), colour, false);
  }

  show(visible: boolean): void {
    this.faces.visible = visible;
    this.edges.mesh.visible = visible;
  }

  dispose(): void {
    this.faces.geometry.dispose();
    this.material.dispose();
    this.edges.dispose();
  }
}
