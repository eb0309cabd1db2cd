// Doubtful pieces of the mask, or beside it, that wait for a decision: wall or not.

const PIECE_REACH_CSS_PX = 8; // so far from the pointer a piece is still meant

const AROUND = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

// The connected pieces of a mask: {pixels, box} each.
function piecesOf(flags, width) {
  const left = flags.slice();
  const pieces = [];
  for (let i = 0; i < left.length; i++) if (left[i]) pieces.push(pieceFrom(left, i, width));
  return pieces;
}

// Takes one piece out of a mask, from one of its pixels on.
function pieceFrom(left, start, width) {
  const pixels = [start];
  const box = noBox();
  left[start] = 0;
  for (let k = 0; k < pixels.length; k++) {
    const [col, row] = [pixels[k] % width, Math.floor(pixels[k] / width)];
    growBox(box, col, row, col + 1, row + 1);
    for (const [dx, dy] of AROUND) {
      const next = (row + dy) * width + col + dx;
      if (!left[next] || col + dx < 0 || col + dx >= width) continue;
      left[next] = 0;
      pixels.push(next);
    }
  }
  return { pixels, box };
}

const isOpen = (b, piece) => piece.pixels.some((i) => !b.doc.overlay[i]);
const openPieces = (b) => b.pieces.filter((piece) => isOpen(b, piece));

// Makes pieces wall, or not wall: one step for undo.
function decide(b, pieces, value) {
  const before = b.doc.overlay.slice();
  const box = pieces.reduce((all, piece) => unionBox(all, piece.box), noBox());
  for (const { pixels } of pieces) for (const i of pixels) b.doc.overlay[i] = value;
  refreshMask(b, box);
  addStroke(b, before, box);
}

function decideOne(value) {
  return (b, point) => {
    const piece = nearestPiece(b, point, PIECE_REACH_CSS_PX / b.camera.scale);
    return piece && { move() {}, end: () => decide(b, [piece], value), cancel() {} };
  };
}

function nearestPiece(b, [x, y], reach) {
  let [best, nearest] = [null, reach];
  for (const piece of openPieces(b)) {
    const { x0, y0, x1, y1 } = piece.box;
    if (x < x0 - reach || x > x1 + reach || y < y0 - reach || y > y1 + reach) continue;
    for (const i of piece.pixels) {
      const away = Math.hypot((i % b.size.width) + 0.5 - x, Math.floor(i / b.size.width) + 0.5 - y);
      if (away <= nearest) [best, nearest] = [piece, away];
    }
  }
  return best;
}

// Puts the cursor of the keyboard on the next piece that is open, in reading order.
function nextPiece(b) {
  const open = openPieces(b);
  if (!open.length) return;
  const [x, y] = b.keyboard ? b.keyboard.map(Math.floor) : [-1, 0];
  const here = y * b.size.width + x;
  const { pixels } = open.find((piece) => piece.pixels[0] > here) ?? open[0];
  b.keyboard = [(pixels[0] % b.size.width) + 0.5, Math.floor(pixels[0] / b.size.width) + 0.5];
  b.canvas.focus({ preventScroll: true });
  reveal(b.camera, b.size, b.keyboard);
}
