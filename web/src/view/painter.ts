// SPDX-License-Identifier: BSD-3-Clause
// Draws when something changed and rests otherwise: coarse pictures while the view turns, on a slow machine at fewer pixels, and
// at rest sample after sample until the picture is smooth.
import type { Look, Pipeline } from "./pipeline.ts";
import type * as THREE from "three";

/** A picture that takes longer than this is made with fewer pixels while the view turns. */
const SLOW_MILLISECONDS = 50;
const REST_MILLISECONDS = 160;

export interface PainterOptions {
  canvas: HTMLCanvasElement;
  gl: WebGL2RenderingContext;
  pipeline: Pipeline;
  camera: THREE.OrthographicCamera;
  /** Software rendering: fewer samples, and coarse from the first turn on. */
  slow: boolean;
  look: () => Look;
  /** Called after each picture, for what lies over it. */
  painted: () => void;
}

export class Painter {
  /** From the order to the end on the graphics processor, of the last picture with all pixels. */
  drawMilliseconds = 0;
  private dirty = false;
  private samples = 0;
  private coarse = false;
  private scale: number;
  private movedAt = -Infinity;
  private fence: WebGLSync | null = null;
  private drawnAt = 0;
  private scheduled = 0;
  private waiting: (() => void)[] = [];
  private firstWaiting: { order: number; resolve: () => void }[] = [];
  private ordered = 0;
  private painted = 0;
  private held = 0;
  private over = false;

  constructor(private readonly options: PainterOptions) {
    this.scale = options.slow ? 0.5 : 1;
  }

  get wantedSamples(): number {
    if (!this.options.pipeline.canAverage) return 1;
    if (this.drawMilliseconds > 1000) return 2;
    return this.options.slow || this.drawMilliseconds > SLOW_MILLISECONDS ? 4 : 16;
  }

  /** The picture is out of date. `moving`: more changes follow at once. */
  request(moving: boolean): void {
    this.dirty = true;
    this.ordered += 1;
    if (moving) this.movedAt = performance.now();
    this.schedule();
  }

  /** Resolves when a picture of all that was set before is on the canvas. */
  first(): Promise<void> {
    this.request(false);
    return new Promise((resolve) => this.firstWaiting.push({ order: this.ordered, resolve }));
  }

  /** Resolves when the picture is as smooth as it gets. */
  finished(): Promise<void> {
    this.request(false);
    return new Promise((resolve) => this.waiting.push(resolve));
  }

  /** Leaves the pipeline to somebody else, who makes pictures of other sizes, until the promise is settled. */
  async hold<T>(work: () => Promise<T>): Promise<T> {
    this.held += 1;
    try {
      return await work();
    } finally {
      this.held -= 1;
      this.request(false);
    }
  }

  dispose(): void {
    this.over = true;
    cancelAnimationFrame(this.scheduled);
  }

  private schedule(): void {
    if (this.scheduled === 0 && !this.over) this.scheduled = requestAnimationFrame(() => this.tick());
  }

  private tick(): void {
    this.scheduled = 0;
    if (this.held > 0 || this.over) return;
    if (this.fence && !this.settled()) return this.schedule();
    const moving = performance.now() - this.movedAt < REST_MILLISECONDS;
    if (this.dirty) {
      this.dirty = false;
      this.paint(0, moving ? this.scale : 1);
    } else if (moving) {
      this.schedule();
    } else if (this.coarse) {
      this.paint(0, 1);
    } else if (this.samples < this.wantedSamples) {
      this.paint(this.samples, 1);
    } else {
      for (const resolve of this.waiting.splice(0)) resolve();
    }
  }

  /** Whether the graphics processor is done with the last picture; no further one is ordered before it is. */
  private settled(): boolean {
    const { gl } = this.options;
    const status = gl.clientWaitSync(this.fence!, gl.SYNC_FLUSH_COMMANDS_BIT, 0);
    if (status === gl.TIMEOUT_EXPIRED) return false;
    gl.deleteSync(this.fence);
    this.fence = null;
    const took = performance.now() - this.drawnAt;
    if (!this.coarse) this.drawMilliseconds = took;
    // A picture ends at the next refresh of the screen at the earliest, so only the slow side is measured.
    if (this.coarse || this.scale === 1) {
      if (took > SLOW_MILLISECONDS) this.scale = Math.max(0.25, this.scale * 0.75);
      else if (took < SLOW_MILLISECONDS / 2) this.scale = Math.min(1, this.scale * 1.1);
    }
    if (!this.coarse) {
      const served = this.firstWaiting.filter(({ order }) => order <= this.painted);
      this.firstWaiting = this.firstWaiting.filter(({ order }) => order > this.painted);
      for (const { resolve } of served) resolve();
    }
    return true;
  }

  private paint(sample: number, scale: number): void {
    const { canvas, gl, pipeline, camera } = this.options;
    const look = this.options.look();
    this.coarse = scale < 1;
    this.painted = this.ordered;
    if (this.coarse) {
      look.pixelRatio *= scale;
      look.shadeSamples = Math.ceil(look.shadeSamples / 2);
    }
    pipeline.resize(Math.max(1, Math.round(canvas.width * scale)), Math.max(1, Math.round(canvas.height * scale)));
    this.drawnAt = performance.now();
    pipeline.draw(camera, look, sample);
    pipeline.show();
    this.samples = sample + 1;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    if (sample === 0) this.options.painted();
    this.schedule();
  }
}
