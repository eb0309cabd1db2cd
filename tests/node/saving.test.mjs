// What is saved: checksums of PNG chunks, GIF's compression and colours, lines of text.

import assert from "node:assert/strict";
import { test } from "node:test";
import { load, seeded } from "./scripts.mjs";

const player = load("player");

// Codes back to indices, straight from the GIF 89a specification, appendix F.
function unpacked(bytes, bits) {
  const clear = 1 << bits;
  let [at, width, table, before] = [0, bits + 1, null, null];
  const indices = [];
  const code = () => {
    let value = 0;
    for (let bit = 0; bit < width; bit++, at++) value |= ((bytes[at >> 3] >> (at & 7)) & 1) << bit;
    return value;
  };
  for (;;) {
    const now = code();
    if (now === clear + 1) return indices;
    if (now === clear) {
      table = Array.from({ length: clear + 2 }, (_, i) => [i]);
      [width, before] = [bits + 1, null];
      continue;
    }
    const run = table[now] ?? [...before, before[0]];
    if (before && table.length < 4096) table.push([...before, run[0]]);
    if (table.length === 1 << width && width < 12) width++;
    indices.push(...run);
    before = run;
  }
}

test("the checksum of a chunk is that of the PNG specification", () => {
  // Every PNG ends with these twelve bytes.
  const end = [..."IEND"].map((letter) => letter.charCodeAt(0));
  assert.equal(player.crc32(end), 0xae426082);
});

for (const [name, bits, n, colours] of [
  ["one index", 2, 1, 4],
  ["one colour", 2, 5000, 1],
  ["few colours", 3, 5000, 5],
  ["noise that fills the table more than once", 8, 30000, 256],
]) {
  test(`${name}: what is compressed is read as it was`, () => {
    const random = seeded(7);
    const indices = Uint8Array.from({ length: n }, () => Math.floor(random() * colours));
    assert.deepEqual(unpacked(player.lzw(indices, bits), bits), Array.from(indices));
  });
}

test("pixels that did not change are transparent, and the others have their own colours", () => {
  const [red, blue, white] = [0xff0000ff, 0xffff0000, 0xffffffff];
  const gif = player.newGif(3, 2, "");
  player.addFrame(gif, Uint32Array.of(red, red, red, white, white, white), 10);
  const next = Uint32Array.of(red, blue, red, white, white, blue);
  const box = player.changedBox(gif, next);
  assert.deepEqual(box, { x0: 1, y0: 0, x1: 2, y1: 1 });
  const { indices, palette } = player.indexed(gif, next, box);
  assert.deepEqual(Array.from(indices), [1, 0, 0, 1]);
  assert.deepEqual(Array.from(palette.subarray(3, 6)), [0, 0, 255]);
});

test("of more than 255 colours the rarest become those that are nearest", () => {
  const grey = (v) => (0xff000000 | (v << 16) | (v << 8) | v) >>> 0;
  const common = Array.from({ length: 255 }, (_, v) => [grey(v), grey(v)]).flat();
  const gif = player.newGif(512, 1, "");
  const pixels = Uint32Array.from([...common, 0xff000001, grey(255)]);
  const { indices, palette } = player.indexed(gif, pixels, { x0: 0, y0: 0, x1: 511, y1: 0 });
  const shown = (i) => Array.from(palette.subarray(3 * indices[i], 3 * indices[i] + 3));
  assert.deepEqual(shown(20), [10, 10, 10]);
  assert.deepEqual(shown(510), [0, 0, 0]);
  assert.deepEqual(shown(511), [254, 254, 254]);
});

test("the frames of a replay are evenly spaced, from the prior to the last reading", () => {
  assert.deepEqual(player.stepsOfFrames(10, 0.5), [0, 2, 4, 6, 8, 10]);
  assert.deepEqual(player.stepsOfFrames(3, 10), [0, 1, 2, 3]);
  assert.equal(player.stepsOfFrames(5000, 100).length, 200);
  assert.deepEqual(player.stepsOfFrames(0, 0), [0]);
});

test("words are broken where the next would be too wide", () => {
  const pen = { measureText: (text) => ({ width: text.length }) };
  assert.deepEqual(player.brokenWords(pen, "one two three", 7), ["one two", "three"]);
  assert.deepEqual(player.brokenWords(pen, "unbreakable", 3), ["unbreakable"]);
});

test("a text in a PNG has its length and its checksum", async () => {
  const png = await player.pngWithText(new Uint8Array(33), { Title: "a\u2713" }).arrayBuffer();
  const bytes = new Uint8Array(png).subarray(33);
  assert.deepEqual(Array.from(bytes.subarray(0, 8)), [0, 0, 0, 8, 0x74, 0x45, 0x58, 0x74]);
  // A letter that Latin-1 has not is not written as another one's two bytes.
  assert.deepEqual(Array.from(bytes.subarray(8, 16)), [..."Title\0a\xff"].map((c) => c.charCodeAt(0)));
});

test("a file does not tell what is hidden on the page", () => {
  const values = { rule: "prior_once", fov_rad: 1, p_wall: 0.2 };
  const hidden = ["rule", "fov_deg", "cell_px"];
  assert.deepEqual(player.toldValues(values, hidden, { fov_rad: "fov_deg" }), { p_wall: 0.2 });
});
