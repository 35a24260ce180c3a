// SPDX-License-Identifier: BSD-3-Clause
// Round rods between points: the force chains and the edges of the walls.
import * as THREE from "three";
import { ROD_FRAGMENT, ROD_VERTEX } from "./shaders.ts";

/** Of a strip: along, across. */
const CORNERS = [[0, -1], [1, -1], [1, 1], [0, 1]];

export class Rods {
  readonly mesh: THREE.Mesh;
  readonly uniforms = {
    leastRadius: { value: 0 }, paper: { value: new THREE.Color() }, fog: { value: 0 },
    fogRange: { value: new THREE.Vector2(0, 1) }, opacity: { value: 1 },
  };
  private readonly material: THREE.RawShaderMaterial;
  private strip = new THREE.BufferGeometry();

  constructor() {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: ROD_VERTEX, fragmentShader: ROD_FRAGMENT, uniforms: this.uniforms,
      side: THREE.DoubleSide, blending: THREE.NoBlending,
    });
    this.mesh = new THREE.Mesh(this.strip, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** Each rod: start and end (mm), radius (mm), colour (0 to 255); `lit` shades it as a round body. */
  set(count: number, start: Float32Array, end: Float32Array, radius: Float32Array, colour: Uint8Array, lit: boolean): void {
    this.strip.dispose();
    const strip = (this.strip = new THREE.BufferGeometry());
    const corner = new Float32Array(8 * count), from = new Float32Array(12 * count), to = new Float32Array(12 * count);
    const thick = new Float32Array(4 * count), tint = new Uint8Array(16 * count), index = new Uint32Array(6 * count);
    for (let k = 0; k < count; ++k) {
      for (let c = 0; c < 4; ++c) {
        const v = 4 * k + c;
        corner.set(CORNERS[c]!, 2 * v);
        from.set(start.subarray(3 * k, 3 * k + 3), 3 * v);
        to.set(end.subarray(3 * k, 3 * k + 3), 3 * v);
        thick[v] = radius[k]!;
        tint.set(colour.subarray(3 * k, 3 * k + 3), 4 * v);
        tint[4 * v + 3] = lit ? 255 : 0;
      }
      index.set([4 * k, 4 * k + 1, 4 * k + 2, 4 * k, 4 * k + 2, 4 * k + 3], 6 * k);
    }
    strip.setAttribute("corner", new THREE.BufferAttribute(corner, 2));
    strip.setAttribute("start", new THREE.BufferAttribute(from, 3));
    strip.setAttribute("end", new THREE.BufferAttribute(to, 3));
    strip.setAttribute("radius", new THREE.BufferAttribute(thick, 1));
    strip.setAttribute("tint", new THREE.BufferAttribute(tint, 4, true));
    strip.setIndex(new THREE.BufferAttribute(index, 1));
    this.mesh.geometry = strip;
    this.mesh.visible = count > 0;
  }

  dispose(): void {
    this.strip.dispose();
    this.material.dispose();
  }
}
