// Decoding, fusion and scores: numbers only, nothing of the page.
//
// The readings' log-odds do not depend on the prior, so a map at any step follows from
// the prior's log-odds l_0 and, per cell, the number k and the sum S of its readings:
// l = S + (1 - k) l_0 (subtract prior) or l = S + l_0 (prior once).

// The layout is described in occsim/formats/replay.py.
function decodeReplay(buffer) {
  const word = new Uint32Array(buffer, 0, 12);
  const [, heightPx, widthPx, cellPx, nReadings, nEntries, nRuns, nValues] = word;
  const [rangePx, fovRad] = new Float64Array(buffer, 48, 2);
  const nRows = Math.ceil(heightPx / cellPx);
  const nCols = Math.ceil(widthPx / cellPx);
  const nCells = nRows * nCols;
  const IndexArray = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[word[8]];
  let at = 64;
  const take = (Type, count) => {
    const part = new Type(buffer, at, count);
    at += part.byteLength;
    return part;
  };
  const values = take(Float64Array, nValues);
  const poses = take(Float32Array, 3 * nReadings);
  const runs = take(Uint32Array, nReadings);
  const gap = take(Uint32Array, nRuns);
  const length = take(Uint32Array, nRuns);
  const index = take(IndexArray, nEntries);
  const bits = Math.ceil(nCells / 8);
  const isWall = unpackBits(take(Uint8Array, bits), nCells);
  const truth = unpackBits(take(Uint8Array, bits), nCells);
  const preview = take(Uint8Array, word[9]);
  const { indptr, cell } = expandRuns(runs, gap, length, nEntries);
  const logOdds = Float64Array.from(index, (i) => values[i]);
  return {
    heightPx,
    widthPx,
    cellPx,
    nRows,
    nCols,
    nCells,
    nReadings,
    rangePx,
    fovRad,
    indptr,
    cell,
    logOdds,
    isWall,
    truth,
    poses,
    preview,
  };
}

function expandRuns(runs, gap, length, nEntries) {
  const indptr = new Uint32Array(runs.length + 1);
  const cell = new Uint32Array(nEntries);
  let run = 0;
  let entry = 0;
  for (let s = 0; s < runs.length; s++) {
    let next = 0;
    for (const last = run + runs[s]; run < last; run++) {
      next += gap[run];
      for (const end = next + length[run]; next < end; next++) cell[entry++] = next;
    }
    indptr[s + 1] = entry;
  }
  return { indptr, cell };
}

// On the lattice of occsim.logodds: sums and ties are exact.
const logit = (p) => Math.round((Math.log(p) - Math.log1p(-p)) * 2 ** 36) / 2 ** 36;

function pFreeOf(logOdds) {
  const small = Math.exp(-Math.abs(logOdds));
  return (logOdds >= 0 ? 1 : small) / (1 + small);
}

// The four counts, in the order in which the curves store them.
const TP = 0,
  FP = 1,
  FN = 2,
  TN = 3;
const countIndex = (declared, wall) => (declared ? (wall ? TP : FP) : wall ? FN : TN);

class MapModel {
  constructor(replay, constants) {
    Object.assign(this, replay);
    this.eps = constants.decisionEps;
    this.scale = constants.priorScale;
    this.step = 0;
    this.sums = new Float64Array(this.nCells);
    this.counts = new Int32Array(this.nCells);
    this.logOddsPrior = [0, 0];
    this.once = false;
    this.linkEntries();
  }

  // Per entry, what its cell had before: the sum, the number and the entry. With them
  // a step back is exact, and a cell's history is a walk from its last entry.
  linkEntries() {
    const n = this.cell.length;
    this.before = new Float64Array(n);
    this.rank = new Uint32Array(n);
    this.previous = new Int32Array(n);
    this.last = new Int32Array(this.nCells).fill(-1);
    for (let e = 0; e < n; e++) {
      const c = this.cell[e];
      const p = this.last[c];
      this.previous[e] = p;
      if (p >= 0) {
        this.before[e] = this.before[p] + this.logOdds[p];
        this.rank[e] = this.rank[p] + 1;
      }
      this.last[c] = e;
    }
  }

  setPrior({ pWall, pSpace, uninformative, once }) {
    this.pFreePrior = uninformative
      ? [0.5, 0.5]
      : [this.scale * pSpace, this.scale * pWall];
    this.logOddsPrior = this.pFreePrior.map(logit);
    this.once = once;
  }

  // Moves to the map after so many readings; returns the entries that changed.
  seek(step) {
    const from = this.indptr[this.step];
    const to = this.indptr[step];
    for (let e = from; e < to; e++) {
      const c = this.cell[e];
      this.sums[c] = this.before[e] + this.logOdds[e];
      this.counts[c]++;
    }
    for (let e = from - 1; e >= to; e--) {
      const c = this.cell[e];
      this.sums[c] = this.before[e];
      this.counts[c]--;
    }
    this.step = step;
    return [Math.min(from, to), Math.max(from, to)];
  }

  priorWeight(k) {
    return this.once ? 1 : 1 - k;
  }

  mapLogOdds(c) {
    const weight = this.priorWeight(this.counts[c]);
    return this.sums[c] + weight * this.logOddsPrior[this.isWall[c]];
  }

  isOccupied(c) {
    return this.mapLogOdds(c) < -this.eps;
  }

  // The four counts and the number of explored cells after 0, 1, ..., S readings, in
  // one pass over the entries.
  scoreCurves(allCells) {
    const curves = { counts: [], explored: new Uint32Array(this.nReadings + 1) };
    for (let i = 0; i < 4; i++) curves.counts.push(new Uint32Array(this.nReadings + 1));
    const now = allCells ? this.priorCounts() : [0, 0, 0, 0];
    let explored = 0;
    for (let s = 0; s <= this.nReadings; s++) {
      for (let i = 0; i < 4; i++) curves.counts[i][s] = now[i];
      curves.explored[s] = explored;
      if (s < this.nReadings) explored += this.scoreReading(s, allCells, now);
    }
    return curves;
  }

  priorCounts() {
    const counts = [0, 0, 0, 0];
    for (let c = 0; c < this.nCells; c++) {
      const declared = this.logOddsPrior[this.isWall[c]] < -this.eps;
      counts[countIndex(declared, this.truth[c])]++;
    }
    return counts;
  }

  // Moves each cell that a reading updated from its old count to its new one; returns
  // how many cells it saw for the first time.
  scoreReading(s, allCells, counts) {
    const { cell, before, rank, logOdds, isWall, truth, logOddsPrior, eps } = this;
    let firstSeen = 0;
    for (let e = this.indptr[s]; e < this.indptr[s + 1]; e++) {
      const c = cell[e];
      const k = rank[e];
      const l0 = logOddsPrior[isWall[c]];
      if (k > 0 || allCells) {
        const l = before[e] + this.priorWeight(k) * l0;
        counts[countIndex(l < -eps, truth[c])]--;
      }
      const l = before[e] + logOdds[e] + this.priorWeight(k + 1) * l0;
      counts[countIndex(l < -eps, truth[c])]++;
      if (k === 0) firstSeen++;
    }
    return firstSeen;
  }

  readingOf(entry) {
    let low = 0;
    let high = this.nReadings;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.indptr[middle] <= entry) low = middle;
      else high = middle;
    }
    return low;
  }

  // Every reading of one cell, in order: what it said, what it added, what came out.
  history(c) {
    const l0 = this.logOddsPrior[this.isWall[c]];
    const terms = [];
    for (let e = this.last[c]; e >= 0; e = this.previous[e]) {
      const said = this.logOdds[e];
      const total = this.before[e] + said + this.priorWeight(this.rank[e] + 1) * l0;
      const added = this.once ? said : said - l0;
      terms.push({ reading: this.readingOf(e), said, added, total });
    }
    return { prior: l0, terms: terms.reverse() };
  }
}

// Scores from the counts, as occsim.metrics has them; 0 / 0 is NaN: undefined.
const SCORES = {
  precision: ([tp, fp]) => tp / (tp + fp),
  recall: ([tp, , fn]) => tp / (tp + fn),
  f2: ([tp, fp, fn]) => (5 * tp) / (5 * tp + 4 * fn + fp),
};

function scoreSeries(curves, nCells) {
  const length = curves.explored.length;
  const series = { coverage: new Float64Array(length) };
  for (const name of Object.keys(SCORES)) series[name] = new Float64Array(length);
  for (let s = 0; s < length; s++) {
    const counts = curves.counts.map((curve) => curve[s]);
    for (const [name, formula] of Object.entries(SCORES)) {
      series[name][s] = formula(counts);
    }
    series.coverage[s] = curves.explored[s] / nCells;
  }
  return series;
}
