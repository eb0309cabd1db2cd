import assert from "node:assert/strict";
import { test } from "node:test";
import { load, seeded } from "./scripts.mjs";

const lens = load("lens");

// Those of occsim.sensor; tests/test_lens.py compares whole readings with occsim's.
const CONSTANTS = { edgeEps: 1e-9, ownPixelEps: 5e-7, surfaceDepth: 1.5, pFreeMin: 0.1, pFreeMax: 0.9 };
const SENSOR = { range: 4, fov: Math.PI / 6, isUnseenBehind: false, clears: true };
const LN9 = Math.log(9);

const close = (actual, expected, message = "") =>
  assert.ok(Math.abs(actual - expected) < 1e-9, `${message} ${actual}, not ${expected}`);

// ---- optics: one row of six pixels, wall from the fourth on, as in the example of
// occsim.one_reading --------------------------------------------------------------------

const ROW = lens.worldOf(["...###"]);
const ROBOT = { x: 0.5, y: 0.5, theta: 0 };
const { EMPTY, OBJECT, UNSAID, OUT_OF_VIEW } = lens;

test("pixels before the wall are empty, at it and beyond object, beyond the range unseen", () => {
  const kinds = [...lens.readPixels(ROW, ROBOT, SENSOR, CONSTANTS)];
  assert.deepEqual(kinds, [EMPTY, EMPTY, EMPTY, OBJECT, OBJECT, OUT_OF_VIEW]);
  const cells = lens.countCells(ROW, Uint8Array.from(kinds), 1);
  assert.deepEqual([...cells.inView], [1, 1, 1, 1, 1, 0]);
});

test("if only the surface is read, nothing is said of what lies deeper than 1.5 px", () => {
  const unseen = { ...SENSOR, range: 6, isUnseenBehind: true };
  const kinds = [...lens.readPixels(ROW, ROBOT, unseen, CONSTANTS)];
  // z = 2.5; centres at 3, 4 and 5 px lie 0.5, 1.5 and 2.5 px beyond it.
  assert.deepEqual(kinds, [EMPTY, EMPTY, EMPTY, OBJECT, OBJECT, UNSAID]);
});

test("a ray without a hit clears its pixels or says nothing", () => {
  const open = lens.worldOf(["......"]);
  const kinds = (clears) => [...lens.readPixels(open, ROBOT, { ...SENSOR, clears }, CONSTANTS)];
  assert.deepEqual(kinds(true), [EMPTY, EMPTY, EMPTY, EMPTY, EMPTY, OUT_OF_VIEW]);
  // The robot's own pixel has no ray.
  assert.deepEqual(kinds(false), [EMPTY, UNSAID, UNSAID, UNSAID, UNSAID, OUT_OF_VIEW]);
});

test("a hit exactly at the range counts, and a ray that grazes a corner is stopped", () => {
  const at = lens.pixelAt(ROW, ROBOT, { ...SENSOR, range: 3 }, CONSTANTS, 0, 3);
  assert.deepEqual([at.kind, at.z], [OBJECT, 2.5]);
  const corner = lens.worldOf(["...", ".#.", "..."]);
  // From (0.5, 1.5) to (1.5, 0.5), through the wall's corner at (1, 1).
  const past = lens.pixelAt(corner, { x: 0.5, y: 1.5, theta: 0 }, { ...SENSOR, fov: 7 }, CONSTANTS, 0, 1);
  assert.equal(past.kind, OBJECT);
  close(past.z, Math.SQRT1_2, "z");
});

test("walls are covered by boxes, each pixel once", () => {
  const random = seeded(3);
  for (let world = 0; world < 50; world++) {
    const rows = Array.from({ length: 7 }, () => Array.from({ length: 9 }, () => (random() < 0.5 ? "#" : ".")).join(""));
    const { walls, boxes } = lens.worldOf(rows);
    const covered = new Uint8Array(63);
    for (const [x0, y0, x1, y1] of boxes) {
      for (let y = y0; y < y1; y++) for (let x = x0; x < x1; x++) covered[9 * y + x]++;
    }
    assert.deepEqual(covered, walls);
  }
});

// ---- Eq. 4.22 --------------------------------------------------------------------------

test("a reading of a cell is one of three cases, the third kept within 0.1 to 0.9", () => {
  const said = (...counts) => lens.saidOf(...counts, CONSTANTS);
  assert.deepEqual([said(16, 0).which, said(0, 16).which, said(8, 8).which], [0, 1, 2]);
  close(said(16, 0).logOdds, LN9);
  close(said(0, 1).logOdds, -LN9);
  assert.equal(said(8, 8).logOdds, 0);
  close(said(4, 2).logOdds, Math.log(2));
  assert.equal(said(63, 1).pFree, 0.9);
  assert.equal(said(0, 0).which, null);
  assert.deepEqual([said(9, 0), said(0, 9), said(5, 11), said(0, 0)].map(lens.labelOf), ["empty", "object", "q 0.31", ""]);
});

test("the odds of a cell are shown as they are, not rounded to a wrong sum", () => {
  assert.equal(lens.oddsWords(lens.saidOf(56, 8, CONSTANTS)), "ln(0.875 / 0.125) = +1.95");
  assert.equal(lens.oddsWords(lens.saidOf(9, 0, CONSTANTS)), "ln(0.90 / 0.10) = +2.20");
});

// ---- readings add up; the numbers of exercise 4 -----------------------------------------

const state = (rule, chips, prior = 0.18) => ({ rule, chips, prior });
const total = (...args) => lens.totalOf(state(...args), CONSTANTS);
const believed = (...args) => lens.pFreeOf(total(...args)).toFixed(4);

test("once and taking off give the numbers of the lesson", () => {
  const of = (rule) => [["e"], ["e", "e"], ["e", "o"], ["o", "o"]].map((chips) => believed(rule, chips));
  assert.deepEqual(of("prior_once"), ["0.6639", "0.9468", "0.1800", "0.0027"]);
  assert.deepEqual(of("subtract_prior"), ["0.9000", "0.9973", "0.8200", "0.0532"]);
});

test("a bar begins where the last one ended, and taking off makes two of each reading", () => {
  const chips = ["e", "o", "5.3"];
  const once = lens.ladderOf(state("prior_once", chips), CONSTANTS);
  assert.deepEqual(once.map(({ kind }) => kind), ["prior", "reading", "reading", "reading"]);
  const bars = lens.ladderOf(state("subtract_prior", chips), CONSTANTS);
  assert.deepEqual(bars.map(({ kind }) => kind), ["prior", "reading", "less", "reading", "less", "reading", "less"]);
  assert.deepEqual(bars.map(({ reading }) => reading), [0, 1, 1, 2, 2, 3, 3]);
  for (const ladder of [once, bars]) {
    ladder.slice(1).forEach(({ from }, i) => assert.equal(from, ladder[i].to));
  }
  const l0 = Math.log(0.18 / 0.82);
  close(bars.at(-1).to, Math.log(5 / 3) + (1 - 3) * l0, "S + (1 - k) l_0");
});

test("in another order the sum is the same, exactly", () => {
  const random = seeded(5);
  const kinds = ["e", "o", "5.3", "8.8", "1.15", "63.1"];
  for (let i = 0; i < 200; i++) {
    let chips = Array.from({ length: 8 }, () => kinds[Math.floor(6 * random())]);
    for (const rule of ["prior_once", "subtract_prior"]) {
      const expected = total(rule, chips, 0.37);
      for (let turn = 0; turn < 8; turn++) {
        chips = lens.turned(chips);
        assert.equal(total(rule, chips, 0.37), expected);
      }
    }
  }
});

test("162 of 244 cells that read empty are free, and counting is whole for every prior", () => {
  const { cells, free, wall, share } = lens.countedCells(0.18, { empty: 1, object: 0 }, CONSTANTS);
  assert.deepEqual([cells, free, wall, share.toFixed(3)], [1000, 162, 82, "0.664"]);
  for (let hundredths = 2; hundredths <= 98; hundredths++) {
    const prior = hundredths / 100;
    for (const outcome of [...lens.ONE_READING, ...lens.TWO_READINGS]) {
      const n = outcome.empty + outcome.object;
      const orders = outcome.empty * outcome.object ? 2 : 1;
      // In tenths the counts are integers: 10 p and 9 or 1 a reading.
      const tenths = (p, right, wrong) => orders * p * 9 ** right * 1 ** wrong * 10 * (n === 2 ? 100 : 1) / 10 ** n;
      const counted = lens.countedCells(prior, outcome, CONSTANTS);
      close(counted.free, tenths(hundredths, outcome.empty, outcome.object), "free");
      close(counted.wall, tenths(100 - hundredths, outcome.object, outcome.empty), "wall");
    }
  }
});

test("counting the drawing once gives what was counted, whatever the prior", () => {
  for (const prior of [0.02, 0.18, 0.5, 0.81, 0.98]) {
    for (const outcome of [...lens.ONE_READING, ...lens.TWO_READINGS]) {
      const { share } = lens.countedCells(prior, outcome, CONSTANTS);
      close(lens.ruleSays(prior, outcome, "prior_once", CONSTANTS), share, outcome.name);
    }
  }
});

test("taking the drawing off says 0.9 after one empty reading, whatever the drawing was", () => {
  for (const prior of [0.02, 0.18, 0.5, 0.81, 0.98]) {
    close(lens.ruleSays(prior, { empty: 1, object: 0 }, "subtract_prior", CONSTANTS), 0.9);
  }
});

test("on the line a step of p is short in the middle and long at the ends", () => {
  const steps = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8].map((p) => lens.logit(p + 0.1) - lens.logit(p));
  const lengths = steps.map((step) => step.toFixed(3));
  assert.deepEqual(lengths, ["0.811", "0.539", "0.442", "0.405", "0.405", "0.442", "0.539", "0.811"]);
});

test("the line reaches as far as its bars", () => {
  assert.equal(lens.reachOf([{ to: -3.9 }]), 4);
  assert.equal(lens.reachOf([{ to: 1 }, { to: -8.1 }]), 12);
});

// ---- the document and the robot ---------------------------------------------------------

const TEXTS = {
  rev: 3,
  pose: "8.5_10.5_270",
  size: "8",
  cell: "1_5",
  range: "20",
  fov: "360",
  behind: "unseen",
  clear: "0",
  prior: "0.42",
  rule: "subtract_prior",
  chips: "e_8.8_o",
};

test("texts come back as they were read", () => {
  assert.deepEqual(lens.textsOf(lens.stateOf(TEXTS)), TEXTS);
  assert.deepEqual(lens.stateOf({ ...TEXTS, chips: "" }).chips, []);
});

test("the selected place stays selected when the cells change size", () => {
  const there = { ...lens.resized({ size: 4, row: 2, col: 9 }, 2) };
  assert.deepEqual(there, { size: 2, row: 5, col: 19 });
  assert.deepEqual(lens.resized(there, 4), { size: 4, row: 2, col: 9 });
});

test("the robot slides along a wall, stands on half pixels and stays in the world", () => {
  const world = lens.worldOf(["....", "..#.", "...."]);
  const from = { x: 1.5, y: 1.5 };
  assert.deepEqual(lens.freePlace(world, from, 1.3, 0.6), { x: 1.5, y: 0.5 });
  assert.deepEqual(lens.freePlace(world, from, 2.5, 1.5), { x: 1.5, y: 1.5 });
  assert.deepEqual(lens.freePlace(world, { x: 1.5, y: 0.5 }, 2.5, 1.2), { x: 2.5, y: 0.5 });
  assert.deepEqual(lens.freePlace(world, from, -9, 9), { x: 0.5, y: 2.5 });
});

test("an arrow lifts the robot over a wall, but not out of the world", () => {
  const world = lens.worldOf(["..##.", "....#"]);
  assert.deepEqual(lens.stepped(world, { x: 1.5, y: 0.5 }, 1, 0), { x: 4.5, y: 0.5 });
  assert.deepEqual(lens.stepped(world, { x: 3.5, y: 1.5 }, 1, 0), { x: 3.5, y: 1.5 });
  assert.deepEqual(lens.stepped(world, { x: 0.5, y: 1.5 }, 0, 4), { x: 0.5, y: 1.5 });
});

test("headings stay within a turn", () => {
  assert.deepEqual([-15, 360, 359.7, 725].map(lens.wrapped), [345, 0, 0, 5]);
});
