// SPDX-License-Identifier: BSD-3-Clause
// Packed numbers come back as they were, in all widths, with and without zigzag and differences, at the ends of their ranges.
import assert from "node:assert/strict";
import { test } from "node:test";
import { unpackIntegers } from "../../src/view/unpack.ts";
import { pack } from "./packing.ts";

/** A fixed sequence that visits all of a range (Park and Miller, 1988). */
function sequence(count: number, low: number, high: number): number[] {
  let state = 1;
  return Array.from({ length: count }, () => {
    state = (state * 48271) % 2147483647;
    return low + Math.floor((state / 2147483647) * (high - low + 1));
  });
}

for (const bytes of [1, 2, 4] as const) {
  for (const zigzag of [false, true]) {
    for (const delta of [false, true]) {
      test(`${bytes} bytes, zigzag ${zigzag}, delta ${delta}`, async () => {
        const low = zigzag ? -(2 ** (8 * bytes - 1)) : 0, high = zigzag ? 2 ** (8 * bytes - 1) - 1 : 2 ** (8 * bytes) - 1;
        const numbers = [low, high, low, 0, high, high, ...sequence(2000, low, high)];
        const found = await unpackIntegers(pack(numbers, bytes, zigzag, delta));
        assert.deepEqual(Array.from(found), numbers);
      });
    }
  }
}

test("the worked example of the description of zigzag", async () => {
  // 0, -1, 1, -2 are 0, 1, 2, 3: deflated by hand as a stored block of zlib.
  const bytes = [0x78, 0x01, 0x01, 4, 0, 0xfb, 0xff, 0, 1, 2, 3, 0x00, 0x0e, 0x00, 0x07];
  const found = await unpackIntegers({ count: 4, bytes: 1, zigzag: true, delta: false, data: Buffer.from(bytes).toString("base64") });
  assert.deepEqual(Array.from(found), [0, -1, 1, -2]);
});

test("no numbers", async () => {
  assert.equal((await unpackIntegers({ count: 0, bytes: 2, zigzag: true, delta: false, data: "" })).length, 0);
});

test("a wrong count is refused with both counts", async () => {
  const packed = { ...pack([1, 2, 3], 2, false, false), count: 4 };
  await assert.rejects(unpackIntegers(packed), /6 bytes where 4 numbers of 2 bytes/);
});
