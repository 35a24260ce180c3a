// SPDX-License-Identifier: BSD-3-Clause
// Undoes the packing of whole numbers (base64, zlib, byte planes, zigzag, differences) that data.ts describes.
import type { PackedIntegers } from "../data.ts";

/** Signed when packed with zigzag, unsigned otherwise. */
export type Integers = Int32Array | Uint32Array;

async function inflate(compressed: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

function joinPlanes(planes: Uint8Array, count: number, bytes: number): Uint32Array {
  const words = new Uint32Array(count);
  for (let plane = 0; plane < bytes; ++plane) {
    const start = plane * count, shift = 8 * plane;
    for (let i = 0; i < count; ++i) words[i]! |= planes[start + i]! << shift;
  }
  return words;
}

/** Numbers of `packed`. Sums of differences wrap at the width of the packed number, as signed numbers when zigzag is set. */
export async function unpackIntegers(packed: PackedIntegers): Promise<Integers> {
  const { count, bytes, zigzag, delta } = packed;
  if (count === 0) return zigzag ? new Int32Array(0) : new Uint32Array(0);
  const planes = await inflate(fromBase64(packed.data));
  if (planes.length !== count * bytes) {
    throw new Error(`packed numbers: ${planes.length} bytes where ${count} numbers of ${bytes} bytes were announced`);
  }
  const words = joinPlanes(planes, count, bytes);
  if (zigzag) {
    for (let i = 0; i < count; ++i) words[i] = (words[i]! >>> 1) ^ -(words[i]! & 1);
  }
  // 32-bit words wrap by themselves; narrower ones are cut to their width at the end, which gives the same.
  if (delta) {
    for (let i = 1; i < count; ++i) words[i]! += words[i - 1]!;
  }
  const spare = 32 - 8 * bytes;
  if (!zigzag) {
    if (spare > 0) for (let i = 0; i < count; ++i) words[i] = (words[i]! << spare) >>> spare;
    return words;
  }
  const signed = new Int32Array(words.buffer);
  if (delta && spare > 0) for (let i = 0; i < count; ++i) signed[i] = (signed[i]! << spare) >> spare;
  return signed;
}
