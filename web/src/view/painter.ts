// SPDX-License-Identifier: BSD-3-Clause
// Draws when something changed and rests otherwise: coarse pictures while the view turns, on a slow machine at fewer pixels, and
// at rest sample after sample until the picture is smooth.
import type { Look, Pipeline } from "./pipeline.ts";
import type * as THREE from "three";

/** A picture that takes longer than this is made with fewer pixels while the view turns. */
const SLOW_MILLISECONDS = 50;
const REST_MILLISECONDS = 160;
/** Fewer pixels than this make no picture faster: what remains is the work for each ball. */
const LEAST_SCALE = 0.4;

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

/** A picture that the graphics processor was told to make. */
interface Ordered {
  fence: WebGLSync;
  at: number;
  coarse: boolean;
  /** Of the last request that it serves. */
  order: number;
}

export class Painter {
  /** From the order to the end on the graphics processor, of the last picture with all pixels. */
  drawMilliseconds = 0;
  private dirty = false;
  private samples = 0;
  private coarse = false;
  private scale: number;
  private movedAt = -Infinity;
  private underWay: Ordered[] = [];
  private scheduled = 0;
  private waiting: (() => void)[] = [];
  private firstWaiting: { order: number; coarse: boolean; resolve: () => void }[] = [];
  private ordered = 0;
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

  /** Resolves when a picture of all that was set before is on the canvas; a coarse one is enough if `coarse` is set. */
  first(coarse = false): Promise<void> {
    this.request(coarse);
    return new Promise((resolve) => this.firstWaiting.push({ order: this.ordered, coarse, resolve }));
  }

  /** Resolves when the picture with all pixels shows what was set, at once if it does already. */
  sharp(): Promise<void> {
    return this.dirty || this.coarse ? this.first() : Promise.resolve();
  }

  /** A picture at once, before the browser goes on: for the printer. */
  paintNow(): void {
    if (this.held === 0) this.paint(0, 1);
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
    this.settle();
    // A slow machine must not fall behind the viewer's hand; a quick one tells of the end of a picture a little late.
    if (this.underWay.length >= (this.options.slow ? 1 : 2)) return this.schedule();
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
    } else if (this.underWay.length > 0) {
      this.schedule();
    } else {
      for (const resolve of this.waiting.splice(0)) resolve();
    }
  }

  /** Takes note of the pictures that the graphics processor has finished. */
  private settle(): void {
    const { gl } = this.options;
    while (this.underWay.length > 0) {
      const { fence, at, coarse, order } = this.underWay[0]!;
      if (gl.clientWaitSync(fence, gl.SYNC_FLUSH_COMMANDS_BIT, 0) === gl.TIMEOUT_EXPIRED) return;
      gl.deleteSync(fence);
      this.underWay.shift();
      this.measure(performance.now() - at, coarse);
      const serves = (waiting: { order: number; coarse: boolean }) => waiting.order <= order && (waiting.coarse || !coarse);
      const served = this.firstWaiting.filter(serves);
      this.firstWaiting = this.firstWaiting.filter((waiting) => !serves(waiting));
      for (const { resolve } of served) resolve();
    }
  }

  private measure(took: number, coarse: boolean): void {
    if (!coarse) this.drawMilliseconds = took;
    else if (took > SLOW_MILLISECONDS) this.scale = Math.max(LEAST_SCALE, this.scale * 0.75);
    // A picture ends at a refresh of the screen, so little is known of quick ones.
    if (took < SLOW_MILLISECONDS / 2) this.scale = Math.min(1, this.scale * 1.1);
    else if (!coarse && took > SLOW_MILLISECONDS && this.scale === 1) this.scale = 0.75;
  }

  private paint(sample: number, scale: number): void {
    const { canvas, gl, pipeline, camera } = this.options;
    const look = this.options.look();
    this.coarse = scale < 1;
    if (this.coarse) {
      look.pixelRatio *= scale;
      look.shadeSamples = Math.ceil(look.shadeSamples / 2);
    }
    pipeline.resize(Math.max(1, Math.round(canvas.width * scale)), Math.max(1, Math.round(canvas.height * scale)));
    const at = performance.now();
    pipeline.draw(camera, look, sample, this.coarse || !pipeline.canAverage);
    pipeline.show();
    this.samples = sample + 1;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (fence) this.underWay.push({ fence, at, coarse: this.coarse, order: this.ordered });
    gl.flush();
    if (sample === 0) this.options.painted();
    this.schedule();
  }
}
