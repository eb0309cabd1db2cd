import assert from "node:assert/strict";
import { test } from "node:test";
import { load, seeded } from "./scripts.mjs";
import {
  CONSTANTS,
  logit,
  naiveCounts,
  naiveLogOdds,
  randomReplay,
  replayOf,
  STATES,
} from "./worlds.mjs";

const player = load("player");

const close = (actual, expected, message) =>
  assert.ok(Math.abs(actual - expected) < 1e-9, `${message}: ${actual}, not ${expected}`);

function modelOf(replay, state) {
  const model = player.newModel(replay, CONSTANTS);
  player.setPrior(model, state);
  return model;
}

// Two cells, wall and space; p_wall = 0.5, p_space = 1: priors 0.45 and 0.9. The wall cell
// is read 0.9, then 0.1; the space cell 0.1 once. In log-odds, ln 9 = 2.19722458:
// prior once: ln(0.45/0.55) = -0.2006706955 in the end, and 2.19722458 - 2.19722458 = 0.
// Subtract prior: l_0 + 0 - 2 l_0 = 0.2006706955, and 0 - ln 9.
const LN9 = logit(0.9);
const byHand = () =>
  replayOf(
    1,
    2,
    3,
    [
      [
        [0, LN9],
        [1, -LN9],
      ],
      [[0, -LN9]],
    ],
    { isWall: [1, 0], truth: [1, 0] },
  );
const handPrior = { p_wall: 0.5, p_space: 1, uninformative: false };

test("prior once counts the drawing once", () => {
  const model = modelOf(byHand(), { ...handPrior, rule: "prior_once" });
  close(player.logOddsAt(model, 0), -0.2006706955, "prior of the wall cell");
  player.seek(model, 2);
  close(player.logOddsAt(model, 0), Math.log(0.45 / 0.55), "wall cell");
  close(player.logOddsAt(model, 1), 0, "space cell");
});

test("subtract prior subtracts l_0 at every reading", () => {
  const model = modelOf(byHand(), { ...handPrior, rule: "subtract_prior" });
  player.seek(model, 2);
  close(player.logOddsAt(model, 0), -Math.log(0.45 / 0.55), "wall cell");
  close(player.logOddsAt(model, 1), -LN9, "space cell");
});

test("an exact tie is no wall, in map and scores", () => {
  const state = { ...handPrior, rule: "prior_once", region: "explored" };
  const model = modelOf(byHand(), state);
  player.seek(model, 1);
  assert.equal(player.outcomeAt(model, 1, player.logOddsAt(model, 1)), 3);
  const { counts } = player.scoreCurves(model, "explored");
  assert.deepEqual(
    counts.map((curve) => curve[1]),
    [0, 0, 1, 1],
  );
});

test("the decision is strict on both sides of its band", () => {
  const model = modelOf(byHand(), { ...handPrior, rule: "prior_once" });
  for (const [logOdds, isWall] of [
    [0, false],
    [-1e-10, false],
    [1, false],
    [-1e-8, true],
  ]) {
    assert.equal(player.declaresWall(model, logOdds), isWall, String(logOdds));
  }
});

test("an uninformative prior is one half, and both rules agree", () => {
  const { replay } = randomReplay(1);
  const state = { p_wall: 0.2, p_space: 0.9, uninformative: true };
  const once = modelOf(replay, { ...state, rule: "prior_once" });
  const subtract = modelOf(replay, { ...state, rule: "subtract_prior" });
  assert.deepEqual(once.pFreePrior, [0.5, 0.5]);
  player.seek(once, 40);
  player.seek(subtract, 40);
  for (let c = 0; c < 30; c++) {
    assert.equal(player.logOddsAt(once, c), player.logOddsAt(subtract, c));
  }
});

test("any walk through the steps gives exactly what a naive fusion gives", () => {
  const random = seeded(7);
  for (const [i, state] of STATES.entries()) {
    const world = randomReplay(i);
    const model = modelOf(world.replay, state);
    for (let walk = 0; walk < 6; walk++) {
      const step = Math.floor(random() * 41);
      player.seek(model, step);
      const expected = naiveLogOdds(world, step, state);
      expected.forEach((l, c) => assert.equal(player.logOddsAt(model, c), l, `cell ${c}`));
    }
  }
});

test("a step tells the entries that changed, forwards and back", () => {
  const { replay } = randomReplay(3);
  const model = modelOf(replay, STATES[0]);
  assert.deepEqual(player.seek(model, 9), [0, replay.indptr[9]]);
  assert.deepEqual(player.seek(model, 4), [replay.indptr[4], replay.indptr[9]]);
  assert.deepEqual(player.seek(model, 4), [replay.indptr[4], replay.indptr[4]]);
});

test("the counts at every step are those of a naive score", () => {
  for (const [i, state] of STATES.entries()) {
    const world = randomReplay(i);
    const curves = player.scoreCurves(modelOf(world.replay, state), state.region);
    for (let step = 0; step <= 40; step++) {
      const { counts, explored } = naiveCounts(world, step, state);
      assert.deepEqual(
        curves.counts.map((curve) => curve[step]),
        counts,
        `step ${step}`,
      );
      assert.equal(curves.explored[step], explored);
    }
  }
});

// 3 hits, 1 false wall, 2 missed, 4 of 20 cells explored: precision 3/4, recall 3/5,
// F2 = 5 * 3 / (5 * 3 + 4 * 2 + 1) = 15/24, coverage 4/20.
test("scores follow from the counts, and 0 / 0 is undefined", () => {
  const counts = [
    [0, 3],
    [0, 1],
    [0, 2],
    [0, 9],
  ].map((curve) => Uint32Array.from(curve));
  const series = player.scoreSeries({ counts, explored: Uint32Array.of(0, 4) }, 20);
  assert.deepEqual(
    Object.fromEntries(Object.entries(series).map(([name, values]) => [name, values[1]])),
    { precision: 0.75, recall: 0.6, f2: 0.625, coverage: 0.2 },
  );
  for (const name of ["precision", "recall", "f2"]) assert.ok(Number.isNaN(series[name][0]));
  assert.equal(series.coverage[0], 0);
});

test("a cell's history adds up to its log-odds", () => {
  for (const state of STATES) {
    const world = randomReplay(11);
    const model = modelOf(world.replay, state);
    player.seek(model, 40);
    for (let c = 0; c < 30; c++) {
      const { prior, terms } = player.historyOf(model, c);
      const readings = world.readings.flatMap((cells, s) =>
        cells.some(([cell]) => cell === c) ? [s] : [],
      );
      assert.deepEqual(
        terms.map(({ reading }) => reading),
        readings,
      );
      const total = terms.reduce((sum, { added }) => sum + added, prior);
      close(total, player.logOddsAt(model, c), `cell ${c}`);
      if (terms.length) close(terms.at(-1).total, total, "last total");
    }
  }
});

test("p_free is the inverse of log-odds, without overflow", () => {
  for (const p of [0.1, 0.5, 0.81, 0.999]) close(player.pFreeOf(player.logit(p)), p, "p");
  assert.equal(player.pFreeOf(800), 1);
  assert.equal(player.pFreeOf(-800), 0);
});

test("log-odds lie on a lattice, on which a tie is exactly zero", () => {
  for (let p = 0.01; p < 1; p += 0.01) {
    assert.ok(Number.isInteger(player.logit(p) * 2 ** 36));
    close(player.logit(p), Math.log(p / (1 - p)), "logit");
  }
  for (const p of [0.1, 0.18, 0.45, 0.09]) assert.equal(player.logit(p) + player.logit(1 - p), 0);
});
