// SPDX-License-Identifier: BSD-3-Clause
// Where the viewer stands: parallel projection, turned by mouse, touch and keys. z is up, x the shear direction.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

export type Direction = "front" | "top" | "oblique";

/** Turn about the vertical from the front, and height above the horizon, degrees. */
const DIRECTIONS: Record<Direction, [number, number]> = { front: [0, 0], top: [0, 90], oblique: [-32, 24] };
/** Of the page, pixels. */
const LEGEND_WIDTH = 130, LEGEND_HEIGHT = 110, CAPTION_HEIGHT = 32, SCALE_HEIGHT = 26, AXES_WIDTH = 66;
const KEY_TURN = Math.PI / 36, KEY_ZOOM = 1.15;

export class Viewpoint {
  readonly camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
  private readonly controls: OrbitControls;
  private aspect = 1;
  private halfHeight = 1;
  /** While the view goes to another place at once, which is no movement. */
  private jumping = false;

  /** `changed` is told whether more changes follow at once. */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly changed: (moving: boolean) => void) {
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(0, -1, 0);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.changed(!this.jumping));
    canvas.addEventListener("keydown", this.key);
    // A page must scroll past the view: it takes the wheel and one finger only when it was chosen first.
    this.controls.enableZoom = false;
    canvas.style.touchAction = "pan-y";
    canvas.addEventListener("focus", this.focus);
    canvas.addEventListener("blur", this.focus);
    canvas.addEventListener("pointerdown", this.choose);
  }

  private readonly choose = () => this.canvas.focus({ preventScroll: true });

  private readonly focus = () => {
    const chosen = document.activeElement === this.canvas;
    this.controls.enableZoom = chosen;
    this.canvas.style.touchAction = chosen ? "none" : "pan-y";
  };

  private readonly key = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns: Record<string, [number, number]> = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const turn = turns[event.key];
    if (turn) this.turn(turn[0] * KEY_TURN, turn[1] * KEY_TURN);
    else if (event.key === "+" || event.key === "=") this.zoom(KEY_ZOOM);
    else if (event.key === "-") this.zoom(1 / KEY_ZOOM);
    else return;
    event.preventDefault();
  };

  private turn(around: number, up: number): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    const size = away.length();
    const azimuth = Math.atan2(away.x, -away.y) - around;
    const height = Math.asin(THREE.MathUtils.clamp(away.z / size, -1, 1)) + up;
    this.place(azimuth, height, size);
  }

  private place(azimuth: number, height: number, size: number): void {
    // Straight from above there would be no up: a hair less keeps x to the right.
    const h = THREE.MathUtils.clamp(height, -Math.PI / 2 + 1e-4, Math.PI / 2 - 1e-4);
    const level = size * Math.cos(h);
    this.camera.position.set(level * Math.sin(azimuth), -level * Math.cos(azimuth), size * Math.sin(h)).add(this.controls.target);
    this.controls.update();
    this.changed(!this.jumping);
  }

  zoom(factor: number): void {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.changed(true);
  }

  /** Looks at the box from a direction so that it fills the picture. */
  look(direction: Direction, box: THREE.Box3): void {
    const [azimuth, height] = DIRECTIONS[direction].map((angle) => THREE.MathUtils.degToRad(angle)) as [number, number];
    const radius = 0.5 * box.getSize(new THREE.Vector3()).length();
    box.getCenter(this.controls.target);
    // Far enough that nothing comes before the near end when the view was pushed aside and turned.
    this.camera.near = 0;
    this.camera.far = 8 * radius;
    this.jumping = true;
    this.place(azimuth, height, 4 * radius);
    this.fit(box);
    this.jumping = false;
  }

  /** Nearest and farthest depth of a box behind the near end of the view, mm. */
  depths(box: THREE.Box3): [number, number] {
    const places = this.corners(box).map((corner) => -corner.z);
    return [Math.min(...places), Math.max(...places)];
  }

  /** Of a box, in the frame of the camera. */
  private corners(box: THREE.Box3): THREE.Vector3[] {
    this.camera.updateMatrixWorld();
    return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => new THREE.Vector3(
      k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z,
    ).applyMatrix4(this.camera.matrixWorldInverse));
  }

  private fit(box: THREE.Box3): void {
    const corners = this.corners(box), free = this.free();
    const width = Math.max(...corners.map((corner) => Math.abs(corner.x)));
    const height = Math.max(...corners.map((corner) => Math.abs(corner.y)));
    this.camera.zoom = 1;
    this.halfHeight = 1.04 * Math.max(height / (free.bottom - free.top), width / this.aspect / (free.right - free.left));
    this.setFrustum();
  }

  resize(aspect: number): void {
    this.aspect = aspect;
    this.setFrustum();
  }

  /** Part of the picture, as shares of it, that caption, axes, scale and legends leave free: the legends stand at the right, in narrow
   * pictures below. */
  private free(): { left: number; right: number; top: number; bottom: number } {
    const width = Math.max(1, this.canvas.clientWidth), height = Math.max(1, this.canvas.clientHeight);
    const wide = width > 640;
    return {
      left: wide ? AXES_WIDTH / width : 0, right: wide ? 1 - LEGEND_WIDTH / width : 1, top: CAPTION_HEIGHT / height,
      bottom: wide ? 1 - SCALE_HEIGHT / height : Math.max(0.5, 1 - LEGEND_HEIGHT / height),
    };
  }

  /** The middle of the free part shows the point about which the view turns. */
  private setFrustum(): void {
    const { left, right, top, bottom } = this.free(), high = this.halfHeight, wide = high * this.aspect;
    const aside = wide * (1 - left - right), above = high * (top + bottom - 1);
    this.camera.left = -wide + aside;
    this.camera.right = wide + aside;
    this.camera.top = high + above;
    this.camera.bottom = -high + above;
    this.camera.updateProjectionMatrix();
    this.changed(false);
  }

  get pixelsPerMillimetre(): number {
    return (this.canvas.clientHeight * this.camera.zoom) / (2 * this.halfHeight);
  }

  dispose(): void {
    this.controls.dispose();
    this.canvas.removeEventListener("keydown", this.key);
    this.canvas.removeEventListener("focus", this.focus);
    this.canvas.removeEventListener("blur", this.focus);
    this.canvas.removeEventListener("pointerdown", this.choose);
  }
}
