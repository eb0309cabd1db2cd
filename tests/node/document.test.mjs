import assert from "node:assert/strict";
import { test } from "node:test";
import { inflateSync } from "node:zlib";
import { load, seeded } from "./scripts.mjs";

const board = load("board");

// A board without a page: what undo and commit need, the rest does nothing.
function newBoard({ width = 150, height = 100, mode = "walls", overlay, points = [] } = {}) {
  const size = width * height;
  const header = { mode, token: "t", rev: 1, width, height, tilePx: 64, points, maxPoints: 5000 };
  const doc = board.newDocument(header, new Uint8Array(size), overlay ?? new Uint8Array(size));
  const sent = [];
  return {
    header,
    doc,
    sent,
    size: { width, height },
    overlay: { width, height, pixels: doc.overlay },
    doubtful: new Uint8Array(size),
    pieces: [],
    mask: { width, height, pixels: new Uint8Array(size) },
    tint: { getContext: () => ({ putImageData() {} }) },
    root: { dataset: {}, querySelector: () => ({ setAttribute() {}, dataset: {} }) },
    camera: board.newCamera(),
    sending: 0,
    said: 0,
    commitTimer: 0,
    lastCommit: -Infinity,
    closed: true, // nothing is painted
    setStateValue: (_, value) => sent.push(value),
  };
}
globalThis.ImageData ??= class {
  constructor(width, height) {
    this.data = new Uint8ClampedArray(4 * width * height);
  }
};

function stroke(b, kind, points, width = 6) {
  const before = b.doc.overlay.slice();
  board.addStroke(b, before, board.applyStroke(b.overlay, { kind, width, points }));
  clearTimeout(b.commitTimer);
  b.commitTimer = 0;
}

function randomStroke(b, random) {
  const kinds = ["brush", "line", "rectangle", "outline", "eraser", "clear"];
  const point = () => [random() * 170 - 10, random() * 120 - 10];
  stroke(b, kinds[Math.floor(random() * kinds.length)], [point(), point()], 1 + random() * 20);
}

const step = (b, go) => {
  go(b);
  clearTimeout(b.commitTimer);
  b.commitTimer = 0;
};

test("every stroke is undone and done again by itself", () => {
  const random = seeded(1);
  const b = newBoard();
  const held = [b.doc.overlay.slice()];
  while (b.doc.past.length < 40) {
    const n = b.doc.past.length;
    randomStroke(b, random);
    if (b.doc.past.length > n) held.push(b.doc.overlay.slice());
  }
  for (let k = 39; k >= 0; k--) {
    step(b, board.undo);
    assert.deepEqual(b.doc.overlay, held[k]);
  }
  step(b, board.undo); // there is nothing more
  for (let k = 1; k <= 40; k++) {
    step(b, board.redo);
    assert.deepEqual(b.doc.overlay, held[k]);
  }
});

test("a stroke that changes nothing is no step", () => {
  const b = newBoard();
  stroke(b, "rectangle", [[10, 10], [40, 40]]);
  stroke(b, "brush", [[20, 20], [30, 30]]);
  assert.equal(b.doc.past.length, 1);
});

test("a new stroke forgets what was undone", () => {
  const b = newBoard();
  stroke(b, "brush", [[20, 20], [30, 30]]);
  step(b, board.undo);
  stroke(b, "brush", [[60, 20], [70, 30]]);
  assert.equal(b.doc.future.length, 0);
});

// What occsim.Corrections.with_tiles reads, by a loop over every pixel.
function replaced(overlay, { width, height }, packed) {
  const out = overlay.slice();
  const [columns, rows] = [Math.ceil(width / 64), Math.ceil(height / 64)];
  const bit = (i) => (packed[i >> 3] >> (7 - (i & 7))) & 1;
  let at = 8 * Math.ceil((columns * rows) / 8);
  for (let tile = 0; tile < columns * rows; tile++) {
    if (!bit(tile)) continue;
    for (let place = 0; place < 64 * 64; place++) {
      const x = (tile % columns) * 64 + (place % 64);
      const y = Math.floor(tile / columns) * 64 + Math.floor(place / 64);
      if (x < width && y < height) out[y * width + x] = bit(at + place) + 2 * bit(at + 4096 + place);
    }
    at += 2 * 4096;
  }
  assert.equal(packed.length, at / 8);
  return out;
}

test("the tiles of a commit lead from what was imposed to what is on the board", () => {
  const random = seeded(2);
  const imposed = Uint8Array.from({ length: 150 * 100 }, () => Math.floor(random() * 3));
  const b = newBoard({ overlay: imposed });
  for (let k = 0; k < 30; k++) {
    randomStroke(b, random);
    if (k % 5 === 4) step(b, board.undo);
    assert.deepEqual(replaced(imposed, b.size, board.changedTiles(b)), b.doc.overlay);
  }
});

test("only tiles that differ are committed, and none where all was undone", () => {
  const b = newBoard();
  stroke(b, "rectangle", [[66, 2], [70, 6]]); // in the second of three columns
  assert.equal(board.changedTiles(b).length, 1 + 1024);
  step(b, board.undo);
  assert.deepEqual([...board.changedTiles(b)], [0]);
});

test("of commits that overtake each other only the last is sent", async () => {
  const b = newBoard();
  stroke(b, "brush", [[20, 20], [30, 30]]);
  board.flush(b);
  board.flush(b);
  await new Promise((done) => setTimeout(done, 200));
  assert.equal(b.sent.length, 1);
  assert.deepEqual([b.sent[0].rev, b.sent[0].token, typeof b.sent[0].tiles], [1, "t", "string"]);
});

test("a press elsewhere sends at once what is not sent yet, and only that", async () => {
  const b = newBoard();
  board.sendNow(b);
  assert.equal(b.sent.length, 0);
  stroke(b, "brush", [[20, 20], [30, 30]]);
  board.flush(b); // is being compressed
  board.sendNow(b);
  assert.equal(b.sent.length, 1);
  const tiles = inflateSync(Buffer.from(b.sent[0].tiles, "base64"));
  assert.deepEqual(tiles, Buffer.from(board.changedTiles(b)));
  await new Promise((done) => setTimeout(done, 200));
  board.sendNow(b);
  assert.equal(b.sent.length, 1);
});

test("the oldest strokes are forgotten where their patches grow too many", () => {
  const b = newBoard({ width: 2000, height: 4000 });
  // Strokes of single pixels far apart: each has 200,000 runs.
  for (let k = 0; k < 6; k++) {
    const before = b.doc.overlay.slice();
    for (let i = k; i < b.doc.overlay.length; i += 37) b.doc.overlay[i] = 1;
    board.addStroke(b, before, board.wholeOf(b.size));
    clearTimeout(b.commitTimer);
    b.commitTimer = 1; // no commit of such size is made here
  }
  const runs = b.doc.past.reduce((sum, patch) => sum + patch.runs.length / 3, 0);
  assert.ok(runs <= board.UNDO_RUNS, `${runs} runs`);
  assert.ok(b.doc.past.length >= 1 && b.doc.past.length < 6);
});

test("undo goes on where a board comes back with what it held, and else not", () => {
  const b = newBoard();
  stroke(b, "brush", [[20, 20], [30, 30]]);
  const back = newBoard({ overlay: b.doc.overlay.slice() }).doc;
  assert.ok(board.holdsTheSame(b.doc, back));
  const other = newBoard().doc;
  assert.ok(!board.holdsTheSame(b.doc, other));
});

test("points are undone and done again", () => {
  const b = newBoard({ mode: "trajectory", points: [[1, 2, 1]] });
  b.commitTimer = 1;
  board.setPoints(b, [[1, 2, 1], [3, 4, 1]]);
  board.setPoints(b, [[1, 2, 1], [3, 4, 1]]); // the same again is no step
  assert.equal(b.doc.past.length, 1);
  board.undo(b);
  assert.deepEqual(b.doc.points, [[1, 2, 1]]);
  board.redo(b);
  assert.deepEqual(b.doc.points, [[1, 2, 1], [3, 4, 1]]);
});

test("pieces touch at corners, and not across the ends of rows", () => {
  // Rows of four: the first piece goes down a diagonal, the last pixel is alone.
  const flags = Uint8Array.from([1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0]);
  const pieces = board.piecesOf(flags, 4);
  assert.deepEqual(pieces.map(({ pixels }) => pixels), [[0, 5, 10], [3], [12]]);
  assert.deepEqual(pieces[0].box, { x0: 0, y0: 0, x1: 3, y1: 3 });
});

test("pieces are decided in one step, which undo takes back", () => {
  const b = newBoard();
  b.doubtful.fill(1, 10, 14);
  b.doubtful.fill(1, 1520, 1523);
  b.pieces = board.piecesOf(b.doubtful, 150);
  board.decide(b, b.pieces, board.ADDED);
  assert.equal(board.openPieces(b).length, 0);
  assert.equal(b.doc.overlay.reduce((sum, value) => sum + (value === board.ADDED), 0), 7);
  assert.equal(b.doc.past.length, 1);
  step(b, board.undo);
  assert.equal(board.openPieces(b).length, 2);
  clearTimeout(b.commitTimer);
});
