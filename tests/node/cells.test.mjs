import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";
import { CONSTANTS, randomReplay } from "./worlds.mjs";

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
  unseen: "#050505",
};
const PRIOR = { p_wall: 0.2, p_space: 0.9, uninformative: false, rule: "prior_once" };

const rgb = (pixel) => [pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255];

function painted(step, view, seed = 2) {
  const world = randomReplay(seed);
  const model = player.newModel(world.replay, CONSTANTS);
  const state = { ...PRIOR, overlay: "none", region: "explored", ...view };
  player.setPrior(model, state);
  player.seek(model, step);
  const picture = { colours: COLOURS, pixels: new Uint32Array(model.nCells) };
  player.paintAll(picture, model, state);
  return { world, model, picture, pixels: [...picture.pixels].map(rgb) };
}

test("a pixel keeps red in the low byte and is opaque", () => {
  assert.equal(player.pixelOf(player.rgbOf("#123456")), 0xff563412);
});

// Prior 0.18 of wall cells is 45.9 of 255, 0.81 of the others 206.55.
test("before the first reading the map is the drawing: dark where it has walls", () => {
  const { model, pixels } = painted(0, {});
  pixels.forEach((pixel, c) => {
    assert.deepEqual(pixel, model.isWall[c] ? [46, 46, 46] : [207, 207, 207]);
  });
});

// 46 + 0.55 * (0xaa - 46) = 114.2, and so on; 0x44 = 68, 0x99 = 153.
test("the wall mask tints the drawing's wall cells and no other", () => {
  const { model, pixels } = painted(0, { overlay: "wall_mask" });
  pixels.forEach((pixel, c) => {
    assert.deepEqual(pixel, model.isWall[c] ? [114, 58, 105] : [207, 207, 207]);
  });
});

test("the ground truth tints the cells that are wall in truth", () => {
  const plain = painted(12, {}).pixels;
  const { model, pixels } = painted(12, { overlay: "truth" });
  pixels.forEach((pixel, c) => {
    assert.equal(pixel[0] === plain[c][0] && pixel[1] === plain[c][1], !model.truth[c]);
  });
});

for (const region of ["explored", "all", "unexplored"]) {
  test(`errors are told apart, ${region} cells scored`, () => {
    const { model, pixels } = painted(2, { overlay: "errors", region });
    pixels.forEach(([value], c) => {
      const l = player.logOddsAt(model, c);
      const outcome = l < -1e-9 ? (model.truth[c] ? 1 : 2) : model.truth[c] ? 3 : 4;
      assert.equal(value, region === (model.counts[c] ? "unexplored" : "explored") ? 5 : outcome);
    });
    assert.ok([...model.counts].includes(0));
  });
}

test("a step recolours just what it changed, in both directions", () => {
  for (const overlay of ["none", "errors"]) {
    const { model, picture } = painted(0, { overlay });
    for (const step of [5, 31, 30, 40, 0, 1]) {
      picture.stale = false;
      player.paintEntries(picture, model, player.seek(model, step));
      assert.ok(picture.stale);
      assert.deepEqual([...picture.pixels].map(rgb), painted(step, { overlay }).pixels);
    }
    picture.stale = false;
    player.paintEntries(picture, model, player.seek(model, model.step));
    assert.equal(picture.stale, false);
  }
});
