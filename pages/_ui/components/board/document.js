// What is edited: corrections over a base mask, or a list of points; undo, redo, commit.
//
// Python owns the document and imposes it with a `rev`; every commit echoes that rev and
// holds all differences from the imposed document, so commits may be lost or merged in
// transit: the last one is complete.

const UNDO_DEPTH = 200; // steps of a path
const UNDO_RUNS = 1e6; // of all strokes together, 12 bytes each
const COMMIT_GAP_MS = 120;

function newDocument(header, base, overlay) {
  const side = header.tilePx;
  return {
    identity: identityOf(header),
    mode: header.mode,
    base,
    imposed: overlay,
    overlay: overlay.slice(),
    columns: Math.ceil(header.width / side),
    touched: new Uint8Array(Math.ceil(header.width / side) * Math.ceil(header.height / side)),
    points: header.points,
    past: [],
    future: [],
  };
}

const identityOf = (header) => [header.mode, header.token, header.rev, header.width, header.height].join("|");

// Whether a board that returns is sent the contents that it had: then its undo stays.
function holdsTheSame(doc, other) {
  return (
    doc.mode === other.mode &&
    doc.columns === other.columns &&
    areEqual(doc.base, other.base) &&
    areEqual(doc.overlay, other.overlay) &&
    JSON.stringify(doc.points) === JSON.stringify(other.points)
  );
}

function areEqual(a, b) {
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return a.length === b.length;
}

// --- Corrections: a step is a patch, runs of pixels with what they were before. ---

// Records what a stroke changed since `before`, within a box.
function addStroke(b, before, box) {
  const patch = patchOf(b.doc.overlay, before, box, b.size.width);
  if (!patch) return;
  b.doc.past.push(patch);
  b.doc.future = [];
  let runs = 0;
  const kept = b.doc.past.findLastIndex((step) => (runs += step.runs.length / 3) > UNDO_RUNS);
  b.doc.past.splice(0, Math.min(kept + 1, b.doc.past.length - 1));
  touch(b, box);
  commit(b);
}

// {value, runs: [first pixel, number of pixels, value before, ...], box}, or null.
function patchOf(now, before, box, width) {
  const runs = [];
  let value = 0;
  for (let row = box.y0; row < box.y1; row++) {
    const end = row * width + box.x1;
    for (let i = row * width + box.x0; i < end; i++) {
      if (now[i] === before[i]) continue;
      const start = i;
      while (i + 1 < end && now[i + 1] !== before[i + 1] && before[i + 1] === before[start]) i++;
      runs.push(start, i + 1 - start, before[start]);
      value = now[start]; // a stroke gives all its pixels one value
    }
  }
  return runs.length ? { value, runs: Int32Array.from(runs), box } : null;
}

function applyPatch(b, patch, isUndone) {
  for (let i = 0; i < patch.runs.length; i += 3) {
    const [first, length, before] = patch.runs.subarray(i, i + 3);
    b.doc.overlay.fill(isUndone ? before : patch.value, first, first + length);
  }
  touch(b, patch.box);
  refreshMask(b, patch.box);
}

// Notes the tiles in which something may differ from what was imposed.
function touch(b, box) {
  const side = b.header.tilePx;
  for (let row = Math.floor(box.y0 / side); row * side < box.y1; row++) {
    const first = row * b.doc.columns;
    b.doc.touched.fill(1, first + Math.floor(box.x0 / side), first + Math.ceil(box.x1 / side));
  }
}

// One bit for each tile, whether it differs from what was imposed; then, for each that
// does, its added and its erased pixels: as occsim.Corrections.with_tiles reads them.
function changedTiles(b) {
  const { touched } = b.doc;
  const changed = [];
  touched.forEach((flag, tile) => flag && differs(b.doc, tileOf(b, tile)) && changed.push(tile));
  const head = Math.ceil(touched.length / 8);
  const size = (2 * b.header.tilePx ** 2) / 8;
  const bytes = new Uint8Array(head + size * changed.length);
  changed.forEach((tile, k) => {
    setBit(bytes, tile);
    packTile(b.doc.overlay, tileOf(b, tile), bytes.subarray(head + size * k, head + size * (k + 1)));
  });
  return bytes;
}

const setBit = (bytes, i) => (bytes[i >> 3] |= 128 >> (i & 7));

// The part of a tile that lies in the drawing: rows of `width` pixels from `first` on.
function tileOf(b, tile) {
  const side = b.header.tilePx;
  const [x, y] = [(tile % b.doc.columns) * side, Math.floor(tile / b.doc.columns) * side];
  const [width, height] = [Math.min(side, b.size.width - x), Math.min(side, b.size.height - y)];
  return { first: y * b.size.width + x, stride: b.size.width, width, height, side };
}

function differs({ overlay, imposed }, tile) {
  for (let row = 0; row < tile.height; row++) {
    const first = tile.first + row * tile.stride;
    for (let i = first; i < first + tile.width; i++) if (overlay[i] !== imposed[i]) return true;
  }
  return false;
}

function packTile(overlay, tile, bytes) {
  for (let row = 0; row < tile.height; row++) {
    const first = tile.first + row * tile.stride;
    for (let col = 0; col < tile.width; col++) {
      const value = overlay[first + col];
      const plane = value === ERASED ? tile.side : 0;
      if (value) setBit(bytes, (plane + row) * tile.side + col);
    }
  }
}

// --- Points: a step is the list as it was before. ---

// Replaces the points; the previous ones can be restored by undo.
function setPoints(b, points, before = b.doc.points) {
  b.doc.points = points;
  if (JSON.stringify(points) === JSON.stringify(before)) return;
  b.doc.past.push(before);
  if (b.doc.past.length > UNDO_DEPTH) b.doc.past.shift();
  b.doc.future = [];
  commit(b);
}

function exchangePoints(b, points) {
  const before = b.doc.points;
  b.doc.points = points;
  b.selected = -1;
  return before;
}

// --- Both ---

function undo(b) {
  stopGesture(b);
  if (!b.doc.past.length) return;
  b.doc.future.push(stepped(b, b.doc.past.pop(), true));
  commit(b);
}

function redo(b) {
  stopGesture(b);
  if (!b.doc.future.length) return;
  b.doc.past.push(stepped(b, b.doc.future.pop(), false));
  commit(b);
}

// Goes one step and returns the step that leads back.
function stepped(b, step, isUndone) {
  if (b.header.mode !== "walls") return exchangePoints(b, step);
  applyPatch(b, step, isUndone);
  return step;
}

// Immediately, but not more often than Streamlit can follow: in a quick series the last
// commit contains all others.
function commit(b) {
  remember(b);
  showState(b);
  if (b.commitTimer) return;
  const wait = b.lastCommit + COMMIT_GAP_MS - performance.now();
  if (wait <= 0) return flush(b);
  b.commitTimer = setTimeout(() => flush(b), wait);
}

function flush(b) {
  clearTimeout(b.commitTimer);
  b.commitTimer = 0;
  b.lastCommit = performance.now();
  send(b).catch((error) => fail(b, error));
}

async function send(b) {
  const turn = ++b.sending;
  const { header } = b;
  const tiles = header.mode === "walls" ? await deflated(changedTiles(b)) : null;
  // A commit that was begun later is more complete.
  if (turn === b.sending) say(b, header, tiles);
}

function say(b, { rev, token }, tiles) {
  b.said = b.sending;
  const edits = tiles ? { tiles: base64(tiles) } : { points: b.doc.points };
  b.setStateValue("committed", { rev, token, ...edits });
}

// A press elsewhere may lead away from the board: what is not sent yet goes before it.
function sendNow(b) {
  if (!b.commitTimer && b.said === b.sending) return;
  clearTimeout(b.commitTimer);
  Object.assign(b, { commitTimer: 0, lastCommit: performance.now(), sending: b.sending + 1 });
  say(b, b.header, b.header.mode === "walls" ? stored(changedTiles(b)) : null);
}
