// A replay's parts, inflated; occsim/io/replay.py describes their layout.

// Takes arrays from a buffer, one after the other.
function readerOf(buffer, at) {
  const take = (Type, count) => {
    const part = new Type(buffer, at, count);
    at += part.byteLength;
    return part;
  };
  const takeFlags = (count) => unpackBits(take(Uint8Array, Math.ceil(count / 8)), count);
  return { take, takeFlags };
}

function gridOf(heightPx, widthPx, cellPx) {
  const nRows = Math.ceil(heightPx / cellPx);
  const nCols = Math.ceil(widthPx / cellPx);
  return { heightPx, widthPx, cellPx, nRows, nCols, nCells: nRows * nCols };
}

// The world's pixels are a grid of cells of 1 px, so that cells and pixels are read alike.
function decodeScene(buffer) {
  const [, heightPx, widthPx, nReadings, previewBytes] = new Uint32Array(buffer, 0, 5);
  const [rangePx, fovRad] = new Float64Array(buffer, 24, 2);
  const { take, takeFlags } = readerOf(buffer, 40);
  const poses = take(Float32Array, 3 * nReadings);
  const pixels = { ...gridOf(heightPx, widthPx, 1), truth: takeFlags(heightPx * widthPx) };
  const preview = take(Uint8Array, previewBytes);
  return { heightPx, widthPx, nReadings, rangePx, fovRad, poses, pixels, preview };
}

function decodeLog(buffer) {
  const word = new Uint32Array(buffer, 0, 10);
  const [nReadings, nEntries, nRuns, nValues, indexBytes] = word.subarray(4);
  const grid = gridOf(word[1], word[2], word[3]);
  const IndexArray = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[indexBytes];
  const { take, takeFlags } = readerOf(buffer, 40);
  const values = take(Float64Array, nValues);
  const runs = [nReadings, nRuns, nRuns].map((count) => take(Uint32Array, count));
  const logOdds = Float64Array.from(take(IndexArray, nEntries), (i) => values[i]);
  const truth = takeFlags(grid.nCells);
  return { ...grid, nReadings, ...expandRuns(...runs, nEntries), logOdds, truth };
}

// What the drawing says of each cell: 0 space, 1 wall, 2 nothing.
function decodeWalls(buffer) {
  const [, nRows, nCols] = new Uint32Array(buffer, 0, 3);
  const nCells = nRows * nCols;
  const { takeFlags } = readerOf(buffer, 12);
  const isWall = takeFlags(nCells);
  if (buffer.byteLength === 12 + Math.ceil(nCells / 8)) return isWall;
  const isUnknown = takeFlags(nCells);
  return isWall.map((wall, c) => (isUnknown[c] ? 2 : wall));
}

// Ranges are shares of the reach; what says nothing is NOTHING, what reaches farther than
// anything is believed REACH.
const NOTHING = 65535;
const REACH = 65534;

function decodeBeams(buffer) {
  const [, nScans, nBeams] = new Uint32Array(buffer, 0, 3);
  const [reachPx] = new Float64Array(buffer, 16, 1);
  const { take } = readerOf(buffer, 24);
  const bearings = take(Float32Array, nBeams);
  return { nBeams, reachPx, bearings, ranges: take(Uint16Array, nScans * nBeams) };
}

// The cells of each reading: entries indptr[s] to indptr[s + 1] are those of reading s.
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
