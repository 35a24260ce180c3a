// SPDX-License-Identifier: BSD-3-Clause
// Round rods between points: the force chains and the edges of the walls.
import * as THREE from "three";
import { ROD_FRAGMENT, ROD_VERTEX } from "./shaders.ts";

export class Rods {
  readonly mesh: THREE.Mesh;
  readonly uniforms = {
    leastRadius: { value: 0 }, paper: { value: new THREE.Color() }, fog: { value: 0 },
    fogRange: { value: new THREE.Vector2(0, 1) }, opacity: { value: 1 },
  };
  private readonly material: THREE.RawShaderMaterial;
  private strip = new THREE.InstancedBufferGeometry();

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
    const strip = (this.strip = new THREE.InstancedBufferGeometry());
    strip.setAttribute("corner", new THREE.BufferAttribute(new Float32Array([0, -1, 1, -1, 1, 1, 0, 1]), 2));
    strip.setIndex([0, 1, 2, 0, 2, 3]);
    strip.setAttribute("start", new THREE.InstancedBufferAttribute(start, 3));
    strip.setAttribute("end", new THREE.InstancedBufferAttribute(end, 3));
    strip.setAttribute("radius", new THREE.InstancedBufferAttribute(radius, 1));
    const tint = new Uint8Array(4 * count);
    for (let k = 0; k < count; ++k) {
      for (let c = 0; c < 3; ++c) tint[4 * k + c] = colour[3 * k + c]!;
      tint[4 * k + 3] = lit ? 255 : 0;
    }
    strip.setAttribute("tint", new THREE.InstancedBufferAttribute(tint, 4, true));
    strip.instanceCount = count;
    this.mesh.geometry = strip;
    this.mesh.visible = count > 0;
  }

  dispose(): void {
    this.strip.dispose();
    this.material.dispose();
  }
}
