// The home page's replay: it stops half-way with a question, and its rule can be switched.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { load } from "./scripts.mjs";
import { CONSTANTS, naiveCounts, randomReplay, replayOf } from "./worlds.mjs";

const player = load("player");

let committed = [];
let isStill = false;
globalThis.refresh = () => {};
globalThis.showPlaying = () => {};
globalThis.commit = (p) => committed.push([p.state.step, p.state.predicted]);
globalThis.recolour = (p) => p.state.columns.forEach((setting, i) => player.setPrior(p.columns[i], setting));
globalThis.cancelAnimationFrame = () => {};
globalThis.requestAnimationFrame = () => 1;
globalThis.matchMedia = () => ({ matches: isStill });
beforeEach(() => {
  committed = [];
  isStill = false;
});

const SOURCE = { p_wall: 0.2, p_space: 0.9, uninformative: false, rule: "prior_once" };
const SETTINGS = [
  { ...SOURCE, prior_drawing: "own", uninformative: true },
  { ...SOURCE, prior_drawing: "own" },
  { ...SOURCE, prior_drawing: "d" },
];
const STORY = {
  maps: { none: "No drawing", own: "This building's", other: "Another's" },
  answers: { none: "No drawing", own: "Its own", other: "The wrong one" },
  watch: "Watch.",
  question: "Which?",
};

// 40 readings of 30 cells, 5 a second, the other drawing the negative of its own.
function storyOf(changes = {}) {
  const world = randomReplay(1);
  const { replay } = world;
  const log = player.newLog(replay);
  const walls = [replay.drawn, replay.drawn, replay.drawn.map((said) => [1, 0, 2][said])];
  const state = { columns: SETTINGS.map((one) => ({ ...one })), step: 0, speed: 5, predicted: null, compact: true };
  const p = {
    root: { querySelector: () => ({}), focus: () => {} },
    scene: { nReadings: 40 },
    header: { constants: CONSTANTS, texts: { story: STORY }, hidden: [], locked: [] },
    logs: new Map(),
    columns: walls.map((drawn) => player.newColumn(log, drawn, CONSTANTS)),
    state: { ...state, ...changes },
    playing: false,
    position: 0,
  };
  globalThis.paintEntries = () => {};
  player.recolour(p);
  return { p, world, walls };
}

const playFor = (p, seconds) => {
  for (let i = 0; i < Math.round(10 * seconds); i++) if (p.playing) player.advance(p, 0.1);
};

test("it stops half-way, once, and asks", () => {
  const { p } = storyOf();
  player.play(p);
  playFor(p, 3.9);
  assert.deepEqual([p.state.step, p.playing, player.tellingWords(p)], [19, true, "Watch."]);
  playFor(p, 5);
  assert.deepEqual([p.state.step, p.playing, player.tellingWords(p)], [20, false, "Which?"]);
  assert.deepEqual(committed, [[20, null]]);
});

test("a long frame does not jump over the question", () => {
  const { p } = storyOf();
  player.play(p);
  player.advance(p, 60);
  assert.deepEqual([p.state.step, p.position, p.playing], [20, 20, false]);
});

test("an answer lets it drive on to the end, and is shown there beside what came out", () => {
  const { p } = storyOf({ step: 20 });
  player.vote(p, 2);
  assert.deepEqual([p.playing, committed], [true, [[20, 2]]]);
  playFor(p, 1);
  assert.equal(player.tellingWords(p), "You said: the wrong one.");
  playFor(p, 5);
  assert.deepEqual([p.state.step, p.playing], [40, false]);
  assert.deepEqual(committed.at(-1), [40, 2]);
  assert.match(player.tellingWords(p), /^You said: the wrong one\. Best where the robot looked: /);
});

test("who was asked once is not asked again", () => {
  const { p } = storyOf({ step: 0, predicted: 1 });
  player.play(p);
  player.advance(p, 60);
  assert.deepEqual([p.state.step, p.playing], [40, false]);
});

test("who does not answer can play on", () => {
  const { p } = storyOf({ step: 20 });
  player.play(p);
  playFor(p, 9);
  assert.deepEqual([p.state.step, p.state.predicted], [40, null]);
  assert.match(player.tellingWords(p), /^Best where the robot looked: /);
});

test("who wants no motion is shown the end at once", () => {
  isStill = true;
  const { p } = storyOf({ step: 20 });
  player.vote(p, 0);
  assert.deepEqual([p.state.step, p.playing], [40, false]);
});

test("other replays do not stop half-way", () => {
  const { p } = storyOf({ compact: false });
  player.play(p);
  player.advance(p, 60);
  assert.equal(p.state.step, 40);
});

test("it lasts longer than other replays, unless a speed was chosen", () => {
  const scene = { nReadings: 240 };
  assert.equal(player.speedOf({ state: { speed: null, compact: true }, scene }), 10);
  assert.equal(player.speedOf({ state: { speed: null, compact: false }, scene }), 24);
  assert.equal(player.speedOf({ state: { speed: 60, compact: true }, scene }), 60);
});

test("the switch changes the rule of all maps at once", () => {
  const { p } = storyOf({ step: 40 });
  const rules = () => [p.state.columns.map(({ rule }) => rule), p.columns.map(({ once }) => once)];
  player.countBy(p, "subtract_prior");
  assert.deepEqual(rules(), [Array(3).fill("subtract_prior"), Array(3).fill(false)]);
  player.countBy(p, "prior_once");
  assert.deepEqual(rules(), [Array(3).fill("prior_once"), Array(3).fill(true)]);
  assert.equal(committed.length, 2);
});

test("F2 under both rules is that of a naive fusion, whatever is shown now", () => {
  const { p, world, walls } = storyOf({ step: 7 });
  player.finalF2(p).forEach((found, i) => {
    for (const rule of ["prior_once", "subtract_prior"]) {
      const pair = SETTINGS[i].uninformative ? { p_wall: 0.5 / 0.9, p_space: 0.5 / 0.9 } : SOURCE;
      const own = { ...world, drawn: Array.from(walls[i]) };
      const [tp, fp, fn] = naiveCounts(own, 40, { ...pair, rule }, "looked").counts;
      assert.equal(found[rule], (5 * tp) / (5 * tp + 4 * fn + fp), `${i} ${rule}`);
    }
  });
});

test("F2 is shown before and after only where the drawing is counted again", () => {
  const { p } = storyOf({ step: 40 });
  const [, { prior_once, subtract_prior }] = player.finalF2(p);
  assert.equal(player.f2Change(p, 1), player.percent(prior_once));
  player.countBy(p, "subtract_prior");
  const change = `${player.percent(prior_once)} \u2192 ${player.percent(subtract_prior)}`;
  assert.equal(player.f2Change(p, 1), change);
});

// One wall cell and one free cell, each read once; only the right drawing outweighs a
// reading of 0.6 that calls the wall free, and the negative one makes the free cell a wall.
test("the best is named by F2 with the drawing counted once, under either rule", () => {
  const logit = (q) => Math.log(q / (1 - q));
  const readings = [[[0, logit(0.6)], [1, logit(0.6)]]];
  const replay = replayOf(1, 2, 1, readings, { drawn: [1, 0], truth: [1, 0] });
  const { p } = storyOf();
  const log = player.newLog(replay);
  p.columns = [[1, 0], [1, 0], [0, 1]].map((drawn) => player.newColumn(log, drawn, CONSTANTS));
  assert.equal(player.bestOf(p), 1);
  p.finalF2 = null;
  for (const setting of p.state.columns) setting.rule = "subtract_prior";
  assert.equal(player.bestOf(p), 1);
});

test("a map is named after what it starts from", () => {
  assert.deepEqual(SETTINGS.map(player.startOf), ["none", "own", "other"]);
});
