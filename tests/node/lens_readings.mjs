// Readings and sums of the lens for tests/test_lens.py: JSON in, JSON out.

import { readFileSync } from "node:fs";
import { load } from "./scripts.mjs";

const lens = load("lens");
const { header, readings, ladders } = JSON.parse(readFileSync(0, "utf8"));
const { constants } = header;
const world = lens.worldOf(header.world);

function reading(texts) {
  const state = lens.stateOf({ ...header.document, ...texts });
  const kinds = lens.readPixels(world, lens.poseOf(state), lens.sensorOf(state), constants);
  const { inView, empty, object } = lens.countCells(world, kinds, state.size);
  const logOdds = Array.from(empty, (n, c) => lens.saidOf(n, object[c], constants).logOdds);
  const lists = [kinds, inView, empty, object].map((values) => Array.from(values));
  return [...lists, logOdds, lens.countHidden(world, kinds)];
}

const total = (texts) => lens.totalOf(lens.stateOf({ ...header.document, ...texts }), constants);

console.log(JSON.stringify({ readings: readings.map(reading), ladders: ladders.map(total) }));
