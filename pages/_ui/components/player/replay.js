// A replay's bytes, inflated; occsim/io/replay.py describes the layout.

const HEADER_BYTES = 64;

function decodeReplay(buffer) {
  const word = new Uint32Array(buffer, 0, 12);
  const [, heightPx, widthPx, cellPx, nReadings, nEntries, nRuns, nValues] = word;
  const [indexBytes, previewBytes] = word.subarray(8);
  const [rangePx, fovRad] = new Float64Array(buffer, 48, 2);
  const nRows = Math.ceil(heightPx / cellPx);
  const nCols = Math.ceil(widthPx / cellPx);
  const nCells = nRows * nCols;
  const IndexArray = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[indexBytes];
  let at = HEADER_BYTES;
  const take = (Type, count) => {
    const part = new Type(buffer, at, count);
    at += part.byteLength;
    return part;
  };
  const takeFlags = () => unpackBits(take(Uint8Array, Math.ceil(nCells / 8)), nCells);
  const values = take(Float64Array, nValues);
  const poses = take(Float32Array, 3 * nReadings);
  const runs = [nReadings, nRuns, nRuns].map((count) => take(Uint32Array, count));
  const logOdds = Float64Array.from(take(IndexArray, nEntries), (i) => values[i]);
  const [isWall, truth] = [takeFlags(), takeFlags()];
  const preview = take(Uint8Array, previewBytes);
  const size = { heightPx, widthPx, cellPx, nRows, nCols, nCells, nReadings };
  const entries = { ...expandRuns(...runs, nEntries), logOdds };
  return { ...size, ...entries, rangePx, fovRad, isWall, truth, poses, preview };
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
