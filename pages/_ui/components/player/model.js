// Fusion: numbers only, independent of the page.
//
// The readings' log-odds do not depend on the prior, so a map at any step follows from
// the prior's log-odds l_0 and, per cell, the number k and the sum S of its readings:
// l = S + l_0 (prior once) or l = S + (1 - k) l_0 (subtract prior). After n laps of the tour
// each reading came n times: n S and n k stand for S and k.
//
// A *log* holds the readings and their sums at a step; columns share it. A *column* is
// one map: a log, what its drawing says of each cell (SPACE, WALL or UNKNOWN), the prior
// and the update rule.

const [SPACE, WALL, UNKNOWN] = [0, 1, 2];

function newLog(evidence) {
  const sums = new Float64Array(evidence.nCells);
  const counts = new Int32Array(evidence.nCells);
  return { ...evidence, ...linkEntries(evidence), sums, counts, step: 0 };
}

function newColumn(log, drawn, { decisionEps, priorScale, declared }) {
  const prior = { pFreePrior: [0.5, 0.5], logOddsPrior: [0, 0, 0], once: true };
  return { log, drawn, laps: 1, ...prior, decisionEps, priorScale, declared };
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

// gmapping's cell model: an entry holds visits and hits of a scan. Their difference, visits
// weighted, adds up like log-odds, and a wall is declared where it falls below 0.
function countsOfBeams(evidence, { hit, occupiedAbove }) {
  const coded = evidence.logOdds;
  const logOdds = coded.map((value) => occupiedAbove * Math.floor(value) - (value % 1) / hit);
  return { ...evidence, coded, hit, logOdds };
}

// Hits and visits of a cell up to a step.
function beamsOf(log, c) {
  let [hits, visits] = [0, 0];
  for (let e = log.last[c]; e >= 0; e = log.previous[e]) {
    if (e >= log.indptr[log.step]) continue;
    hits += (log.coded[e] % 1) / log.hit;
    visits += Math.floor(log.coded[e]);
  }
  return { hits, visits };
}

// By class: the value of space cells, then that of wall cells. Cells of which the drawing
// says nothing start from one half, log-odds 0.
function setPrior(column, setting) {
  column.pFreePrior = pairOf(column, setting);
  column.logOddsPrior = [...column.pFreePrior.map(logit), 0];
  column.once = setting.rule === "prior_once";
  column.laps = Number(setting.laps ?? 1);
}

function pairOf(column, { p_wall, p_space, uninformative, calibrated }) {
  if (uninformative || column.log.coded) return [0.5, 0.5];
  if (calibrated) return calibratedPair(column);
  return [column.priorScale * p_space, column.priorScale * p_wall];
}

// As occsim.calibrated_prior: the share of each class that is free in truth, smoothed by
// Laplace's rule so that neither 0 nor 1 occurs.
function calibratedPair({ drawn, log: { truth, nCells } }) {
  const [free, all] = [
    [1, 1],
    [2, 2],
  ];
  for (let c = 0; c < nCells; c++) {
    if (drawn[c] === UNKNOWN) continue;
    all[drawn[c]]++;
    if (!truth[c]) free[drawn[c]]++;
  }
  return free.map((n, i) => n / all[i]);
}

// Moves to the map after so many readings; returns the entries that changed.
function seek(log, step) {
  const { indptr, cell, before, logOdds, sums, counts } = log;
  const from = indptr[log.step];
  const to = indptr[step];
  for (let e = from; e < to; e++) {
    sums[cell[e]] = before[e] + logOdds[e];
    counts[cell[e]]++;
  }
  for (let e = from - 1; e >= to; e--) {
    sums[cell[e]] = before[e];
    counts[cell[e]]--;
  }
  log.step = step;
  return [Math.min(from, to), Math.max(from, to)];
}

const priorOf = (column, c) => column.logOddsPrior[column.drawn[c]];

// A cell's log-odds from the sum and the number of its readings in one lap.
function fused(column, c, sum, k) {
  // Counts are published as three classes: free, occupied, unknown.
  if (column.log.coded) return k === 0 ? 0 : sum < -column.decisionEps ? -column.declared : column.declared;
  const { laps } = column;
  return laps * sum + (column.once ? 1 : 1 - laps * k) * priorOf(column, c);
}

const logOddsAt = (column, c) => fused(column, c, column.log.sums[c], column.log.counts[c]);

const declaresWall = (column, logOdds) => logOdds < -column.decisionEps;

// Which of the four counts a cell falls in: 0 TP, 1 FP, 2 FN, 3 TN.
function outcomeAt(column, c, logOdds) {
  const isTrue = column.log.truth[c];
  if (declaresWall(column, logOdds)) return isTrue ? 0 : 1;
  return isTrue ? 2 : 3;
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

// Every reading of one cell, in order: its value, the prior subtracted with it, the term
// that both add, and the total; each once for every lap.
function historyOf(column, c) {
  const { log } = column;
  const prior = priorOf(column, c);
  const laps = log.coded ? 1 : column.laps;
  const off = column.once ? 0 : -laps * prior;
  const terms = [];
  for (let e = log.last[c]; e >= 0; e = log.previous[e]) {
    const said = laps * log.logOdds[e];
    const sum = log.before[e] + log.logOdds[e];
    const total = log.coded ? sum : fused(column, c, sum, log.rank[e] + 1);
    terms.push({ reading: readingOf(log, e), said, off, added: said + off, total, laps });
  }
  return { prior, terms: terms.reverse() };
}
