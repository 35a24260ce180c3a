// SPDX-License-Identifier: BSD-3-Clause
// How far bodies moved and turned between two states.
//
// A clump turned by q1 q0*. A rubber grain has no orientation of its own: its turn is the rotation that brings its 35 balls
// nearest to where they are now, in the least squares about the centres: the eigenvector to the largest eigenvalue of a
// symmetric 4x4 matrix of their products. Source: Horn (1987), Closed-form solution of absolute orientation using unit
// quaternions, J. Opt. Soc. Am. A 4, 629.
import { GRAIN_BALLS, type BodyState, type Geometry } from "./bodies.ts";

type Matrix4 = number[][];

/** Eigenvector to the largest eigenvalue of a symmetric matrix, by Jacobi rotations. */
function largestEigenvector(m: Matrix4): number[] {
  const v: Matrix4 = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
  for (let sweep = 0; sweep < 12; ++sweep) {
    let off = 0, size = 0;
    for (let p = 0; p < 4; ++p) {
      for (let q = 0; q < 4; ++q) (p === q ? (size += m[p]![q]! ** 2) : (off += m[p]![q]! ** 2));
    }
    if (off <= 1e-28 * size) break;
    for (let p = 0; p < 3; ++p) for (let q = p + 1; q < 4; ++q) rotateJacobi(m, v, p, q);
  }
  let best = 0;
  for (let k = 1; k < 4; ++k) if (m[k]![k]! > m[best]![best]!) best = k;
  return v.map((row) => row[best]!);
}

function rotateJacobi(m: Matrix4, v: Matrix4, p: number, q: number): void {
  const apq = m[p]![q]!;
  if (apq === 0) return;
  const theta = (m[q]![q]! - m[p]![p]!) / (2 * apq);
  const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.sqrt(theta * theta + 1));
  const c = 1 / Math.sqrt(t * t + 1), s = t * c;
  for (let k = 0; k < 4; ++k) {
    const kp = m[k]![p]!, kq = m[k]![q]!;
    m[k]![p] = c * kp - s * kq;
    m[k]![q] = s * kp + c * kq;
  }
  for (let k = 0; k < 4; ++k) {
    const pk = m[p]![k]!, qk = m[q]![k]!;
    m[p]![k] = c * pk - s * qk;
    m[q]![k] = s * pk + c * qk;
    const vp = v[k]![p]!, vq = v[k]![q]!;
    v[k]![p] = c * vp - s * vq;
    v[k]![q] = s * vp + c * vq;
  }
}

/** Unit quaternion (w, x, y, z) of the rotation that brings `count` points from `from` nearest to `to`, both about their own
 * centre; triples from index `start` on. */
export function fitRotation(from: Float32Array, to: Float32Array, start: number, count: number): number[] {
  const c0 = [0, 0, 0], c1 = [0, 0, 0];
  for (let k = 0; k < count; ++k) {
    for (let a = 0; a < 3; ++a) {
      c0[a]! += from[start + 3 * k + a]! / count;
      c1[a]! += to[start + 3 * k + a]! / count;
    }
  }
  const s = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  for (let k = 0; k < count; ++k) {
    for (let a = 0; a < 3; ++a) {
      const d = from[start + 3 * k + a]! - c0[a]!;
      for (let b = 0; b < 3; ++b) s[a]![b]! += d * (to[start + 3 * k + b]! - c1[b]!);
    }
  }
  const [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = s as [[number, number, number], [number, number, number], [number, number, number]];
  return largestEigenvector([
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ]);
}

/** Angle of a unit quaternion, degrees, 0 to 180. The vector part keeps small angles exact. */
function angle_deg(w: number, x: number, y: number, z: number): number {
  return (360 / Math.PI) * Math.atan2(Math.sqrt(x * x + y * y + z * z), Math.abs(w));
}

/** Turn of each body between two states, degrees, whatever its axis. */
export function bodyRotation(geometry: Geometry, from: BodyState, to: BodyState): Float32Array {
  const angle = new Float32Array(geometry.bodies);
  for (let g = 0; g < geometry.rubberGrains; ++g) {
    const [w, x, y, z] = fitRotation(from.position, to.position, 3 * GRAIN_BALLS * g, GRAIN_BALLS) as [number, number, number, number];
    angle[g] = angle_deg(w, x, y, z);
  }
  for (let c = 0; c < geometry.clumps; ++c) {
    const q = 4 * c, a = from.orientation, b = to.orientation;
    const w0 = a[q]!, x0 = a[q + 1]!, y0 = a[q + 2]!, z0 = a[q + 3]!;
    const w1 = b[q]!, x1 = b[q + 1]!, y1 = b[q + 2]!, z1 = b[q + 3]!;
    angle[geometry.rubberGrains + c] = angle_deg(
      w1 * w0 + x1 * x0 + y1 * y0 + z1 * z0,
      -w1 * x0 + x1 * w0 - y1 * z0 + z1 * y0,
      -w1 * y0 + x1 * z0 + y1 * w0 - z1 * x0,
      -w1 * z0 - x1 * y0 + y1 * x0 + z1 * w0,
    );
  }
  return angle;
}

/** Way of the centre of each body between two states, mm. */
export function bodyDisplacement(from: BodyState, to: BodyState): Float32Array {
  const way = new Float32Array(to.centre.length / 3);
  for (let b = 0; b < way.length; ++b) {
    way[b] = Math.hypot(
      to.centre[3 * b]! - from.centre[3 * b]!, to.centre[3 * b + 1]! - from.centre[3 * b + 1]!, to.centre[3 * b + 2]! - from.centre[3 * b + 2]!,
    );
  }
  return way;
}
