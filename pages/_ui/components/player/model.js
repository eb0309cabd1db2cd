// Fusion and scores: numbers only, independent of the page.
//
// The readings' log-odds do not depend on the prior, so a map at any step follows from
// the prior's log-odds l_0 and, per cell, the number k and the sum S of its readings:
// l = S + l_0 (prior once) or l = S + (1 - k) l_0 (subtract prior).

function newModel(replay, { decisionEps, priorScale }) {
  const sums = new Float64Array(replay.nCells);
  const counts = new Int32Array(replay.nCells);
  const prior = { pFreePrior: [0.5, 0.5], logOddsPrior: [0, 0], once: true };
  const links = linkEntries(replay);
  return { ...replay, ...links, ...prior, sums, counts, step: 0, decisionEps, priorScale };
}

// Per entry, the state of its cell before it: the sum, the number and the last entry.
// With them a step back is exact, and a cell's history is a walk from its last entry.
function linkEntries({ cell, logOdds, nCells }) {
  const before = new Float64Array(cell.length);
  const rank = new Uint32Array(cell.length);
  const previous = new Int32Array(cell.length);
  const last = new Int32Array(nCells).fill(-1);
  for (let e = 0; e < cell.length; e++) {
    const p = last[cell[e]];
    previous[e] = p;
    if (p >= 0) {
      before[e] = before[p] + logOdds[p];
      rank[e] = rank[p] + 1;
    }
    last[cell[e]] = e;
  }
  return { before, rank, previous, last };
}

// By class: the value of space cells, then that of wall cells.
function setPrior(model, { p_wall, p_space, uninformative, rule }) {
  const scaled = [model.priorScale * p_space, model.priorScale * p_wall];
  model.pFreePrior = uninformative ? [0.5, 0.5] : scaled;
  model.logOddsPrior = model.pFreePrior.map(logit);
  model.once = rule === "prior_once";
}

// Moves to the map after so many readings; returns the entries that changed.
function seek(model, step) {
  const { indptr, cell, before, logOdds, sums, counts } = model;
  const from = indptr[model.step];
  const to = indptr[step];
  for (let e = from; e < to; e++) {
    sums[cell[e]] = before[e] + logOdds[e];
    counts[cell[e]]++;
  }
  for (let e = from - 1; e >= to; e--) {
    sums[cell[e]] = before[e];
    counts[cell[e]]--;
  }
  model.step = step;
  return [Math.min(from, to), Math.max(from, to)];
}

const priorOf = (model, c) => model.logOddsPrior[model.isWall[c]];

// A cell's log-odds from the sum and the number of its readings.
function fused(model, c, sum, k) {
  return sum + (model.once ? 1 : 1 - k) * priorOf(model, c);
}

const logOddsAt = (model, c) => fused(model, c, model.sums[c], model.counts[c]);

const declaresWall = (model, logOdds) => logOdds < -model.decisionEps;

// Which of the four counts a cell falls in: 0 TP, 1 FP, 2 FN, 3 TN.
function outcomeAt(model, c, logOdds) {
  const isTrue = model.truth[c];
  if (declaresWall(model, logOdds)) return isTrue ? 0 : 1;
  return isTrue ? 2 : 3;
}

// The four counts and the number of explored cells after 0, 1, ..., S readings, in one
// pass over the entries.
function scoreCurves(model, region) {
  const curve = () => new Uint32Array(model.nReadings + 1);
  const curves = { counts: [curve(), curve(), curve(), curve()], explored: curve() };
  const now = region === "explored" ? [0, 0, 0, 0] : priorCounts(model);
  let explored = 0;
  for (let s = 0; s <= model.nReadings; s++) {
    for (let i = 0; i < 4; i++) curves.counts[i][s] = now[i];
    curves.explored[s] = explored;
    if (s < model.nReadings) explored += scoreReading(model, s, region, now);
  }
  return curves;
}

function priorCounts(model) {
  const counts = [0, 0, 0, 0];
  for (let c = 0; c < model.nCells; c++) counts[outcomeAt(model, c, priorOf(model, c))]++;
  return counts;
}

// Moves each cell that a reading updated from its old count to its new one; returns how
// many cells it saw for the first time.
function scoreReading(model, s, region, counts) {
  const { indptr, cell, before, rank, logOdds } = model;
  let firstSeen = 0;
  for (let e = indptr[s]; e < indptr[s + 1]; e++) {
    const c = cell[e];
    const k = rank[e];
    const was = outcomeAt(model, c, fused(model, c, before[e], k));
    const is = outcomeAt(model, c, fused(model, c, before[e] + logOdds[e], k + 1));
    if (region !== (k > 0 ? "unexplored" : "explored")) counts[was]--;
    if (region !== "unexplored") counts[is]++;
    if (k === 0) firstSeen++;
  }
  return firstSeen;
}

function readingOf({ indptr, nReadings }, entry) {
  let low = 0;
  let high = nReadings;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (indptr[middle] <= entry) low = middle;
    else high = middle;
  }
  return low;
}

// Every reading of one cell, in order: its value, the term added, and the total.
function historyOf(model, c) {
  const prior = priorOf(model, c);
  const terms = [];
  for (let e = model.last[c]; e >= 0; e = model.previous[e]) {
    const said = model.logOdds[e];
    const total = fused(model, c, model.before[e] + said, model.rank[e] + 1);
    const added = model.once ? said : said - prior;
    terms.push({ reading: readingOf(model, e), said, added, total });
  }
  return { prior, terms: terms.reverse() };
}

// Scores from the counts, as in occsim.metrics; 0 / 0 is NaN: undefined.
const SCORES = {
  precision: ([tp, fp]) => tp / (tp + fp),
  recall: ([tp, , fn]) => tp / (tp + fn),
  f2: ([tp, fp, fn]) => (5 * tp) / (5 * tp + 4 * fn + fp),
};

function scoreSeries(curves, nCells) {
  const series = { coverage: Float64Array.from(curves.explored, (n) => n / nCells) };
  for (const [name, formula] of Object.entries(SCORES)) {
    const at = (_, s) => formula(curves.counts.map((curve) => curve[s]));
    series[name] = Float64Array.from(curves.explored, at);
  }
  return series;
}
