// Scores after 0, 1, ..., S readings, in one pass over the entries: numbers only.
//
// Two regions are scored apart: cells looked at (k >= 1) and cells not looked at.

// Bits by which the truth surprises a cell's probability: -log2 p(truth).
function surprise(isWall, logOdds) {
  const x = isWall ? logOdds : -logOdds;
  return (Math.max(x, 0) + Math.log1p(Math.exp(-Math.abs(x)))) / Math.LN2;
}

const newTally = () => ({ counts: [0, 0, 0, 0], bits: 0 });

// Counts a cell in (sign 1) or out (sign -1).
function tallyCell(tally, column, c, logOdds, sign) {
  tally.counts[outcomeAt(column, c, logOdds)] += sign;
  tally.bits += sign * surprise(column.log.truth[c], logOdds);
}

function newCurve(n) {
  const counts = Array.from({ length: 4 }, () => new Uint32Array(n));
  return { counts, bits: new Float64Array(n) };
}

function storeAt(curve, s, { counts, bits }) {
  for (let i = 0; i < 4; i++) curve.counts[i][s] = counts[i];
  curve.bits[s] = bits;
}

// The four counts and the bits of each region, and the number of cells looked at.
function scoreCurves(column) {
  const { nReadings, nCells } = column.log;
  const n = nReadings + 1;
  const curves = { looked: newCurve(n), unseen: newCurve(n), explored: new Uint32Array(n) };
  const looked = newTally();
  const unseen = newTally();
  for (let c = 0; c < nCells; c++) tallyCell(unseen, column, c, priorOf(column, c), 1);
  for (let s = 0; s < n; s++) {
    storeAt(curves.looked, s, looked);
    storeAt(curves.unseen, s, unseen);
    const firstSeen = s < nReadings ? scoreReading(column, s, looked, unseen) : 0;
    if (s < nReadings) curves.explored[s + 1] = curves.explored[s] + firstSeen;
  }
  return curves;
}

// Moves each cell that a reading updated from its old tally to its new one; returns how
// many cells it saw for the first time.
function scoreReading(column, s, looked, unseen) {
  const { indptr, cell, before, rank, logOdds } = column.log;
  let firstSeen = 0;
  for (let e = indptr[s]; e < indptr[s + 1]; e++) {
    const c = cell[e];
    const k = rank[e];
    tallyCell(k > 0 ? looked : unseen, column, c, fused(column, c, before[e], k), -1);
    tallyCell(looked, column, c, fused(column, c, before[e] + logOdds[e], k + 1), 1);
    if (k === 0) firstSeen++;
  }
  return firstSeen;
}

// Scores from the counts, as in occsim.metrics; 0 / 0 is NaN: undefined.
const FORMULAS = {
  precision: ([tp, fp]) => tp / (tp + fp),
  recall: ([tp, , fn]) => tp / (tp + fn),
  f2: ([tp, fp, fn]) => (5 * tp) / (5 * tp + 4 * fn + fp),
};

const cellsIn = ({ counts }, s) => counts[0][s] + counts[1][s] + counts[2][s] + counts[3][s];

function regionSeries(curve) {
  const { counts, bits } = curve;
  const series = { found: counts[0], falseWalls: counts[1] };
  for (const [name, formula] of Object.entries(FORMULAS)) {
    series[name] = Float64Array.from(bits, (_, s) => formula(counts.map((count) => count[s])));
  }
  // A region without cells has no mean; what is left of a sum is rounding.
  series.bits = Float64Array.from(bits, (sum, s) => {
    const n = cellsIn(curve, s);
    return n ? sum / n : NaN;
  });
  return series;
}

function scoreSeries({ looked, unseen, explored }, nCells) {
  const bits = Float64Array.from(looked.bits, (sum, s) => (sum + unseen.bits[s]) / nCells);
  return {
    looked: regionSeries(looked),
    unseen: regionSeries(unseen),
    all: { bits },
    coverage: Float64Array.from(explored, (n) => n / nCells),
  };
}

// The scores of the map without a drawing: a prior of one half, under either rule.
function blankSeries(log, constants) {
  if (!log.blank) {
    const column = newColumn(log, new Uint8Array(log.nCells), constants);
    log.blank = scoreSeries(scoreCurves(column), log.nCells);
  }
  return log.blank;
}

const SAME_SCORE = 1e-12; // scores this near are equal, as in occsim.metrics

// The smallest number of readings after which the blank map is at least as good as a map
// is after `step`; null where it never is. `sign` is 1 where more is better, else -1.
function worthInReadings(blank, values, step, sign) {
  const aim = sign * values[step] - SAME_SCORE;
  for (let s = 0; s < blank.length; s++) if (sign * blank[s] >= aim) return s;
  return null;
}
