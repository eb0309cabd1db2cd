// The two canvases: sizes, and the way between px of the drawing and of the screen.

const PANE_GAP = 16;
const CAPTION_HEIGHT = 22;
const COLUMN_GAP = 32;
const SIDE_MIN = 240; // width of the controls beside the stage, px
const SIDE_MAX = 380;

// Largest scale at which two pictures fit a box, side by side or one above the other.
function arrange(box, { widthPx, heightPx }, arrangement) {
  if (arrangement === "narrow") {
    return { scale: Math.min(box.width / widthPx, box.height / heightPx), stacked: true };
  }
  const beside = Math.min((box.width - PANE_GAP) / 2 / widthPx, box.height / heightPx);
  const half = (box.height - PANE_GAP - CAPTION_HEIGHT) / 2;
  const above = Math.min(box.width / widthPx, half / heightPx);
  const stacked = above > beside;
  return { scale: stacked ? above : beside, stacked };
}

// Sizes of the canvases from the room that the page gives.
function layOut(p) {
  const { root, model } = p;
  const arrangement = getComputedStyle(root).getPropertyValue("--arrangement").trim();
  const beside = arrangement === "wide" ? SIDE_MIN + COLUMN_GAP : 0;
  const width = root.clientWidth - beside;
  const height = root.querySelector(".measure").clientHeight;
  const { scale, stacked } = arrange({ width, height }, model, arrangement);
  p.scale = Math.max(0, scale); // nothing fits while the page is hidden
  root.querySelector(".stage").dataset.stacked = stacked ? "1" : "0";
  const picture = model.widthPx * p.scale;
  giveRestToControls(root, width - (stacked ? picture : 2 * picture + PANE_GAP));
  for (const canvas of Object.values(p.canvases)) {
    canvas.style.width = `${picture}px`;
    canvas.style.height = `${model.heightPx * p.scale}px`;
    canvas.width = Math.round(picture * pixelRatio());
    canvas.height = Math.round(model.heightPx * p.scale * pixelRatio());
  }
  p.paper = scaledPreview(p);
}

// Width that the pictures cannot use goes to the sliders.
function giveRestToControls(root, rest) {
  const side = clamp(SIDE_MIN + rest, SIDE_MIN, SIDE_MAX);
  root.style.setProperty("--side", `${Math.floor(side)}px`);
}

// Reduced once: a good filter on every frame would take longer than all other drawing.
function scaledPreview({ canvases, preview, header }) {
  const { width, height } = canvases.drawing;
  const paper = offscreen(width, height);
  const context = paper.getContext("2d");
  context.fillStyle = header.colours.paper;
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = "high";
  if (preview) context.drawImage(preview, 0, 0, width, height);
  return paper;
}

// The flat cell that holds a point of the drawing, or null outside it.
function cellHolding({ cellPx, nCols, widthPx, heightPx }, x, y) {
  if (!(x >= 0 && y >= 0 && x < widthPx && y < heightPx)) return null;
  return Math.floor(y / cellPx) * nCols + Math.floor(x / cellPx);
}

// The flat cell under a pointer event on one of the canvases, or null.
function cellAt(p, event) {
  const box = event.target.getBoundingClientRect();
  const scale = p.model.widthPx / box.width;
  const point = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  return cellHolding(p.model, ...point);
}

const placeOf = ({ nCols }, c) => [Math.floor(c / nCols), c % nCols];

// The part of a cell that lies in the drawing: the last row and column may be cut.
function boxOf(model, c) {
  const { cellPx, widthPx, heightPx } = model;
  const [y, x] = placeOf(model, c).map((i) => i * cellPx);
  return { x, y, width: Math.min(cellPx, widthPx - x), height: Math.min(cellPx, heightPx - y) };
}

function centreOf(model, c) {
  const { x, y, width, height } = boxOf(model, c);
  return [x + width / 2, y + height / 2];
}

// Where a cell's centre is on the map canvas, as a pointer event would say it.
function pointAt(p, c) {
  const [x, y] = centreOf(p.model, c);
  const box = p.canvases.map.getBoundingClientRect();
  return { clientX: box.left + x * p.scale, clientY: box.top + y * p.scale };
}
