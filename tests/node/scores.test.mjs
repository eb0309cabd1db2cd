import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";
import { columnOf, CONSTANTS, naiveCounts, randomReplay, STATES } from "./worlds.mjs";

const player = load("player");

const close = (actual, expected, message) =>
  assert.ok(Math.abs(actual - expected) < 1e-9, `${message}: ${actual}, not ${expected}`);

test("counts and bits at every step, in both regions, are those of a naive score", () => {
  for (const [i, state] of STATES.entries()) {
    const world = randomReplay(i);
    const curves = player.scoreCurves(columnOf(player, world.replay, state));
    for (const region of ["looked", "unseen"]) {
      for (let step = 0; step <= 40; step++) {
        const { counts, bits, explored } = naiveCounts(world, step, state, region);
        const found = curves[region].counts.map((curve) => curve[step]);
        assert.deepEqual(found, counts, `step ${step}`);
        close(curves[region].bits[step], bits, `bits at step ${step}`);
        assert.equal(curves.explored[step], explored);
      }
    }
  }
});

const curveOf = (counts, bits) => ({
  counts: counts.map((n) => Uint32Array.of(0, n)),
  bits: Float64Array.of(0, bits),
});

// Looked at: 3 hits, 1 false wall, 2 missed, 4 of 20 cells explored: precision 3/4, recall
// 3/5, F2 = 5 * 3 / (5 * 3 + 4 * 2 + 1) = 15/24, coverage 4/20; 2 bits over 15 cells. Not
// looked at: 5 free cells of 1 bit each; so all 20 cells have 7 bits.
test("scores follow from the counts, and 0 / 0 is undefined", () => {
  const curves = {
    looked: curveOf([3, 1, 2, 9], 2),
    unseen: curveOf([0, 0, 0, 5], 5),
    explored: Uint32Array.of(0, 4),
  };
  const series = player.scoreSeries(curves, 20);
  const names = ["precision", "recall", "f2", "bits", "found", "falseWalls"];
  const at = (region) => names.map((name) => series[region][name][1]);
  assert.deepEqual(at("looked"), [0.75, 0.6, 0.625, 2 / 15, 3, 1]);
  assert.deepEqual(at("unseen"), [NaN, NaN, NaN, 1, 0, 0]);
  assert.equal(series.all.bits[1], 7 / 20);
  const rest = player.regionSeries(curveOf([0, 0, 0, 0], 1e-12)); // rounding's
  assert.ok(Number.isNaN(rest.bits[1]));
  assert.equal(series.coverage[1], 0.2);
  for (const name of names.slice(0, 4)) assert.ok(Number.isNaN(series.looked[name][0]));
});

test("before any reading the blank map lacks one bit in each cell and finds no wall", () => {
  const { replay } = randomReplay(4);
  const log = player.newLog(replay);
  const blank = player.blankSeries(log, CONSTANTS);
  assert.equal(player.blankSeries(log, CONSTANTS), blank);
  close(blank.unseen.bits[0], 1, "bits");
  assert.equal(blank.unseen.found[0], 0);
});

test("bits are finite and exact however sure a cell is", () => {
  assert.equal(player.surprise(1, 0), 1);
  close(player.surprise(0, Math.log(0.9 / 0.1)), -Math.log2(0.9), "free");
  close(player.surprise(1, Math.log(0.9 / 0.1)), -Math.log2(0.1), "wall");
  close(player.surprise(1, 2000), 2000 / Math.LN2, "surely wrong");
  assert.equal(player.surprise(0, 2000), 0);
});

test("a map is worth the readings after which the blank map is as good", () => {
  const blank = [NaN, 0.2, 0.5, 0.4, 0.9];
  const worth = (value, sign) => player.worthInReadings(blank, [value], 0, sign);
  assert.deepEqual([0.1, 0.5, 0.51, 0.95].map((v) => worth(v, 1)), [1, 2, 4, null]);
  assert.deepEqual([0.6, 0.4, 0.1].map((v) => worth(v, -1)), [1, 1, null]);
  assert.equal(worth(NaN, 1), null);
  assert.equal(worth(0.5 + 1e-13, 1), 2); // rounding decides nothing
});

// A map of one reading against a blank map that is as good after 1, after 3, or never.
test("what a map is worth is said in words, with one reading and with several", () => {
  const blank = { all: { bits: [1, 0.6, 0.5, 0.2] }, looked: { f2: [NaN, 0.5, 0.5, 0.9] } };
  const words = (bits, f2) =>
    player.worthWords({ all: { bits: [bits] }, looked: { f2: [f2] } }, blank, 0);
  assert.equal(
    words(0.3, 0.4),
    "Blank map: as few bits (all cells) after 3 readings; this F2 (looked at by then) after 1 reading",
  );
  assert.equal(
    words(0.6, 0.9),
    "Blank map: as few bits (all cells) after 1 reading; this F2 (looked at by then) after 3 readings",
  );
  assert.equal(
    words(0.1, 0.95),
    "Blank map: as few bits (all cells) never on this tour; this F2 (looked at by then) never on this tour",
  );
  assert.equal(
    words(1, NaN),
    "Blank map: as few bits (all cells) after 0 readings",
  );
});
