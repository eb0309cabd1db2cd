// The cells as a picture of one pixel each, coloured by belief or by correctness, and
// the hatching on those that no reading has seen.

const HATCH_GAP = 5; // on the screen, px
const TINT = 0.55; // share of an overlay's colour over the grey beneath

class CellPicture {
  constructor(model, colours) {
    this.model = model;
    this.colours = colours;
    this.canvas = offscreen(model.nCols, model.nRows);
    this.context = this.canvas.getContext("2d");
    this.image = this.context.createImageData(model.nCols, model.nRows);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.mask = offscreen(model.nCols, model.nRows);
    this.stale = true;
  }

  // ---- colours ---------------------------------------------------------------------

  prepare(overlay, allCells) {
    const { colours, model } = this;
    const [dark, light] = [rgbOf(colours.beliefOccupied), rgbOf(colours.beliefFree)];
    const tint = rgbOf(overlay === "truth" ? colours.groundTruth : colours.wallMask);
    const levels = Array.from({ length: 256 }, (_, i) => mixed(dark, light, i / 255));
    this.grey = Uint32Array.from(levels, pixelOf);
    this.tinted = Uint32Array.from(levels, (rgb) => pixelOf(mixed(rgb, tint, TINT)));
    // In the order of the counts: TP, FP, FN, TN.
    const verdict = [colours.hit, colours.falseWall, colours.missedWall, colours.free];
    this.verdict = verdict.map((hex) => pixelOf(rgbOf(hex)));
    this.unseen = pixelOf(rgbOf(colours.unseen));
    this.marked = { wall_mask: model.isWall, truth: model.truth }[overlay] ?? null;
    this.errors = overlay === "errors";
    this.allCells = allCells;
  }

  belief(c) {
    const level = Math.round(255 * pFreeOf(this.model.mapLogOdds(c)));
    return this.marked?.[c] ? this.tinted[level] : this.grey[level];
  }

  correctness(c) {
    const { model } = this;
    if (model.counts[c] === 0 && !this.allCells) return this.unseen;
    return this.verdict[countIndex(model.isOccupied(c), model.truth[c])];
  }

  paintAll(overlay, allCells) {
    this.prepare(overlay, allCells);
    for (let c = 0; c < this.pixels.length; c++) {
      this.pixels[c] = this.errors ? this.correctness(c) : this.belief(c);
    }
    this.stale = true;
  }

  // Recolours only the cells of these entries: what a step of the replay changed.
  paintEntries([from, to]) {
    for (let e = from; e < to; e++) {
      const c = this.model.cell[e];
      this.pixels[c] = this.errors ? this.correctness(c) : this.belief(c);
    }
    this.stale ||= to > from;
  }

  // ---- drawing, in px of the drawing -------------------------------------------------

  draw(context, ratio) {
    const { nCols, nRows, cellPx } = this.model;
    if (this.stale) this.context.putImageData(this.image, 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(this.canvas, 0, 0, nCols * cellPx, nRows * cellPx);
    if (this.errors) this.drawHatch(context, ratio);
    this.stale = false;
  }

  drawHatch(context, ratio) {
    const { width, height } = context.canvas;
    const same = this.hatch?.width === width && this.hatch.height === height;
    if (!same) this.hatch = offscreen(width, height);
    if (!same || this.stale) this.renewHatch(context.getTransform(), ratio);
    context.save();
    context.resetTransform();
    context.drawImage(this.hatch, 0, 0);
    context.restore();
  }

  // A pattern, kept only where the mask of unseen cells is opaque.
  renewHatch(transform, ratio) {
    const { nCols, nRows, cellPx, counts } = this.model;
    const maskContext = this.mask.getContext("2d");
    const mask = maskContext.createImageData(nCols, nRows);
    const alpha = new Uint32Array(mask.data.buffer);
    for (let c = 0; c < alpha.length; c++) alpha[c] = counts[c] ? 0 : 255 << 24;
    maskContext.putImageData(mask, 0, 0);
    const { width, height } = this.hatch;
    const context = this.hatch.getContext("2d");
    context.resetTransform();
    context.globalCompositeOperation = "source-over";
    context.clearRect(0, 0, width, height);
    context.imageSmoothingEnabled = false;
    context.setTransform(transform);
    context.drawImage(this.mask, 0, 0, nCols * cellPx, nRows * cellPx);
    context.resetTransform();
    context.globalCompositeOperation = "source-in";
    context.fillStyle = this.hatchPattern(context, ratio);
    context.fillRect(0, 0, width, height);
  }

  hatchPattern(context, ratio) {
    const side = Math.round(HATCH_GAP * ratio);
    const tile = offscreen(side, side);
    const pen = tile.getContext("2d");
    pen.strokeStyle = this.colours.unseenHatch;
    pen.lineWidth = ratio * 0.8;
    pen.beginPath();
    for (const shift of [-side, 0, side]) {
      pen.moveTo(shift, side);
      pen.lineTo(shift + side, 0);
    }
    pen.stroke();
    return context.createPattern(tile, "repeat");
  }
}
