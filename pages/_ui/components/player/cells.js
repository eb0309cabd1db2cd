// The cells as a picture of one pixel each, coloured by belief or by correctness, and
// the hatching on those that no reading has seen.

const HATCH_GAP = 6; // on the screen, px
const HATCH_ALPHA = 0.3; // a dark and a light line: one of them shows on any grey
const TINT = 0.55; // share of an overlay's colour over the grey beneath

// One pixel a cell, and the box of cells that changed since it was last drawn.
function newLayer({ nCols, nRows }) {
  const canvas = offscreen(nCols, nRows);
  const image = canvas.getContext("2d").createImageData(nCols, nRows);
  return { canvas, image, pixels: new Uint32Array(image.data.buffer), changed: newBox() };
}

const newBox = () => ({ x0: Infinity, y0: Infinity, x1: -1, y1: -1 });

function growBox(box, x, y) {
  if (x < box.x0) box.x0 = x;
  if (y < box.y0) box.y0 = y;
  if (x > box.x1) box.x1 = x;
  if (y > box.y1) box.y1 = y;
}

const wholeBox = ({ nCols, nRows }) => ({ x0: 0, y0: 0, x1: nCols - 1, y1: nRows - 1 });

function setPixel(layer, nCols, c, value) {
  if (layer.pixels[c] === value) return;
  layer.pixels[c] = value;
  growBox(layer.changed, c % nCols, Math.floor(c / nCols));
}

// Puts the changed pixels on the layer's canvas; returns their box, or null.
function flush(layer) {
  const box = layer.changed;
  if (box.x1 < 0) return null;
  const { x0, y0 } = box;
  const size = [box.x1 - x0 + 1, box.y1 - y0 + 1];
  layer.canvas.getContext("2d").putImageData(layer.image, 0, 0, x0, y0, ...size);
  layer.changed = newBox();
  return box;
}

// A picture of cells and its mask of unseen ones.
function newPicture(grid, colours) {
  return { cells: newLayer(grid), unseen: newLayer(grid), colours, inks: null, hatch: null };
}

// The colours of one view of the map.
function inksOf(colours, overlay) {
  const [dark, light] = [rgbOf(colours.beliefOccupied), rgbOf(colours.beliefFree)];
  const tint = rgbOf(overlay === "truth" ? colours.groundTruth : colours.wallMask);
  const levels = Array.from({ length: 256 }, (_, i) => mixed(dark, light, i / 255));
  // In the order of the counts: TP, FP, FN, TN.
  const outcomes = [colours.hit, colours.falseWall, colours.missedWall, colours.free];
  return {
    grey: Uint32Array.from(levels, pixelOf),
    tinted: Uint32Array.from(levels, (rgb) => pixelOf(mixed(rgb, tint, TINT))),
    outcomes: outcomes.map((hex) => pixelOf(rgbOf(hex))),
    overlay,
  };
}

function colourAt(inks, column, c) {
  const logOdds = logOddsAt(column, c);
  if (inks.overlay === "errors") return inks.outcomes[outcomeAt(column, c, logOdds)];
  const level = Math.round(255 * pFreeOf(logOdds));
  return (isMarked(inks.overlay, column, c) ? inks.tinted : inks.grey)[level];
}

function isMarked(overlay, { drawn, log }, c) {
  if (overlay === "wall_mask") return drawn[c] === WALL;
  return overlay === "truth" && log.truth[c];
}

const OPAQUE = (255 << 24) >>> 0;

function paintCell(picture, column, c) {
  const { nCols, counts } = column.log;
  setPixel(picture.cells, nCols, c, colourAt(picture.inks, column, c));
  setPixel(picture.unseen, nCols, c, counts[c] ? 0 : OPAQUE);
}

function paintAll(picture, column, overlay) {
  picture.inks = inksOf(picture.colours, overlay);
  for (let c = 0; c < column.log.nCells; c++) paintCell(picture, column, c);
}

// Recolours only the cells of these entries: what a step of the replay changed.
function paintEntries(picture, column, [from, to]) {
  const { cell } = column.log;
  for (let e = from; e < to; e++) paintCell(picture, column, cell[e]);
}

// ---- onto a canvas whose units are px of the drawing ---------------------------------

function drawPicture(picture, grid, context) {
  flush(picture.cells);
  drawCells(context, picture.cells.canvas, grid);
  drawHatch(picture, grid, context);
}

function drawCells(context, canvas, { nCols, nRows, cellPx }) {
  context.imageSmoothingEnabled = false;
  context.drawImage(canvas, 0, 0, nCols * cellPx, nRows * cellPx);
}

function drawHatch(picture, grid, context) {
  const { width, height } = context.canvas;
  const changed = flush(picture.unseen);
  const isSame = picture.hatch?.width === width && picture.hatch.height === height;
  if (!isSame) picture.hatch = offscreen(width, height);
  const box = isSame ? changed : wholeBox(grid);
  if (box) renewHatch(picture, grid, context, box);
  drawUnscaled(context, picture.hatch);
}

// A pattern, kept only where the mask of unseen cells is opaque; within a box of cells.
function renewHatch({ hatch, unseen, colours }, grid, onto, { x0, y0, x1, y1 }) {
  const transform = onto.getTransform();
  const context = hatch.getContext("2d");
  context.save();
  const at = (cells, scale) => cells * grid.cellPx * scale;
  // Whole pixels of the canvas, so that a part redrawn joins the rest without a seam.
  const left = Math.floor(at(x0, transform.a));
  const top = Math.floor(at(y0, transform.d));
  const right = Math.ceil(at(x1 + 1, transform.a));
  const bottom = Math.ceil(at(y1 + 1, transform.d));
  context.beginPath();
  context.rect(left, top, right - left, bottom - top);
  context.clip();
  context.clearRect(left, top, right - left, bottom - top);
  context.setTransform(transform);
  drawCells(context, unseen.canvas, grid);
  context.resetTransform();
  context.globalCompositeOperation = "source-in";
  context.fillStyle = hatchPattern(context, colours, ratioOf(onto.canvas));
  context.fillRect(left, top, right - left, bottom - top);
  context.restore();
}

function hatchPattern(context, colours, ratio) {
  const side = Math.round(HATCH_GAP * ratio);
  const tile = offscreen(side, side);
  const pen = tile.getContext("2d");
  pen.lineWidth = ratio;
  pen.globalAlpha = HATCH_ALPHA;
  for (const [colour, aside] of [
    [colours.hatchDark, 0],
    [colours.hatchLight, 1.4 * ratio],
  ]) {
    pen.strokeStyle = colour;
    pen.beginPath();
    for (const shift of [-side, 0, side]) {
      pen.moveTo(shift + aside - 1, side + 1);
      pen.lineTo(shift + aside + side + 1, -1);
    }
    pen.stroke();
  }
  return context.createPattern(tile, "repeat");
}
