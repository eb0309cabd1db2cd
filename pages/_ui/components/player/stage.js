// The two canvases: the drawing with path, robot and cone, and the map beside it at the
// same scale. Works in px of the drawing; one factor leads to the screen.

const TWO_PI = 2 * Math.PI;
const ROBOT_RADIUS = 5; // on the screen, px
const PANE_GAP = 16;
const CAPTION_HEIGHT = 22;
const COLUMN_GAP = 32;
const SIDE_MIN = 240; // width of the controls beside the stage, px
const SIDE_MAX = 380;

// The picture, or null where the browser cannot read it.
function decodePreview(bytes) {
  return createImageBitmap(new Blob([bytes])).catch(() => null);
}

// Largest scale at which two pictures fit a box, side by side or one above the other.
function arrange(box, size) {
  const beside = Math.min(
    (box.width - PANE_GAP) / 2 / size.width,
    box.height / size.height,
  );
  const half = (box.height - PANE_GAP - CAPTION_HEIGHT) / 2;
  const above = Math.min(box.width / size.width, half / size.height);
  return above > beside
    ? { scale: above, stacked: true }
    : { scale: beside, stacked: false };
}

class Stage {
  constructor(root, colours) {
    const pane = (name) => root.querySelector(`[data-pane=${name}] canvas`);
    this.root = root;
    this.element = root.querySelector(".stage");
    this.canvases = { drawing: pane("drawing"), map: pane("map") };
    this.colours = colours;
    this.hover = null;
    this.pin = null;
  }

  show(model, preview) {
    this.model = model;
    this.hover = null;
    this.preview?.close();
    this.preview = preview;
    this.cells = new CellPicture(model, this.colours);
    this.layout();
  }

  // Sizes of the canvases from the room that the page gives.
  layout() {
    const arrangement = getComputedStyle(this.root)
      .getPropertyValue("--arrangement")
      .trim();
    const height = this.root.querySelector(".measure").clientHeight;
    const beside = arrangement === "wide" ? SIDE_MIN + COLUMN_GAP : 0;
    const width = this.root.clientWidth - beside;
    const { widthPx, heightPx } = this.model;
    const fit =
      arrangement === "narrow"
        ? { scale: Math.min(width / widthPx, height / heightPx), stacked: true }
        : arrange({ width, height }, { width: widthPx, height: heightPx });
    this.scale = Math.max(0, fit.scale); // nothing fits while the page is hidden
    this.ratio = Math.min(3, window.devicePixelRatio || 1);
    this.element.dataset.stacked = fit.stacked ? "1" : "0";
    this.giveRestToControls(width, fit);
    for (const canvas of Object.values(this.canvases)) {
      canvas.style.width = `${widthPx * this.scale}px`;
      canvas.style.height = `${heightPx * this.scale}px`;
      canvas.width = Math.round(widthPx * this.scale * this.ratio);
      canvas.height = Math.round(heightPx * this.scale * this.ratio);
    }
    this.scalePreview();
  }

  // Width that the pictures cannot use makes the sliders longer.
  giveRestToControls(width, { scale, stacked }) {
    const picture = this.model.widthPx * scale;
    const rest = width - (stacked ? picture : 2 * picture + PANE_GAP);
    const side = Math.min(SIDE_MAX, SIDE_MIN + Math.max(0, rest));
    this.root.style.setProperty("--side", `${Math.floor(side)}px`);
  }

  // Shrunk once: a good filter on every frame would cost more than all the rest.
  scalePreview() {
    const { width, height } = this.canvases.drawing;
    this.paper = offscreen(width, height);
    const context = this.paper.getContext("2d");
    context.fillStyle = this.colours.paper;
    context.fillRect(0, 0, width, height);
    context.imageSmoothingQuality = "high";
    if (this.preview) context.drawImage(this.preview, 0, 0, width, height);
  }

  // ---- drawing -------------------------------------------------------------------

  draw() {
    if (!this.model || this.scale === 0) return;
    this.drawDrawing();
    this.drawMap();
  }

  begin(canvas) {
    const context = canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    return context;
  }

  // From here on, units are px of the drawing.
  toDrawing(context) {
    const k = this.scale * this.ratio;
    context.setTransform(k, 0, 0, k, 0, 0);
  }

  drawDrawing() {
    const context = this.begin(this.canvases.drawing);
    context.drawImage(this.paper, 0, 0);
    this.toDrawing(context);
    this.drawPath(context);
    this.drawSensor(context, true);
    this.drawRobot(context);
    this.drawMarks(context);
  }

  drawMap() {
    const context = this.begin(this.canvases.map);
    this.toDrawing(context);
    this.cells.draw(context, this.ratio);
    this.drawSensor(context, false);
    this.drawRobot(context);
    this.drawMarks(context);
  }

  pose(index) {
    return this.model.poses.subarray(3 * index, 3 * index + 3);
  }

  // The pose of the reading just taken; before the first, the pose that waits.
  current() {
    return this.pose(Math.max(0, this.model.step - 1));
  }

  trace(context, from, to) {
    context.beginPath();
    for (let i = from; i < to; i++) {
      const [x, y] = this.pose(i);
      if (i === from) context.moveTo(x, y);
      else context.lineTo(x, y);
    }
    context.stroke();
  }

  drawPath(context) {
    const { model, scale, colours } = this;
    const here = Math.max(0, model.step - 1);
    context.lineJoin = "round";
    context.strokeStyle = colours.path;
    context.globalAlpha = 0.28;
    context.lineWidth = 1.2 / scale;
    this.trace(context, here, model.nReadings);
    context.globalAlpha = 0.8;
    context.lineWidth = 1.5 / scale;
    this.trace(context, 0, here + 1);
    context.globalAlpha = 1;
  }

  drawSensor(context, filled) {
    const { model, scale, colours } = this;
    const [x, y, theta] = this.current();
    const half = model.fovRad / 2;
    context.beginPath();
    if (model.fovRad < TWO_PI - 1e-6) context.moveTo(x, y);
    context.arc(x, y, model.rangePx, theta - half, theta + half);
    if (model.fovRad < TWO_PI - 1e-6) context.closePath();
    context.fillStyle = colours.sensor;
    context.globalAlpha = model.step === 0 ? 0.08 : 0.18;
    if (filled) context.fill();
    context.globalAlpha = 0.75;
    context.strokeStyle = colours.halo;
    context.lineWidth = 3 / scale;
    context.stroke();
    context.globalAlpha = 1;
    context.strokeStyle = colours.sensor;
    context.lineWidth = 1.5 / scale;
    context.setLineDash([4 / scale, 3 / scale]);
    context.stroke();
    context.setLineDash([]);
  }

  drawRobot(context) {
    const { scale, colours } = this;
    const [x, y, theta] = this.current();
    const radius = ROBOT_RADIUS / scale;
    context.beginPath();
    context.arc(x, y, radius, 0, TWO_PI);
    context.fillStyle = colours.robot;
    context.fill();
    context.strokeStyle = colours.halo;
    context.lineWidth = 1.5 / scale;
    context.stroke();
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + radius * Math.cos(theta), y + radius * Math.sin(theta));
    context.stroke();
  }

  drawMarks(context) {
    if (this.pin !== null) this.drawPin(context);
    if (this.hover !== null) this.drawCrosshair(context);
  }

  cellBox(c) {
    const { cellPx, nCols } = this.model;
    return { x: (c % nCols) * cellPx, y: Math.floor(c / nCols) * cellPx, side: cellPx };
  }

  drawPin(context) {
    const { scale, colours } = this;
    const { x, y, side } = this.cellBox(this.pin);
    const room = 2.5 / scale;
    const box = [x - room, y - room, side + 2 * room, side + 2 * room];
    context.strokeStyle = colours.halo;
    context.lineWidth = 4 / scale;
    context.strokeRect(...box);
    context.strokeStyle = colours.crosshair;
    context.lineWidth = 2 / scale;
    context.strokeRect(...box);
  }

  drawCrosshair(context) {
    const { model, scale, colours } = this;
    const { x, y, side } = this.cellBox(this.hover);
    const [midX, midY] = [x + side / 2, y + side / 2];
    context.strokeStyle = colours.crosshair;
    context.lineWidth = 1 / scale;
    context.globalAlpha = 0.55;
    context.beginPath();
    for (const [x0, y0, x1, y1] of [
      [0, midY, x, midY],
      [x + side, midY, model.widthPx, midY],
      [midX, 0, midX, y],
      [midX, y + side, midX, model.heightPx],
    ]) {
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
    }
    context.stroke();
    context.globalAlpha = 1;
    context.lineWidth = 1.5 / scale;
    context.strokeRect(x, y, side, side);
  }

  // The flat cell under a pointer event on one of the canvases, or null.
  cellAt(event) {
    const { model } = this;
    if (!model) return null;
    const box = event.target.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * model.widthPx;
    const y = ((event.clientY - box.top) / box.height) * model.heightPx;
    return x < model.widthPx && y < model.heightPx ? this.cellHolding(x, y) : null;
  }

  // The flat cell that holds a point of the drawing, or null.
  cellHolding(x, y) {
    const { cellPx, nCols, nRows } = this.model;
    const [row, col] = [Math.floor(y / cellPx), Math.floor(x / cellPx)];
    return row >= 0 && col >= 0 && row < nRows && col < nCols
      ? row * nCols + col
      : null;
  }

  // Centre of a cell, px of the drawing.
  centre(c) {
    const { x, y, side } = this.cellBox(c);
    return [x + side / 2, y + side / 2];
  }

  // Where a cell's centre is on the map canvas, as a pointer event would say it.
  pointAt(c) {
    const [x, y] = this.centre(c);
    const box = this.canvases.map.getBoundingClientRect();
    return { clientX: box.left + x * this.scale, clientY: box.top + y * this.scale };
  }

  dispose() {
    this.preview?.close();
    this.model = null;
  }
}
