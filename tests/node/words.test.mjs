import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";

const player = load("player");

test("numbers have a true minus, and no minus where they round to zero", () => {
  assert.equal(player.fixed(-1.2345, 2), "\u22121.23");
  assert.equal(player.fixed(-0.0001, 3), "0.000");
  assert.equal(player.signed(1.5, 3), "+1.500");
  assert.equal(player.signed(-1.5, 1), "\u22121.5");
});

test("thousands of a count are apart", () => {
  assert.deepEqual([0, 999, 1103, 1234567].map(player.grouped), ["0", "999", "1,103", "1,234,567"]);
});

test("a probability near 0 or 1 is not shown as certain", () => {
  assert.equal(player.probability(0.18), "0.180");
  assert.equal(player.probability(0.00012), "0.00012");
  assert.equal(player.probability(1 - 0.00012), "0.99988");
  assert.equal(player.probability(0), "0.000");
});

test("charts of maps with other readings or cells say so", () => {
  const [three, one] = [{ cellPx: 3 }, { cellPx: 1 }];
  const columns = (...logs) => logs.map((log) => ({ log }));
  const tile = { about: "cells not looked at", unit: player.UNITS.cells };
  assert.equal(player.aboutWords(tile, columns(three, three)), "cells not looked at");
  const other = "cells not looked at, each of its map's size";
  assert.equal(player.aboutWords(tile, columns(three, one)), other);
  const shares = { about: "cells looked at", unit: player.UNITS.share };
  assert.equal(player.aboutWords(shares, columns(three, one)), "cells looked at");
  assert.equal(player.blankLabel(columns(three, three)), "blank");
  assert.equal(player.blankLabel(columns(three, { cellPx: 3 })), "blank as A");
});

test("an undefined score is a dash", () => {
  assert.equal(player.percent(NaN), "\u2013");
  assert.equal(player.percent(0.8512), "85.1 %");
});

// Prior -1, then a reading to 0.5 and one to -0.25.
test("a ladder goes from one total to the next and knows what is still to come", () => {
  const terms = [
    { reading: 2, total: 0.5 },
    { reading: 9, total: -0.25 },
  ];
  const bars = player.ladderOf({ prior: -1, terms }, 9);
  assert.deepEqual(
    bars.map(({ from, to }) => [from, to]),
    [
      [0, -1],
      [-1, 0.5],
      [0.5, -0.25],
    ],
  );
  assert.deepEqual(
    bars.map(({ label }) => label),
    ["prior", "3", "10"],
  );
  assert.deepEqual(
    bars.map(({ isDone }) => isDone),
    [true, true, false],
  );
});

// By hand: two readings of one cell, +1 and -0.5, in each of three laps; l_0 is 0.25.
test("over several laps a reading is one bar, and its card says what one lap adds", () => {
  const log = { last: [1], previous: [-1, 0], logOdds: [1, -0.5], before: [0, 1], rank: [0, 1] };
  Object.assign(log, { indptr: [0, 1, 2], nReadings: 2 });
  const column = { log, drawn: [0], logOddsPrior: [0.25, 0], laps: 3, once: false };
  const { prior, terms } = player.historyOf(column, 0);
  const bars = player.ladderOf({ prior, terms }, 2);
  assert.deepEqual(
    bars.map(({ label }) => label),
    ["prior", "1 \u00d73", "", "2 \u00d73", ""],
  );
  // 0.25 + 3 (1 - 0.25), then + 3 (-0.5 - 0.25).
  assert.deepEqual(terms.map(({ total }) => total), [2.5, 0.25]);
  const [title, facts] = player.termCard(column, bars[1]);
  assert.equal(title, "Reading 1");
  assert.deepEqual(Object.fromEntries(facts), {
    "p_free(reading)": "0.731",
    "its log-odds": "+1.000",
    "less l_0": "\u22120.250",
    "3 laps add": "+2.250",
    "then l": "+2.500",
  });
});

test("ticks are round and few", () => {
  assert.deepEqual(
    [2, 3, 9, 45, 130].map((span) => player.tickStep(span, 4)),
    [0.5, 1, 5, 20, 50],
  );
});

test("two pictures stand where they are largest", () => {
  const wide = { widthPx: 400, heightPx: 100 };
  const tall = { widthPx: 100, heightPx: 400 };
  const box = { width: 816, height: 400 };
  assert.deepEqual(player.arrange(box, wide, "wide"), {
    scale: (400 - 16 - 22) / 2 / 100,
    stacked: true,
  });
  assert.deepEqual(player.arrange(box, tall, "wide"), { scale: 1, stacked: false });
  assert.deepEqual(player.arrange(box, tall, "narrow"), { scale: 1, stacked: true });
});
