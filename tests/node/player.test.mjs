import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { load } from "./scripts.mjs";
import { columnOf, randomReplay } from "./worlds.mjs";

const player = load("player");

// The page, as far as these functions touch it.
const root = { querySelector: () => ({}) };
let committed = [];
globalThis.refresh = () => {};
globalThis.showPlaying = () => {};
globalThis.commit = (p) => committed.push(p.state.step);
globalThis.cancelAnimationFrame = () => {};
globalThis.requestAnimationFrame = () => 1;
beforeEach(() => (committed = []));

const COLUMN = { p_wall: 0.2, p_space: 0.9, uninformative: false, rule: "prior_once" };
const DOCUMENT = {
  rev: 1,
  columns: [COLUMN],
  overlay: "none",
  step: 0,
  speed: 5,
  pin_px: null,
  compact: false,
};

function playerOf(changes = {}) {
  const { replay } = randomReplay(1);
  const column = columnOf(player, replay, COLUMN);
  column.picture = { cells: layerOf(30), unseen: layerOf(30), inks: player.inksOf(COLOURS, "none") };
  const pixels = { cellPx: 1, nCols: 18, nRows: 15, widthPx: 18, heightPx: 15 };
  const scene = { nReadings: 40, pixels };
  const logs = new Map([["log", column.log]]);
  const state = { ...DOCUMENT, ...changes };
  const header = { hidden: [], locked: [], hasTruth: true, hasPrior: true };
  const p = { root, header, scene, logs, columns: [column], state, playing: false, tab: "scores" };
  player.fitState(p);
  player.seek(column.log, p.state.step);
  return p;
}

const layerOf = (n) => ({ pixels: new Uint32Array(n), changed: player.newBox() });

const COLOURS = Object.fromEntries(
  [
    "beliefOccupied",
    "beliefFree",
    "wallMask",
    "groundTruth",
    "hit",
    "falseWall",
    "missedWall",
    "free",
  ].map((name) => [name, "#123456"]),
);

// ---- playback: 40 readings, 5 a second -------------------------------------------------

test("a replay advances by its speed and keeps the fraction", () => {
  const p = playerOf();
  player.play(p);
  const steps = [0.1, 0.1, 0.1, 0.5].map((seconds) => {
    player.advance(p, seconds);
    return p.state.step;
  });
  assert.deepEqual(steps, [0, 1, 1, 4]);
  assert.equal(p.columns[0].log.step, 4);
});

test("a replay stops at its last reading, once, and says so", () => {
  const p = playerOf({ step: 39 });
  player.play(p);
  player.advance(p, 0.2);
  assert.deepEqual([p.state.step, p.playing, committed], [40, false, [40]]);
  assert.equal(player.pause(p), false);
});

for (const limits of [
  { hidden: ["transport"], locked: [] },
  { hidden: [], locked: ["transport"] },
]) {
  test(`a replay that is held is moved by no key: ${JSON.stringify(limits)}`, () => {
    const p = playerOf({ step: 7 });
    p.header = limits;
    player.play(p);
    player.walkTo(p, 20);
    assert.deepEqual([p.state.step, p.playing, committed], [7, false, []]);
  });
}

test("play at the end starts anew", () => {
  const p = playerOf({ step: 40 });
  player.play(p);
  assert.deepEqual([p.state.step, p.playing], [0, true]);
});

test("a step by hand stops the replay and stays within the readings", () => {
  const p = playerOf({ step: 20 });
  for (const [to, step] of [
    [21, 21],
    [-5, 0],
    [99, 40],
  ]) {
    player.play(p);
    player.walkTo(p, to);
    assert.deepEqual([p.state.step, p.columns[0].log.step, p.playing], [step, step, false]);
  }
  assert.deepEqual(committed, [21, 0, 40]);
});

test("unless a speed was chosen, a replay lasts ten seconds", () => {
  const p = playerOf({ speed: null });
  player.play(p);
  for (let i = 0; i < 99; i++) player.advance(p, 0.1);
  assert.deepEqual([p.state.step, p.playing], [39, true]);
  player.advance(p, 0.2);
  assert.deepEqual([p.state.step, p.playing, p.state.speed], [40, false, null]);
});

// ---- choices restored over other data: 5 x 6 cells of 3 px ------------------------------

test("a step beyond the end becomes the end", () => {
  const p = playerOf({ step: 500 });
  assert.deepEqual([p.state.step, p.position], [40, 40]);
});

test("a pin stays on the cell that now holds its point", () => {
  const p = playerOf({ pin_px: [17.9, 14.9] });
  const { log } = p.columns[0];
  assert.deepEqual([player.cellHolding(log, ...p.pin), p.tab], [29, "cell"]);
});

test("a pin outside the drawing is dropped, not drawn", () => {
  for (const pin_px of [
    [18, 5],
    [5, 15],
    [400, 300],
    [-1, 2],
    [NaN, 1],
  ]) {
    const p = playerOf({ pin_px });
    assert.deepEqual([p.pin, p.state.pin_px, p.tab], [null, null, "scores"]);
  }
});

test("a cell that the edge of the drawing cuts is whole as far as it goes", () => {
  const model = { cellPx: 4, nCols: 3, nRows: 2, widthPx: 10, heightPx: 7 };
  assert.equal(player.cellHolding(model, 9.9, 6.9), 5);
  assert.equal(player.cellHolding(model, 10, 6), null);
  assert.deepEqual(player.boxOf(model, 5), { x: 8, y: 4, width: 2, height: 3 });
  assert.deepEqual(player.centreOf(model, 5), [9, 5.5]);
});

// ---- whose word counts ------------------------------------------------------------------

const headerOf = (key, digest, document) => ({
  key,
  digest,
  document: { ...DOCUMENT, ...document },
});

test("a player that comes back unasked goes on where it was", () => {
  const state = player.adopted(headerOf("a", "x", { rev: 3, step: 7 }), null);
  state.step = 20;
  assert.equal(player.adopted(headerOf("a", "x", { rev: 3, step: 7 }), null).step, 20);
});

test("another rev imposes its document", () => {
  const state = player.adopted(headerOf("b", "x", { rev: 3, step: 7 }), null);
  state.step = 20;
  const next = player.adopted(headerOf("b", "x", { rev: 4, step: 9, overlay: "truth" }), state);
  assert.deepEqual([next.step, next.overlay], [9, "truth"]);
});

test("a word that was overtaken by what was played gives way to it", () => {
  const back = (key, digest, step) => {
    player.adopted(headerOf(key, "x", { rev: 3, step: 7 }), null).step = 20; // not committed
    return player.adopted(headerOf(key, digest, { rev: 4, step }), null).step;
  };
  assert.equal(back("same replay", "x", 7), 20);
  assert.equal(back("another replay", "y", 7), 7);
  assert.equal(back("another step", "x", 8), 8);
});

test("players on other pages are remembered apart", () => {
  player.adopted(headerOf("d", "x", { rev: 3, step: 7 }), null).step = 20;
  assert.equal(player.adopted(headerOf("e", "x", { rev: 3, step: 7 }), null).step, 7);
});
