// How readings add up from a prior, and the same by counting cells: numbers only.

// What a chip adds: e and o are a cell read as entirely empty and as entirely object,
// "8.8" one with so many pixels of each.
function chipSaid(chip, constants) {
  if (chip === "e") return saidOf(1, 0, constants);
  if (chip === "o") return saidOf(0, 1, constants);
  return saidOf(...chip.split(".").map(Number), constants);
}

// The bars from 0 to the map's log-odds. If the prior is taken off at every reading,
// each reading is two bars.
function ladderOf({ prior, rule, chips }, constants) {
  const l0 = logit(prior);
  const bars = [{ kind: "prior", from: 0, to: l0, reading: 0 }];
  const add = (kind, amount, reading) => {
    const from = bars.at(-1).to;
    bars.push({ kind, from, to: from + amount, reading });
  };
  chips.forEach((chip, i) => {
    add("reading", chipSaid(chip, constants).logOdds, i + 1);
    if (rule === "subtract_prior") add("less", -l0, i + 1);
  });
  return bars;
}

const totalOf = (state, constants) => ladderOf(state, constants).at(-1).to;

// Counts cells that the drawing treats alike, of which the share `prior` is free, after
// so many readings empty and object. The sensor is right with pFreeMax. The number of
// cells makes every count whole: 1000 for one reading, 100 times as many for two.
function countedCells(prior, { empty, object }, { pFreeMax }) {
  const n = empty + object;
  const cells = 1000 * 100 ** Math.max(0, n - 1);
  const orders = n === 2 && empty === 1 ? 2 : 1;
  const share = (right, wrong) => orders * pFreeMax ** right * (1 - pFreeMax) ** wrong;
  const free = Math.round(cells * prior * share(empty, object));
  const wall = Math.round(cells * (1 - prior) * share(object, empty));
  return { cells, free, wall, share: free / (free + wall) };
}

// What a rule says after such readings.
function ruleSays(prior, { empty, object }, rule, constants) {
  const chips = [...Array(empty).fill("e"), ...Array(object).fill("o")];
  return pFreeOf(totalOf({ prior, rule, chips }, constants));
}

// Another order of the readings: each moves on by one, the last comes first.
const turned = (chips) => [...chips.slice(-1), ...chips.slice(0, -1)];
