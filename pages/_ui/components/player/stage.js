// The stage: its panes, their sizes, and the way between px of the drawing and of the
// screen. One map stands beside the drawing; several stand beside their difference; those
// of a compact replay stand by themselves.

const PANE_GAP = 16;
const CAPTION_HEIGHT = 22;
const COLUMN_GAP = 32;
const SIDE_MIN = 240; // width of the controls beside the stage, px
const SIDE_MAX = 380;
const LETTERS = "ABC";
const IMAGES = {
  drawing: "Drawing with the path, the robot and its field of view",
  difference: "Where the maps judge a cell differently, coloured by which of them is right",
};

const isSeveral = (p) => p.state.columns.length > 1;

// ---- panes -------------------------------------------------------------------------------

// Builds the panes again where the number of maps has changed.
function buildStage(p) {
  const n = p.state.columns.length;
  if (p.views?.filter(({ kind }) => kind === "map").length === n) return;
  const maps = p.state.columns.map((_, i) => newView(p, "map", i));
  p.views = viewsBeside(p, maps);
  p.root.classList.toggle("several", isSeveral(p));
  p.root.style.setProperty("--panes", p.views.length);
  p.root.querySelector(".stage").replaceChildren(...p.views.map(({ pane }) => pane));
  if (p.state.compact) buildTallies(p);
  else buildFeet(p);
}

function viewsBeside(p, maps) {
  if (p.state.compact) return maps;
  return isSeveral(p) ? [...maps, newView(p, "difference", 0)] : [newView(p, "drawing", 0), ...maps];
}

function newView(p, kind, column) {
  const pane = element("figure", { class: "pane", "data-pane": kind, "data-column": column });
  const canvas = element("canvas", canvasNames(p, kind, column));
  pane.append(element("figcaption", {}, ...captionOf(p, kind, column)), canvas);
  const view = { kind, column, pane, canvas };
  listenToView(p, view);
  return view;
}

function canvasNames(p, kind, column) {
  if (kind !== "map") return { role: "img", "aria-label": IMAGES[kind] };
  if (p.state.compact) return { role: "img", "aria-label": `Map: ${storyName(p, column)}` };
  const name = isSeveral(p) ? `Map ${LETTERS[column]}` : "Occupancy grid map";
  const keys =
    "Hover on a cell, or move with the arrow keys, for its numbers; click or press Enter to pin it.";
  return { tabindex: 0, role: "application", "aria-label": `${name}. ${keys}` };
}

function captionOf(p, kind, column) {
  const { hasTruth, paper } = p.header;
  const difference = hasTruth ? "Who is right" : "Where they differ";
  if (kind === "difference") return [element("span", { class: "name" }, difference), p.differenceKeys];
  if (p.state.compact) return [element("span", { class: "name" }, storyName(p, column))];
  if (kind === "map" && isSeveral(p)) return [newHeader(p, column)];
  const name = element("span", { class: "name" }, kind === "map" ? "Map" : paper);
  return [name, kind === "map" ? p.legend : element("span", { class: "legend" }, ...drawingKeys(p))];
}

const drawingKeys = ({ beams }) => [
  legendKey("path", "path"),
  legendKey("robot", "robot"),
  beams ? legendKey("beam", "beams") : legendKey("cone", "field of view"),
];

const legendKey = (mark, label) =>
  element("span", { class: "key" }, element("i", { class: `mark-${mark}` }), label);

// ---- sizes -------------------------------------------------------------------------------

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

// All maps at one scale: in a row, two by two, or on a telephone one below the other.
function arrangeSeveral(box, { widthPx, heightPx }, arrangement, nPanes) {
  const perRow = { wide: nPanes, medium: 2, narrow: 1 }[arrangement];
  const width = (box.width - (perRow - 1) * PANE_GAP) / perRow;
  return { scale: Math.min(width / widthPx, box.height / heightPx), stacked: perRow === 1 };
}

// Sizes of the canvases from the room that the page gives.
function layOut(p) {
  const { root, scene, views } = p;
  const arrangement = getComputedStyle(root).getPropertyValue("--arrangement").trim();
  const hasSide = arrangement === "wide" && !isSeveral(p) && p.header.hasPrior;
  const beside = hasSide ? SIDE_MIN + COLUMN_GAP : 0;
  const width = root.clientWidth - beside;
  const box = { width, height: root.querySelector(".measure").clientHeight };
  const { scale, stacked } = isSeveral(p)
    ? arrangeSeveral(box, scene, arrangement, views.length)
    : arrange(box, scene, arrangement);
  p.scale = Math.max(0, scale); // nothing fits while the page is hidden
  root.querySelector(".stage").dataset.stacked = stacked ? "1" : "0";
  const picture = scene.widthPx * p.scale;
  giveRestToControls(root, width - (stacked ? picture : 2 * picture + PANE_GAP));
  for (const { canvas } of views) {
    canvas.style.width = `${picture}px`;
    canvas.style.height = `${scene.heightPx * p.scale}px`;
    canvas.width = Math.round(picture * pixelRatio());
    canvas.height = Math.round(scene.heightPx * p.scale * pixelRatio());
  }
  p.paper = isSeveral(p) ? null : scaledPreview(p);
}

// Width that the pictures cannot use goes to the sliders.
function giveRestToControls(root, rest) {
  const side = clamp(SIDE_MIN + rest, SIDE_MIN, SIDE_MAX);
  root.style.setProperty("--side", `${Math.floor(side)}px`);
}

// Reduced once: a good filter on every frame would take longer than all other drawing.
function scaledPreview({ views, scene, header }) {
  const { width, height } = views[0].canvas;
  const paper = offscreen(width, height);
  const context = paper.getContext("2d");
  context.fillStyle = header.colours.paper;
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = "high";
  if (scene.picture) context.drawImage(scene.picture, 0, 0, width, height);
  return paper;
}

// ---- places: cells of a grid, points of the drawing, points of the screen ----------------

// The grid that a view shows.
const gridUnder = (p, { kind, column }) =>
  kind === "difference" ? p.comparison : p.columns[column].log;

// The flat cell that holds a point of the drawing, or null outside it.
function cellHolding({ cellPx, nCols, widthPx, heightPx }, x, y) {
  if (!(x >= 0 && y >= 0 && x < widthPx && y < heightPx)) return null;
  return Math.floor(y / cellPx) * nCols + Math.floor(x / cellPx);
}

// The flat cell under a pointer event on a view's canvas, or null.
function cellAt(p, view, event) {
  const box = view.canvas.getBoundingClientRect();
  const scale = p.scene.widthPx / box.width;
  const point = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  return cellHolding(gridUnder(p, view), ...point);
}

const placeOf = ({ nCols }, c) => [Math.floor(c / nCols), c % nCols];

// The part of a cell that lies in the drawing: the last row and column may be cut.
function boxOf(grid, c) {
  const { cellPx, widthPx, heightPx } = grid;
  const [y, x] = placeOf(grid, c).map((i) => i * cellPx);
  return { x, y, width: Math.min(cellPx, widthPx - x), height: Math.min(cellPx, heightPx - y) };
}

function centreOf(grid, c) {
  const { x, y, width, height } = boxOf(grid, c);
  return [x + width / 2, y + height / 2];
}

// Where a point of the drawing is on a view's canvas, as a pointer event would say it.
function screenPoint(p, { canvas }, [x, y]) {
  const box = canvas.getBoundingClientRect();
  return { clientX: box.left + x * p.scale, clientY: box.top + y * p.scale };
}
