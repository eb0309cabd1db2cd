import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { load } from "./scripts.mjs";

const player = load("player");

const bufferOf = (...parts) =>
  new Uint8Array(Buffer.concat(parts.map((part) => Buffer.from(part.buffer)))).buffer;

// The layouts of occsim/io/replay.py, version 2, written down number by number.

// 7 x 10 px in cells of 4, so 2 x 3 cells; two readings of the cells {1, 2, 5} and {0, 1}.
test("a log is read as its layout says", () => {
  const words = [0x324c474f, 7, 10, 4, 2, 5, 3, 2, 1, 0];
  const log = player.decodeLog(
    bufferOf(
      Uint32Array.from(words),
      Float64Array.of(-2, 1.5),
      Uint32Array.of(2, 1), // runs of each reading
      Uint32Array.of(1, 2, 0), // gaps
      Uint32Array.of(2, 1, 2), // lengths
      Uint8Array.of(0, 1, 1, 0, 0), // values of the entries
      Uint8Array.of(0b00000100), // truth: cell 5
    ),
  );
  const { heightPx, widthPx, cellPx, nRows, nCols, nCells, nReadings } = log;
  assert.deepEqual(
    [heightPx, widthPx, cellPx, nRows, nCols, nCells, nReadings],
    [7, 10, 4, 2, 3, 6, 2],
  );
  assert.deepEqual([...log.indptr], [0, 3, 5]);
  assert.deepEqual([...log.cell], [1, 2, 5, 0, 1]);
  assert.deepEqual([...log.logOdds], [-2, 1.5, 1.5, -2, -2]);
  assert.deepEqual([...log.truth], [0, 0, 0, 0, 0, 1]);
});

test("a scene is read as its layout says", () => {
  const scene = player.decodeScene(
    bufferOf(
      Uint32Array.of(0x3253474f, 2, 3, 2, 4, 0),
      Float64Array.of(20, 0.5),
      Float32Array.of(1, 2, 3, 4, 5, 6),
      Uint8Array.of(0b10010000), // wall pixels 0 and 3
      Uint8Array.of(9, 8, 7, 6), // preview
    ),
  );
  assert.deepEqual([scene.heightPx, scene.widthPx, scene.nReadings], [2, 3, 2]);
  assert.deepEqual([scene.rangePx, scene.fovRad], [20, 0.5]);
  assert.deepEqual([...scene.poses], [1, 2, 3, 4, 5, 6]);
  assert.deepEqual([...scene.pixels.truth], [1, 0, 0, 1, 0, 0]);
  assert.deepEqual([scene.pixels.cellPx, scene.pixels.nRows, scene.pixels.nCols], [1, 2, 3]);
  assert.deepEqual([...scene.preview], [9, 8, 7, 6]);
});

test("walls are read as their layout says", () => {
  const walls = bufferOf(Uint32Array.of(0x3257474f, 2, 3), Uint8Array.of(0b10010000));
  assert.deepEqual([...player.decodeWalls(walls)], [1, 0, 0, 1, 0, 0]);
  const header = Uint32Array.of(0x3257474f, 2, 3);
  const both = bufferOf(header, Uint8Array.of(0b10010000, 0b01000100));
  assert.deepEqual([...player.decodeWalls(both)], [1, 2, 0, 1, 0, 2]);
});

test("beams are read as their layout says", () => {
  const beams = player.decodeBeams(
    bufferOf(
      Uint32Array.of(0x3242474f, 1, 3, 0),
      Float64Array.of(40),
      Float32Array.of(-0.5, 0, 0.5),
      Uint16Array.of(32767, 65534, 65535),
    ),
  );
  assert.deepEqual([beams.nBeams, beams.reachPx], [3, 40]);
  assert.deepEqual([...beams.bearings], [-0.5, 0, 0.5]);
  // Half the reach and a hit; the whole reach and none; nothing said.
  const scene = { poses: Float32Array.of(10, 20, 0.5) };
  const ends = player.endsOf({ beams, scene }, 0);
  assert.deepEqual(ends.length, 2);
  assert.ok(Math.abs(ends[0][0] - 30) < 1e-3 && ends[0][1] === 20 && ends[0][2]);
  assert.ok(!ends[1][2] && Math.abs(Math.hypot(ends[1][0] - 10, ends[1][1] - 20) - 40) < 1e-9);
});

test("header and payloads come apart, also from the middle of a buffer", () => {
  const header = Buffer.from(JSON.stringify({ name: "\u00e9", sizes: [2, 0, 3] }));
  const length = Buffer.alloc(4);
  length.writeUInt32LE(header.length);
  const whole = Buffer.concat([Buffer.of(99), length, header, Buffer.of(1, 2, 3, 4, 5)]);
  const data = new Uint8Array(whole).subarray(1);
  const [read, ...payloads] = player.readPacked(data);
  assert.equal(read.name, "\u00e9");
  assert.deepEqual(
    payloads.map((bytes) => [...bytes]),
    [[1, 2], [], [3, 4, 5]],
  );
});

test("flags are read from bits, high bit first", () => {
  const bytes = Uint8Array.of(0b10000001, 0b01100000);
  assert.deepEqual([...player.unpackBits(bytes, 11)], [1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1]);
});

test("zlib streams are those of other programs, and base64 is what btoa writes", async () => {
  const bytes = Uint8Array.from({ length: 1000 }, (_, i) => (i * i) % 251);
  assert.deepEqual(await player.inflated(deflateSync(bytes)), bytes);
  assert.deepEqual(await player.inflated(await player.deflated(bytes)), bytes);
  assert.equal(player.base64(Uint8Array.of(0, 255, 16)), "AP8Q");
});
