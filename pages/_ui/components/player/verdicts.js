// Two maps judged against each other: numbers only, independent of the page.
//
// Maps of one cell size are compared cell by cell, others pixel by pixel. A unit is
// *looked at* where both maps have a reading of it.

const SAME = 0; // the verdicts agree; else 1 + the index of the map that is right, or
// where there is no truth, that declares a wall
const LOOKED = 4; // added where both maps have a reading

// `pixels` is the world as a grid of cells of 1 px.
function newComparison(a, b, pixels, isJudged = true) {
  const isByCell = a.log.cellPx === b.log.cellPx;
  const { heightPx, widthPx, cellPx, nRows, nCols, nCells, truth } = isByCell ? a.log : pixels;
  const grid = { heightPx, widthPx, cellPx, nRows, nCols, nCells, truth };
  const codes = new Uint8Array(nCells);
  const comparison = { ...grid, pair: [a, b], isByCell, isJudged, codes, tally: new Int32Array(8) };
  for (let u = 0; u < nCells; u++) comparison.tally[(codes[u] = codeAt(comparison, u))]++;
  return comparison;
}

// The cell of a map that holds a unit.
function cellOver({ isByCell, nCols }, { log }, u) {
  if (isByCell) return u;
  const [row, column] = [Math.floor(u / nCols), u % nCols];
  return Math.floor(row / log.cellPx) * log.nCols + Math.floor(column / log.cellPx);
}

// The verdicts of both maps on a unit: wall or not.
function verdictsAt(comparison, u) {
  return comparison.pair.map((map) => {
    const c = cellOver(comparison, map, u);
    return declaresWall(map, logOddsAt(map, c));
  });
}

function codeAt(comparison, u) {
  const [a, b] = comparison.pair;
  const ca = cellOver(comparison, a, u);
  const cb = cellOver(comparison, b, u);
  const looked = a.log.counts[ca] > 0 && b.log.counts[cb] > 0 ? LOOKED : 0;
  const isWallA = declaresWall(a, logOddsAt(a, ca));
  if (isWallA === declaresWall(b, logOddsAt(b, cb))) return looked + SAME;
  const isWall = comparison.isJudged ? Boolean(comparison.truth[u]) : true;
  return looked + (isWallA === isWall ? 1 : 2);
}

// Judges a unit again; the tally follows. Returns whether its code changed.
function judge(comparison, u) {
  const { codes, tally } = comparison;
  const code = codeAt(comparison, u);
  if (code === codes[u]) return false;
  tally[codes[u]]--;
  tally[code]++;
  codes[u] = code;
  return true;
}

// Calls back with each unit that a cell of a map covers.
function eachUnit(comparison, log, c, visit) {
  if (comparison.isByCell) {
    visit(c);
    return;
  }
  const { x, y, width, height } = boxOf(log, c);
  for (let row = y; row < y + height; row++) {
    for (let column = x; column < x + width; column++) visit(row * comparison.nCols + column);
  }
}

// How often the maps differ, and how often each is right.
function countsOf({ tally }, isLooked) {
  const right = [1, 2].map((code) => tally[code + (isLooked ? LOOKED : 0)]);
  return { differ: right[0] + right[1], right };
}

// The next unit after another, row by row and round again, at which the maps differ and
// one of `whos` (0, 1) is right; null where there is none.
function nextDifference({ codes, nCells }, whos, isLooked, after) {
  const wanted = whos.map((who) => 1 + who + (isLooked ? LOOKED : 0));
  for (let i = 1; i <= nCells; i++) {
    const u = (after + i) % nCells;
    if (wanted.includes(codes[u])) return u;
  }
  return null;
}
