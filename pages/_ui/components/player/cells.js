// The cells as a picture of one pixel each, coloured by belief or by correctness, and
// the hatching on those that no reading has seen.

const HATCH_GAP = 5; // on the screen, px
const TINT = 0.55; // share of an overlay's colour over the grey beneath

function newPicture(model, colours) {
  const canvas = offscreen(model.nCols, model.nRows);
  const image = canvas.getContext("2d").createImageData(model.nCols, model.nRows);
  const pixels = new Uint32Array(image.data.buffer);
  return { canvas, image, pixels, colours, inks: null, stale: true };
}

// The colours of one view of the map.
function inksOf(colours, { overlay, region }) {
  const [dark, light] = [rgbOf(colours.beliefOccupied), rgbOf(colours.beliefFree)];
  const tint = rgbOf(overlay === "truth" ? colours.groundTruth : colours.wallMask);
  const levels = Array.from({ length: 256 }, (_, i) => mixed(dark, light, i / 255));
  // In the order of the counts: TP, FP, FN, TN.
  const outcomes = [colours.hit, colours.falseWall, colours.missedWall, colours.free];
  return {
    grey: Uint32Array.from(levels, pixelOf),
    tinted: Uint32Array.from(levels, (rgb) => pixelOf(mixed(rgb, tint, TINT))),
    outcomes: outcomes.map((hex) => pixelOf(rgbOf(hex))),
    unseen: pixelOf(rgbOf(colours.unseen)),
    marks: { wall_mask: "isWall", truth: "truth" }[overlay],
    isErrors: overlay === "errors",
    region,
  };
}

function colourAt(inks, model, c) {
  const logOdds = logOddsAt(model, c);
  if (!inks.isErrors) {
    const level = Math.round(255 * pFreeOf(logOdds));
    return (model[inks.marks]?.[c] ? inks.tinted : inks.grey)[level];
  }
  const isScored = inks.region !== (model.counts[c] > 0 ? "unexplored" : "explored");
  return isScored ? inks.outcomes[outcomeAt(model, c, logOdds)] : inks.unseen;
}

function paintAll(picture, model, state) {
  picture.inks = inksOf(picture.colours, state);
  for (let c = 0; c < model.nCells; c++) picture.pixels[c] = colourAt(picture.inks, model, c);
  picture.stale = true;
}

// Recolours only the cells of these entries: what a step of the replay changed.
function paintEntries(picture, model, [from, to]) {
  for (let e = from; e < to; e++) {
    const c = model.cell[e];
    picture.pixels[c] = colourAt(picture.inks, model, c);
  }
  picture.stale ||= to > from;
}

// ---- onto a canvas whose units are px of the drawing ---------------------------------

function drawPicture(picture, model, context) {
  const { canvas, image, inks } = picture;
  if (picture.stale) canvas.getContext("2d").putImageData(image, 0, 0);
  drawCells(context, canvas, model);
  if (inks.isErrors) drawHatch(picture, model, context);
  picture.stale = false;
}

function drawCells(context, canvas, { nCols, nRows, cellPx }) {
  context.imageSmoothingEnabled = false;
  context.drawImage(canvas, 0, 0, nCols * cellPx, nRows * cellPx);
}

function drawHatch(picture, model, context) {
  const { width, height } = context.canvas;
  const { hatch } = picture;
  const isSame = hatch?.width === width && hatch.height === height;
  if (!isSame) picture.hatch = offscreen(width, height);
  if (!isSame || picture.stale) renewHatch(picture, model, context.getTransform());
  drawUnscaled(context, picture.hatch);
}

// A pattern, kept only where the mask of unseen cells is opaque.
function renewHatch({ hatch, colours }, model, transform) {
  const context = hatch.getContext("2d");
  context.reset();
  context.setTransform(transform);
  drawCells(context, unseenMask(model), model);
  context.resetTransform();
  context.globalCompositeOperation = "source-in";
  context.fillStyle = hatchPattern(context, colours.unseenHatch);
  context.fillRect(0, 0, hatch.width, hatch.height);
}

function unseenMask({ nCols, nRows, counts }) {
  const mask = offscreen(nCols, nRows);
  const context = mask.getContext("2d");
  const image = context.createImageData(nCols, nRows);
  const alpha = new Uint32Array(image.data.buffer);
  for (let c = 0; c < alpha.length; c++) alpha[c] = counts[c] ? 0 : 255 << 24;
  context.putImageData(image, 0, 0);
  return mask;
}

function hatchPattern(context, colour) {
  const side = Math.round(HATCH_GAP * pixelRatio());
  const tile = offscreen(side, side);
  const pen = tile.getContext("2d");
  pen.strokeStyle = colour;
  pen.lineWidth = 0.8 * pixelRatio();
  pen.beginPath();
  for (const shift of [-side, 0, side]) {
    pen.moveTo(shift, side);
    pen.lineTo(shift + side, 0);
  }
  pen.stroke();
  return context.createPattern(tile, "repeat");
}
