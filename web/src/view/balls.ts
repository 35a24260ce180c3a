// SPDX-License-Identifier: BSD-3-Clause
// Balls on the graphics processor: places and colours in textures, one triangle around the disc of each ball that is shown.
//
// Corner c of ball b is index 3 b + c, and the program takes both from there. Instances would be the usual way, but are slow for
// such small pieces: software rendering took ten to forty times as long.
import * as THREE from "three";
import type { BodyState, Geometry } from "./bodies.ts";
import { BALL_FRAGMENT, BALL_VERTEX } from "./shaders.ts";

/** The programs take it from the lowest 9 bits of the number of a ball. */
const TEXTURE_WIDTH = 512;

function texture(balls: number, data: Float32Array | Uint8Array, type: THREE.TextureDataType): THREE.DataTexture {
  const rows = Math.max(1, Math.ceil(balls / TEXTURE_WIDTH));
  const made = new THREE.DataTexture(data, TEXTURE_WIDTH, rows, THREE.RGBAFormat, type);
  made.minFilter = made.magFilter = THREE.NearestFilter;
  made.generateMipmaps = false;
  return made;
}

export class Balls {
  readonly scene = new THREE.Scene();
  readonly places: THREE.DataTexture;
  readonly colours: THREE.DataTexture;
  readonly cut = new THREE.Vector4(0, 0, 0, 1e9);
  readonly cutInView = new THREE.Vector3();
  /** Of the balls that are shown. */
  count = 0;
  private readonly triangles = new THREE.BufferGeometry();
  private readonly corners: THREE.BufferAttribute;
  private readonly material: THREE.RawShaderMaterial;

  constructor(private readonly geometry: Geometry) {
    const texels = TEXTURE_WIDTH * Math.max(1, Math.ceil(geometry.balls / TEXTURE_WIDTH));
    const places = new Float32Array(4 * texels);
    for (let b = 0; b < geometry.balls; ++b) places[4 * b + 3] = geometry.radius[b]!;
    this.places = texture(geometry.balls, places, THREE.FloatType);
    this.colours = texture(geometry.balls, new Uint8Array(4 * texels), THREE.UnsignedByteType);
    this.corners = new THREE.BufferAttribute(new Uint32Array(Math.max(3, 3 * geometry.balls)), 1);
    this.corners.setUsage(THREE.DynamicDrawUsage);
    this.triangles.setIndex(this.corners);
    this.triangles.setDrawRange(0, 0);
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, vertexShader: BALL_VERTEX, fragmentShader: BALL_FRAGMENT, blending: THREE.NoBlending,
      uniforms: { balls: { value: this.places }, cut: { value: this.cut }, cutInView: { value: this.cutInView } },
    });
    const mesh = new THREE.Mesh(this.triangles, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  place(state: BodyState): void {
    const data = this.places.image.data as unknown as Float32Array;
    for (let b = 0; b < this.geometry.balls; ++b) {
      data[4 * b] = state.position[3 * b]!;
      data[4 * b + 1] = state.position[3 * b + 1]!;
      data[4 * b + 2] = state.position[3 * b + 2]!;
    }
    this.places.needsUpdate = true;
  }

  /** `colourOf` gives red, green, blue (0 to 255) of a body. */
  paint(colourOf: (body: number) => [number, number, number]): void {
    const data = this.colours.image.data as unknown as Uint8Array;
    const { body, balls } = this.geometry;
    let last = -1, r = 0, g = 0, b = 0;
    for (let k = 0; k < balls; ++k) {
      if (body[k] !== last) {
        last = body[k]!;
        [r, g, b] = colourOf(last);
      }
      data[4 * k] = r;
      data[4 * k + 1] = g;
      data[4 * k + 2] = b;
      // Bodies that follow each other in number get marks far apart, so that neighbours hardly ever share one.
      data[4 * k + 3] = (last * 101) & 255;
    }
    this.colours.needsUpdate = true;
  }

  /** Shows the balls of the bodies that pass. */
  choose(passes: (body: number) => boolean): void {
    const list = this.corners.array as Uint32Array;
    const { body, balls } = this.geometry;
    let n = 0, last = -1, pass = false;
    for (let k = 0; k < balls; ++k) {
      if (body[k] !== last) {
        last = body[k]!;
        pass = passes(last);
      }
      if (!pass) continue;
      for (let corner = 0; corner < 3; ++corner) list[3 * n + corner] = 3 * k + corner;
      n += 1;
    }
    this.count = n;
    this.triangles.setDrawRange(0, 3 * n);
    this.corners.needsUpdate = true;
  }

  dispose(): void {
    this.places.dispose();
    this.colours.dispose();
    this.triangles.dispose();
    this.material.dispose();
  }
}
