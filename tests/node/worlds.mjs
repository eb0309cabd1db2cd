// Small replays for the tests, and how a naive player would fuse them.

import { seeded } from "./scripts.mjs";

// Log-odds of a probability, on the lattice of occsim.logodds.
export const logit = (p) => Math.round(Math.log(p / (1 - p)) * 2 ** 36) / 2 ** 36;

// A map of a replay under a setting, as the player makes it.
export function columnOf(player, replay, setting) {
  const column = player.newColumn(player.newLog(replay), replay.drawn, CONSTANTS);
  player.setPrior(column, setting);
  return column;
}

export const CONSTANTS = { decisionEps: 1e-9, priorScale: 0.9 };

// A replay from readings, each a list of [cell, log-odds].
export function replayOf(nRows, nCols, cellPx, readings, { drawn, truth }) {
  const indptr = [0];
  for (const reading of readings) indptr.push(indptr.at(-1) + reading.length);
  const poses = readings.flatMap((_, i) => [i, i, 0]);
  const size = { widthPx: nCols * cellPx, heightPx: nRows * cellPx };
  return {
    nRows,
    nCols,
    nCells: nRows * nCols,
    cellPx,
    ...size,
    nReadings: readings.length,
    indptr: Uint32Array.from(indptr),
    cell: Uint32Array.from(readings.flat().map(([cell]) => cell)),
    logOdds: Float64Array.from(readings.flat().map(([, logOdds]) => logOdds)),
    drawn: Uint8Array.from(drawn),
    truth: Uint8Array.from(truth),
    poses: Float32Array.from(poses),
    rangePx: 10,
    fovRad: 1,
  };
}

// Readings of about a third of 30 cells each; values repeat, as real ones do.
export function randomReadings(seed, nReadings = 40, nCells = 30) {
  const random = seeded(seed);
  const values = [0.1, 0.25, 0.5, 0.75, 0.9].map(logit);
  const pick = () => values[Math.floor(random() * values.length)];
  const cells = () => [...Array(nCells).keys()].filter(() => random() < 0.35);
  return Array.from({ length: nReadings }, () => cells().map((cell) => [cell, pick()]));
}

export function randomReplay(seed) {
  const random = seeded(seed + 1000);
  const flags = () => Array.from({ length: 30 }, () => (random() < 0.4 ? 1 : 0));
  // What the drawing says: 0 space, 1 wall, 2 nothing.
  const drawn = flags().map((wall) => wall || (random() < 0.3 ? 2 : 0));
  const classes = { drawn, truth: flags() };
  return {
    readings: randomReadings(seed),
    ...classes,
    replay: replayOf(5, 6, 3, randomReadings(seed), classes),
  };
}

// One cell at a time, one reading after the other, as Table 9.1 of Probabilistic
// Robotics is written: l_k = l_(k-1) + reading [- l_0].
export function naiveLogOdds({ readings, drawn }, step, { p_wall, p_space, rule }) {
  return drawn.map((said, cell) => {
    const l0 = [logit(0.9 * p_space), logit(0.9 * p_wall), 0][said];
    let l = l0;
    for (const reading of readings.slice(0, step)) {
      for (const [c, value] of reading) {
        if (c === cell) l += rule === "subtract_prior" ? value - l0 : value;
      }
    }
    return l;
  });
}

// The counts and the bits of the cells of a region, "looked" or "unseen".
export function naiveCounts(world, step, state, region) {
  const counts = [0, 0, 0, 0];
  let bits = 0;
  const seen = new Set(
    world.readings
      .slice(0, step)
      .flat()
      .map(([cell]) => cell),
  );
  naiveLogOdds(world, step, state).forEach((l, cell) => {
    if (region === (seen.has(cell) ? "unseen" : "looked")) return;
    const isDeclared = l < -1e-9;
    bits += Math.log2(1 + Math.exp(world.truth[cell] ? l : -l)); // -log2 p(truth)
    counts[isDeclared ? (world.truth[cell] ? 0 : 1) : world.truth[cell] ? 2 : 3]++;
  });
  return { counts, bits, explored: seen.size };
}

export const STATES = ["prior_once", "subtract_prior"].flatMap((rule) =>
  [
    [0.2, 0.9],
    [1, 1],
    [0.05, 0.31],
  ].map(([p_wall, p_space]) => ({ rule, p_wall, p_space, uninformative: false })),
);
