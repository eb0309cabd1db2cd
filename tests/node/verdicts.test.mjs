import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";
import { columnOf, CONSTANTS, logit, randomReplay, replayOf, STATES } from "./worlds.mjs";

const player = load("player");

const ONCE = { p_wall: 0.2, p_space: 0.9, rule: "prior_once" };
const SUBTRACT = { ...ONCE, rule: "subtract_prior" };

// Two columns on one log.
function pairOf(replay, settings) {
  const log = player.newLog(replay);
  return settings.map((setting) => {
    const column = player.newColumn(log, replay.drawn, CONSTANTS);
    player.setPrior(column, setting);
    return column;
  });
}

// Cells: wall in drawing and truth; wall in the drawing only; space and free, unseen.
// The first is read 0.5 twice: once keeps 0.18, subtract ends at 1 - 0.18. The second the
// same. The third keeps the prior 0.81 under both.
test("the referee says which of two maps is right, by hand", () => {
  const reading = [
    [0, 0],
    [1, 0],
  ];
  const classes = { drawn: [1, 1, 0], truth: [1, 0, 0] };
  const [a, b] = pairOf(replayOf(1, 3, 2, [reading, reading], classes), [ONCE, SUBTRACT]);
  player.seek(a.log, 2);
  const comparison = player.newComparison(a, b, null);
  assert.deepEqual(player.countsOf(comparison, true), { differ: 2, right: [1, 1] });
  assert.deepEqual(player.countsOf(comparison, false), { differ: 0, right: [0, 0] });
  assert.deepEqual(player.verdictsAt(comparison, 0), [true, false]);
  assert.equal(player.nextDifference(comparison, [0], true, -1), 0);
  assert.equal(player.nextDifference(comparison, [1], true, -1), 1);
  assert.equal(player.nextDifference(comparison, [0, 1], true, 1), 0); // round again
  assert.equal(player.nextDifference(comparison, [0, 1], false, -1), null);
});

// One map has a reading of cell 0, the other of cell 1: neither is looked at by both.
test("cells that one map looked at are not called not looked at", () => {
  const classes = { drawn: [0, 0], truth: [0, 0] };
  const [a, b] = [0, 1].map((cell) => {
    const [column] = pairOf(replayOf(1, 2, 1, [[[cell, -1]]], classes), [ONCE]);
    player.seek(column.log, 1);
    return column;
  });
  const comparison = player.newComparison(a, b, null);
  assert.equal(player.countsOf(comparison, true).differ, 0);
  assert.equal(player.otherUnits(comparison, "cells"), "other cells");
  assert.equal(player.otherUnits({ pair: [a, a] }, "cells"), "cells not looked at");
});

// One cell at a time, as a naive referee would.
function naiveTally([a, b], truth) {
  const tally = { true: [0, 0], false: [0, 0] };
  truth.forEach((isWall, c) => {
    const [va, vb] = [a, b].map((map) => player.logOddsAt(map, c) < -1e-9);
    if (va === vb) return;
    const looked = a.log.counts[c] > 0 && b.log.counts[c] > 0;
    tally[looked][va === Boolean(isWall) ? 0 : 1]++;
  });
  return tally;
}

function rejudged(comparison, steps) {
  const logs = new Set(comparison.pair.map(({ log }) => log));
  for (const log of logs) {
    const [from, to] = player.seek(log, steps);
    for (let e = from; e < to; e++) {
      player.eachUnit(comparison, log, log.cell[e], (u) => player.judge(comparison, u));
    }
  }
}

test("any walk through the steps keeps the count of a naive referee", () => {
  for (let seed = 0; seed < STATES.length; seed++) {
    const { replay, truth } = randomReplay(seed);
    const pair = pairOf(replay, [STATES[seed], STATES[(seed + 3) % STATES.length]]);
    const comparison = player.newComparison(...pair, null);
    for (const step of [0, 3, 40, 12, 13, 0, 7]) {
      rejudged(comparison, step);
      const expected = naiveTally(pair, truth);
      for (const looked of [true, false]) {
        assert.deepEqual(player.countsOf(comparison, looked).right, expected[looked]);
      }
      assert.equal(comparison.tally.reduce((a, b) => a + b), 30);
    }
  }
});

// 4 x 4 px: A has cells of 2, B of 4. A declares its cell at the top left a wall, B
// nothing. The world is wall in the first column: 2 of the 4 pixels of that cell, so A is
// right twice and B twice; the others agree. B was looked at, A only in that cell.
test("maps of other cell sizes are judged pixel by pixel, against the world's pixels", () => {
  const fine = { drawn: [0, 0, 0, 0], truth: [1, 0, 1, 0] };
  const a = columnOf(player, replayOf(2, 2, 2, [[[0, 3 * logit(0.1)]]], fine), ONCE);
  const coarse = { drawn: [0], truth: [1] };
  const b = columnOf(player, replayOf(1, 1, 4, [[[0, logit(0.9)]]], coarse), ONCE);
  const truth = Uint8Array.from({ length: 16 }, (_, u) => (u % 4 === 0 ? 1 : 0));
  const size = { heightPx: 4, widthPx: 4, cellPx: 1, nRows: 4, nCols: 4, nCells: 16 };
  const comparison = player.newComparison(a, b, { ...size, truth });
  assert.equal(comparison.isByCell, false);
  assert.deepEqual(player.countsOf(comparison, true), { differ: 0, right: [0, 0] });
  rejudged(comparison, 1);
  assert.deepEqual(player.countsOf(comparison, true), { differ: 4, right: [2, 2] });
  const other = player.newComparison(b, a, comparison);
  for (const { tally } of [comparison, other]) assert.equal(tally[4], 0); // looked at by one
  assert.equal(player.nextDifference(comparison, [1], true, -1), 1);
});

// ---- ladders --------------------------------------------------------------------------

// d's cell of the science page: a wall cell, read 0.9 and 0.1. Once: 0.18, then
// logit(0.18) + ln 9, then 0.18 again; subtract: 0.18, 0.9, 0.82.
test("a reading is one rung where the drawing is counted once, two where it is taken off", () => {
  const readings = [[[0, logit(0.9)]], [[0, logit(0.1)]]];
  const replay = replayOf(1, 1, 3, readings, { drawn: [1], truth: [1] });
  const rungs = [ONCE, SUBTRACT].map((setting) => {
    const column = columnOf(player, replay, setting);
    return player.ladderOf(player.historyOf(column, 0), 1);
  });
  const p = (bars) => bars.map(({ to }) => Number(player.pFreeOf(to).toFixed(3)));
  assert.deepEqual(p(rungs[0]), [0.18, 0.664, 0.18]);
  assert.deepEqual(p(rungs[1]), [0.18, 0.664, 0.9, 0.5, 0.82]);
  assert.deepEqual(rungs[1].map(({ isOff }) => Boolean(isOff)), [false, false, true, false, true]);
  assert.deepEqual(rungs[1].map(({ isDone }) => isDone), [true, true, true, false, false]);
  for (const bars of rungs) {
    for (let i = 1; i < bars.length; i++) assert.equal(bars[i].from, bars[i - 1].to);
  }
});
