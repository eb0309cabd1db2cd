import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";
import { columnOf, randomReplay } from "./worlds.mjs";

const player = load("player");

const COLOURS = {
  beliefOccupied: "#000000",
  beliefFree: "#ffffff",
  wallMask: "#aa4499",
  groundTruth: "#117733",
  hit: "#010101",
  falseWall: "#020202",
  missedWall: "#030303",
  free: "#040404",
};
const PRIOR = { p_wall: 0.2, p_space: 0.9, uninformative: false, rule: "prior_once" };

const rgb = (pixel) => [pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255];

// The layers of a picture, as far as they are numbers.
globalThis.document = {
  createElement: () => ({
    getContext: () => ({
      createImageData: (width, height) => ({ data: new Uint8ClampedArray(4 * width * height) }),
    }),
  }),
};

function painted(step, overlay = "none", seed = 2) {
  const world = randomReplay(seed);
  const model = columnOf(player, world.replay, PRIOR);
  player.seek(model.log, step);
  const picture = player.newPicture(model.log, COLOURS);
  player.paintAll(picture, model, overlay);
  return { world, model, picture, pixels: [...picture.cells.pixels].map(rgb) };
}

test("a pixel keeps red in the low byte and is opaque", () => {
  assert.equal(player.pixelOf(player.rgbOf("#123456")), 0xff563412);
});

// Prior 0.18 of wall cells is 45.9 of 255, 0.81 of space cells 206.55, one half 127.5.
test("before the first reading the map is the drawing: dark where it has walls", () => {
  const { model, pixels } = painted(0);
  pixels.forEach((pixel, c) => {
    assert.deepEqual(pixel, [[207, 207, 207], [46, 46, 46], [128, 128, 128]][model.drawn[c]]);
  });
});

// 46 + 0.55 * (0xaa - 46) = 114.2, and so on; 0x44 = 68, 0x99 = 153.
test("the wall mask tints the drawing's wall cells and no other", () => {
  const { model, pixels } = painted(0, "wall_mask");
  pixels.forEach((pixel, c) => {
    assert.deepEqual(pixel, [[207, 207, 207], [114, 58, 105], [128, 128, 128]][model.drawn[c]]);
  });
});

test("the ground truth tints the cells that are wall in truth", () => {
  const plain = painted(12).pixels;
  const { model, pixels } = painted(12, "truth");
  pixels.forEach((pixel, c) => {
    assert.equal(pixel[0] === plain[c][0] && pixel[1] === plain[c][1], !model.log.truth[c]);
  });
});

test("errors are told apart, seen or not", () => {
  const { model, pixels } = painted(2, "errors");
  const { truth, counts } = model.log;
  pixels.forEach(([value], c) => {
    const l = player.logOddsAt(model, c);
    assert.equal(value, l < -1e-9 ? (truth[c] ? 1 : 2) : truth[c] ? 3 : 4);
  });
  assert.ok([...counts].includes(0));
});

test("the mask of unseen cells is opaque where no reading was", () => {
  const { model, picture } = painted(2);
  const { counts } = model.log;
  assert.deepEqual(
    [...picture.unseen.pixels].map((pixel) => pixel >>> 24),
    [...counts].map((k) => (k ? 0 : 255)),
  );
});

test("a step recolours just what it changed, in both directions", () => {
  for (const overlay of ["none", "errors"]) {
    const { model, picture } = painted(0, overlay);
    for (const step of [5, 31, 30, 40, 0, 1]) {
      picture.cells.changed = player.newBox();
      const before = [...picture.cells.pixels];
      player.paintEntries(picture, model, player.seek(model.log, step));
      const there = painted(step, overlay);
      assert.deepEqual([...picture.cells.pixels], [...there.picture.cells.pixels]);
      assert.deepEqual([...picture.unseen.pixels], [...there.picture.unseen.pixels]);
      assert.deepEqual(picture.cells.changed, boxOfChanges(before, picture.cells.pixels, model.log));
    }
  }
});

// The smallest box around the pixels that differ.
function boxOfChanges(before, after, { nCols }) {
  const box = player.newBox();
  before.forEach((pixel, c) => {
    if (pixel === after[c]) return;
    const [x, y] = [c % nCols, Math.floor(c / nCols)];
    Object.assign(box, { x0: Math.min(box.x0, x), y0: Math.min(box.y0, y) });
    Object.assign(box, { x1: Math.max(box.x1, x), y1: Math.max(box.y1, y) });
  });
  return box;
}
