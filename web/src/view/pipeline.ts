// SPDX-License-Identifier: BSD-3-Clause
// The passes that make a picture: nearest ball of each pixel, shading, rods and walls, and the mean of several such samples
// whose pixels are shifted by parts of a pixel, which smooths edges and shade.
import * as THREE from "three";
import type { Balls } from "./balls.ts";
import type { Rods } from "./rods.ts";
import type { Walls } from "./walls.ts";
import { COPY_FRAGMENT, SCREEN_VERTEX, SHADE_FRAGMENT } from "./shaders.ts";

/** How a picture is to look; what it shows is in the objects themselves. */
export interface Look {
  paper: THREE.Color;
  /** 0: solid grains, 1: none. In between grains are a pale backdrop and hide nothing. */
  ghost: number;
  /** 1: colours stand for values, so light changes them little; 0: full light and shade. */
  plain: number;
  /** Share of the paper's colour that the farthest chains take. */
  fog: number;
  /** Depth of the specimen along the view, mm, from and to. */
  depths_mm: [number, number];
  /** How far neighbours cast shade, mm. */
  reachOfShade_mm: number;
  /** Points of the neighbourhood that are looked at for shade. */
  shadeSamples: number;
  /** Pixels for each unit of length of the page. */
  pixelRatio: number;
}

interface Pass {
  scene: THREE.Scene;
  material: THREE.RawShaderMaterial;
}

const FLAT_CAMERA = new THREE.OrthographicCamera();

function screenPass(fragmentShader: string, uniforms: Record<string, THREE.IUniform>, options: THREE.ShaderMaterialParameters): Pass {
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3, vertexShader: SCREEN_VERTEX, fragmentShader, uniforms, depthTest: false, depthWrite: false,
    blending: THREE.NoBlending, ...options,
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex([0, 1, 2]);
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  const scene = new THREE.Scene();
  scene.add(mesh);
  return { scene, material };
}

/** Places inside a pixel, evenly spread for any number of them (generalised golden ratio; the first is the middle). */
function shift(sample: number): [number, number] {
  return [((sample * 0.7548776662 + 0.5) % 1) - 0.5, ((sample * 0.5698402910 + 0.5) % 1) - 0.5];
}

export class Pipeline {
  /** Ball of each pixel (its number plus one) and depth. */
  private readonly nearest: THREE.WebGLRenderTarget;
  private readonly sample: THREE.WebGLRenderTarget;
  private readonly sum: THREE.WebGLRenderTarget;
  private readonly shade: Pass;
  private readonly copy: Pass;
  private readonly add: Pass;
  private readonly over = new THREE.Scene();
  private readonly through = new THREE.Scene();
  private readonly camera = new THREE.OrthographicCamera();
  private width = 0;
  private height = 0;

  constructor(
    private readonly renderer: THREE.WebGLRenderer, private readonly balls: Balls, private readonly chains: Rods, private readonly walls: Walls,
  ) {
    const sharp = { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false } as const;
    this.nearest = new THREE.WebGLRenderTarget(1, 1, {
      ...sharp, format: THREE.RedIntegerFormat, type: THREE.UnsignedIntType, internalFormat: "R32UI",
      depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType),
    });
    const smooth = { minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, generateMipmaps: false } as const;
    this.sample = new THREE.WebGLRenderTarget(1, 1, { ...smooth, depthBuffer: true });
    this.sum = new THREE.WebGLRenderTarget(1, 1, { ...smooth, type: THREE.HalfFloatType, depthBuffer: false });
    this.shade = screenPass(SHADE_FRAGMENT, {
      nearest: { value: this.nearest.texture }, depths: { value: this.nearest.depthTexture }, balls: { value: balls.places },
      colours: { value: balls.colours }, deep: { value: 1 }, pixels: { value: new THREE.Vector2() }, cutInView: { value: balls.cutInView },
      paper: { value: new THREE.Color() }, occlusion: { value: 1 }, reachOfShade: { value: 1 }, samples: { value: 8 },
      turn: { value: 0 }, ghost: { value: 0 }, plain: { value: 0 },
      lineWidth: { value: 1 }, ballProjection: { value: new THREE.Matrix4() }, ballView: { value: new THREE.Matrix4() },
    }, { depthTest: true, depthWrite: true, depthFunc: THREE.AlwaysDepth });
    this.copy = screenPass(COPY_FRAGMENT, { picture: { value: this.sum.texture }, factor: { value: 1 } }, {});
    this.add = screenPass(COPY_FRAGMENT, { picture: { value: this.sample.texture }, factor: { value: 1 } }, {
      transparent: true, blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendEquation: THREE.AddEquation,
    });
    this.over.add(chains.mesh, walls.edges.mesh);
    this.through.add(walls.faces);
  }

  /** Whether several samples can be averaged; without it edges stay as sharp as pixels. */
  get canAverage(): boolean {
    return this.renderer.extensions.has("EXT_color_buffer_float") || this.renderer.extensions.has("EXT_color_buffer_half_float");
  }

  /** Size of the picture that is made, pixels. */
  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    for (const target of [this.nearest, this.sample, this.sum]) target.setSize(width, height);
  }

  private setLook(look: Look, sample: number): void {
    const u = this.shade.material.uniforms;
    const camera = this.camera;
    u.deep!.value = camera.far - camera.near;
    u.pixels!.value.set(this.width, this.height);
    u.paper!.value.copy(look.paper);
    u.reachOfShade!.value = look.reachOfShade_mm;
    u.samples!.value = look.shadeSamples;
    u.turn!.value = (sample * 0.61803398875) % 1;
    u.ghost!.value = look.ghost;
    u.plain!.value = look.plain;
    u.lineWidth!.value = look.pixelRatio;
    u.ballProjection!.value.copy(camera.projectionMatrix);
    u.ballView!.value.copy(camera.matrixWorldInverse);
    const perPixel = (camera.right - camera.left) / camera.zoom / this.width;
    this.chains.uniforms.leastRadius.value = 0.4 * perPixel;
    this.walls.edges.uniforms.leastRadius.value = 0.6 * look.pixelRatio * perPixel;
    this.chains.uniforms.fog.value = look.fog;
    this.chains.uniforms.fogRange.value.set(...look.depths_mm).divideScalar(camera.far - camera.near);
    for (const rods of [this.chains, this.walls.edges]) rods.uniforms.paper.value.copy(look.paper);
  }

  /** Draws sample 0, 1, 2 ... of a picture and adds it to those before it; sample 0 begins a new picture. `alone`: no further sample
   * follows, and none is summed up. */
  draw(camera: THREE.OrthographicCamera, look: Look, sample: number, alone = false): void {
    const { renderer } = this;
    this.camera.copy(camera, false);
    camera.updateMatrixWorld();
    this.camera.updateMatrixWorld();
    this.camera.updateProjectionMatrix();
    const [x, y] = shift(sample);
    this.camera.projectionMatrix.elements[12]! += (2 * x) / this.width;
    this.camera.projectionMatrix.elements[13]! += (2 * y) / this.height;
    this.balls.cutInView.set(this.balls.cut.x, this.balls.cut.y, this.balls.cut.z).transformDirection(this.camera.matrixWorldInverse);
    if (this.balls.cut.w > 1e8) this.balls.cutInView.set(0, 0, 1);
    this.setLook(look, sample);

    renderer.autoClear = false;
    renderer.setClearColor(0x000000, 0);
    renderer.setRenderTarget(this.nearest);
    renderer.clear(true, true, false);
    if (look.ghost < 1) renderer.render(this.balls.scene, this.camera);
    renderer.setRenderTarget(this.sample);
    renderer.render(this.shade.scene, FLAT_CAMERA);
    renderer.render(this.over, this.camera);
    renderer.render(this.through, this.camera);
    const copy = this.copy.material.uniforms;
    copy.picture!.value = (alone ? this.sample : this.sum).texture;
    copy.factor!.value = alone ? 1 : 1 / (sample + 1);
    if (alone) return;
    renderer.setRenderTarget(this.sum);
    if (sample === 0) renderer.clear(true, false, false);
    renderer.render(this.add.scene, FLAT_CAMERA);
  }

  /** Brings the mean of the samples onto the canvas. */
  show(): void {
    this.renderer.setRenderTarget(null);
    this.renderer.render(this.copy.scene, FLAT_CAMERA);
  }

  /** The mean of the samples as pixels, the top row first. */
  read(): ImageData {
    const flat = new THREE.WebGLRenderTarget(this.width, this.height, { depthBuffer: false });
    this.renderer.setRenderTarget(flat);
    this.renderer.render(this.copy.scene, FLAT_CAMERA);
    const rows = new Uint8Array(4 * this.width * this.height);
    this.renderer.readRenderTargetPixels(flat, 0, 0, this.width, this.height, rows);
    this.renderer.setRenderTarget(null);
    flat.dispose();
    const image = new ImageData(this.width, this.height), row = 4 * this.width;
    for (let y = 0; y < this.height; ++y) image.data.set(rows.subarray((this.height - 1 - y) * row, (this.height - y) * row), y * row);
    return image;
  }

  /** Ball at a pixel of the last sample, counted from the top left; -1 where there is none. */
  ballAt(x: number, y: number): number {
    const one = new Uint32Array(1);
    this.renderer.readRenderTargetPixels(this.nearest, x, this.height - 1 - y, 1, 1, one);
    return one[0]! - 1;
  }

  dispose(): void {
    for (const target of [this.nearest, this.sample, this.sum]) target.dispose();
    for (const pass of [this.shade, this.copy, this.add]) pass.material.dispose();
  }
}
