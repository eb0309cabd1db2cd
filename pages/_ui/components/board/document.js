// What is edited: strokes over a base mask, or a list of points; undo, redo, commit.
//
// Python owns the document and imposes it with a `rev`; every commit echoes that rev and
// carries all edits since it was imposed, so commits may be dropped or merged on the way
// and the last one still says everything. Strokes are counted from the first one ever
// drawn under this rev: when Python has laid the oldest into its base mask it imposes the
// same rev with a higher `first`, and what was drawn meanwhile stays.

const UNDO_DEPTH = 200;
const COMMIT_GAP_MS = 120;

function newDocument(header, base) {
  return {
    identity: identityOf(header),
    first: header.first,
    base,
    strokes: header.strokes.map(decodeStroke),
    points: header.points.map(([x, y, kind]) => [x / LATTICE, y / LATTICE, kind]),
    undone: [],
    past: [],
    future: [],
  };
}

const identityOf = (header) => [header.mode, header.token, header.rev, header.width, header.height].join("|");

// The same document again, its oldest strokes now part of the base.
function advance(doc, header, base) {
  if (header.first > doc.first) {
    doc.strokes.splice(0, header.first - doc.first);
    doc.first = header.first;
    doc.base = base;
  }
  return doc;
}

function addStroke(b, stroke) {
  b.doc.strokes.push(stroke);
  b.doc.undone = [];
  commit(b);
}

function redrawMask(b) {
  b.grid.pixels.set(b.doc.base);
  for (const stroke of b.doc.strokes) applyStroke(b.grid, stroke);
  refreshTint(b, wholeOf(b.grid));
}

const wholeOf = (grid) => ({ x0: 0, y0: 0, x1: grid.width, y1: grid.height });

// Replaces the points; what was there before can be had back.
function setPoints(b, points, before = b.doc.points) {
  b.doc.points = points;
  if (JSON.stringify(points) === JSON.stringify(before)) return;
  b.doc.past.push(before);
  if (b.doc.past.length > UNDO_DEPTH) b.doc.past.shift();
  b.doc.future = [];
  commit(b);
}

const canUndo = (b) => (b.header.mode === "walls" ? b.doc.strokes : b.doc.past).length > 0;
const canRedo = (b) => (b.header.mode === "walls" ? b.doc.undone : b.doc.future).length > 0;

function undo(b) {
  stopGesture(b);
  if (!canUndo(b)) return;
  if (b.header.mode === "walls") {
    b.doc.undone.push(b.doc.strokes.pop());
    redrawMask(b);
  } else {
    b.doc.future.push(b.doc.points);
    b.doc.points = b.doc.past.pop();
    b.selected = -1;
  }
  commit(b);
}

function redo(b) {
  stopGesture(b);
  if (!canRedo(b)) return;
  if (b.header.mode === "walls") {
    const stroke = b.doc.undone.pop();
    b.doc.strokes.push(stroke);
    refreshTint(b, applyStroke(b.grid, stroke));
  } else {
    b.doc.past.push(b.doc.points);
    b.doc.points = b.doc.future.pop();
    b.selected = -1;
  }
  commit(b);
}

// At once, but not more often than Streamlit can follow: of a quick series the last
// commit holds all the others.
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
  const { rev, token, mode } = b.header;
  const edits =
    mode === "walls"
      ? { first: b.doc.first, strokes: b.doc.strokes.map((stroke) => stroke.code) }
      : { points: b.doc.points.map(([x, y, kind]) => [Math.round(x * LATTICE), Math.round(y * LATTICE), kind]) };
  b.setStateValue("committed", { rev, token, ...edits });
}
