import assert from "node:assert/strict";
import { test } from "node:test";
import { load, seeded } from "./scripts.mjs";
import {
  CONSTANTS,
  columnOf,
  logit,
  naiveLogOdds,
  randomReplay,
  replayOf,
  STATES,
} from "./worlds.mjs";

const player = load("player");

const close = (actual, expected, message) =>
  assert.ok(Math.abs(actual - expected) < 1e-9, `${message}: ${actual}, not ${expected}`);

const modelOf = (replay, state) => columnOf(player, replay, state);

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
    { drawn: [1, 0], truth: [1, 0] },
  );
const handPrior = { p_wall: 0.5, p_space: 1, uninformative: false };

test("prior once counts the drawing once", () => {
  const model = modelOf(byHand(), { ...handPrior, rule: "prior_once" });
  close(player.logOddsAt(model, 0), -0.2006706955, "prior of the wall cell");
  player.seek(model.log, 2);
  close(player.logOddsAt(model, 0), Math.log(0.45 / 0.55), "wall cell");
  close(player.logOddsAt(model, 1), 0, "space cell");
});

test("subtract prior subtracts l_0 at every reading", () => {
  const model = modelOf(byHand(), { ...handPrior, rule: "subtract_prior" });
  player.seek(model.log, 2);
  close(player.logOddsAt(model, 0), -Math.log(0.45 / 0.55), "wall cell");
  close(player.logOddsAt(model, 1), -LN9, "space cell");
});

test("an exact tie is no wall, in map and scores", () => {
  const state = { ...handPrior, rule: "prior_once" };
  const model = modelOf(byHand(), state);
  player.seek(model.log, 1);
  assert.equal(player.outcomeAt(model, 1, player.logOddsAt(model, 1)), 3);
  const { counts } = player.scoreCurves(model).looked;
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
  player.seek(once.log, 40);
  player.seek(subtract.log, 40);
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
      player.seek(model.log, step);
      const expected = naiveLogOdds(world, step, state);
      expected.forEach((l, c) => assert.equal(player.logOddsAt(model, c), l, `cell ${c}`));
    }
  }
});

test("a step tells the entries that changed, forwards and back", () => {
  const { replay } = randomReplay(3);
  const model = modelOf(replay, STATES[0]);
  assert.deepEqual(player.seek(model.log, 9), [0, replay.indptr[9]]);
  assert.deepEqual(player.seek(model.log, 4), [replay.indptr[4], replay.indptr[9]]);
  assert.deepEqual(player.seek(model.log, 4), [replay.indptr[4], replay.indptr[4]]);
});

test("a cell's history adds up to its log-odds", () => {
  for (const state of STATES) {
    const world = randomReplay(11);
    const model = modelOf(world.replay, state);
    player.seek(model.log, 40);
    for (let c = 0; c < 30; c++) {
      const { prior, terms } = player.historyOf(model, c);
      const readings = world.readings.flatMap((cells, s) =>
        cells.some(([cell]) => cell === c) ? [s] : [],
      );
      assert.deepEqual(
        terms.map(({ reading }) => reading),
        readings,
      );
      for (const { said, off, added } of terms) {
        assert.equal(off, state.rule === "subtract_prior" ? -prior : 0);
        assert.equal(added, said + off);
      }
      const total = terms.reduce((sum, { added }) => sum + added, prior);
      close(total, player.logOddsAt(model, c), `cell ${c}`);
      if (terms.length) close(terms.at(-1).total, total, "last total");
    }
  }
});

test("after some laps a map is that of the same readings, repeated", () => {
  const { replay, readings, drawn, truth } = randomReplay(3);
  const thrice = replayOf(5, 6, 3, [...readings, ...readings, ...readings], { drawn, truth });
  for (const state of STATES) {
    const laps = modelOf(replay, { ...state, laps: "3" });
    const all = modelOf(thrice, state);
    player.seek(laps.log, replay.nReadings);
    player.seek(all.log, thrice.nReadings);
    for (let c = 0; c < replay.nCells; c++) {
      close(player.logOddsAt(laps, c), player.logOddsAt(all, c), `cell ${c}`);
      const { prior, terms } = player.historyOf(laps, c);
      const total = terms.reduce((sum, { added }) => sum + added, prior);
      close(total, player.logOddsAt(laps, c), `ladder of cell ${c}`);
    }
    const [of, end] = [player.scoreCurves(laps).looked, player.scoreCurves(all).looked];
    assert.deepEqual(
      of.counts.map((curve) => curve[replay.nReadings]),
      end.counts.map((curve) => curve[thrice.nReadings]),
    );
  }
});

test("one log serves all columns on it, each with its own prior", () => {
  const world = randomReplay(5);
  const log = player.newLog(world.replay);
  const columns = STATES.map((state) => {
    const column = player.newColumn(log, world.replay.drawn, CONSTANTS);
    player.setPrior(column, state);
    return column;
  });
  player.seek(log, 17);
  columns.forEach((column, i) => {
    const expected = naiveLogOdds(world, 17, STATES[i]);
    expected.forEach((l, c) => assert.equal(player.logOddsAt(column, c), l));
  });
});

// Of three wall cells one is free in truth, of five space cells four: (1 + 1) / (3 + 2)
// and (4 + 1) / (5 + 2). Of the last two cells the drawing says nothing.
test("the calibrated pair is the smoothed share of each class that is free", () => {
  const classes = { drawn: [1, 1, 1, 0, 0, 0, 0, 0, 2, 2], truth: [1, 0, 1, 0, 0, 1, 0, 0, 1, 0] };
  const replay = replayOf(2, 5, 3, [[[0, 1]]], classes);
  const model = modelOf(replay, { ...handPrior, calibrated: true, rule: "prior_once" });
  assert.deepEqual(model.pFreePrior, [5 / 7, 2 / 5]);
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

// Per entry visits + hits / 1024. Cell 0: 2 of 5 beams end there, cell 1: 1 of 4, exactly a
// quarter, cell 2: none; gmapping publishes only what is above a quarter as occupied.
test("a map of counts declares a wall where more than a quarter of its beams end", () => {
  const evidence = {
    nReadings: 2,
    nCells: 3,
    indptr: Uint32Array.of(0, 2, 3),
    cell: Uint32Array.of(0, 1, 0),
    logOdds: Float64Array.of(2 + 1 / 1024, 4 + 1 / 1024, 3 + 1 / 1024),
    truth: new Uint8Array(3),
  };
  const constants = { decisionEps: 1e-9, priorScale: 0.9, declared: 2, hit: 1 / 1024, occupiedAbove: 0.25 };
  const log = player.newLog(player.countsOfBeams(evidence, constants));
  const column = player.newColumn(log, new Uint8Array(3), constants);
  player.setPrior(column, { p_wall: 0.2, p_space: 0.9, uninformative: false, rule: "subtract_prior" });
  const maps = [0, 1, 2].map((step) => {
    player.seek(log, step);
    return [0, 1, 2].map((c) => player.logOddsAt(column, c));
  });
  assert.deepEqual(maps, [
    [0, 0, 0],
    [-2, 2, 0],
    [-2, 2, 0],
  ]);
  assert.deepEqual(player.beamsOf(log, 0), { hits: 2, visits: 5 });
  player.seek(log, 1);
  assert.deepEqual(player.beamsOf(log, 0), { hits: 1, visits: 2 });
  assert.deepEqual(player.beamsOf(log, 2), { hits: 0, visits: 0 });
});
