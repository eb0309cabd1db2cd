// The charts below the map: scores over the readings. Each is drawn once for a set of
// maps; a step of the replay shows more of it and moves the marks.

const CURVE_ROOM = { left: 4, right: 36, top: 6, bottom: 6 }; // px
// The words beside a curve are larger on a projector.
const curveRoom = ({ large }) => ({ ...CURVE_ROOM, right: CURVE_ROOM.right * large });
const DASHES = [[], [5, 3], [2, 2]];
const BLANK_LINE = { dash: [], width: 1 };

const UNITS = {
  share: { text: percent, most: () => 1, tick: (v) => `${Math.round(100 * v)} %` },
  bits: { text: (v) => inBits(v), most: (m) => Math.max(1, m), tick: (v) => fixed(v, 1) },
  cells: { text: grouped, most: (m) => Math.max(1, m), tick: (v) => grouped(Math.round(v)) },
};

function buildTiles(p) {
  p.root.querySelectorAll(".tile").forEach((tile) => tile.remove());
  p.tiles = p.header.texts[isSeveral(p) ? "curves" : "scores"].map((spec) => newTile(p, spec));
  for (const { tile } of p.tiles) partOf(p.root, "tiles").append(tile);
}

function newTile(p, { name, label, about, unit, region, meaning }) {
  const values = element("span", { class: "values" });
  const naming = { role: "img", "aria-label": `${label} over the readings` };
  const canvas = element("canvas", naming);
  const tile = element("div", { class: "tile", "data-score": name });
  tile.append(element("div", { class: "tile-head" }, element("b", { title: meaning }, label), values), canvas);
  const small = element("small", {}, about);
  tile.append(small);
  scrubOn(p, canvas);
  return { name, region, about, small, unit: UNITS[unit], tile, values, canvas, picture: null };
}

function scrubOn(p, canvas) {
  const go = (event) => goTo(p, stepAtCurve(p, canvas, event));
  canvas.addEventListener("pointerdown", (event) => {
    pause(p);
    canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) go(event);
  });
  canvas.addEventListener("pointerup", () => commit(p));
}

function stepAtCurve({ scene, theme }, canvas, event) {
  const box = canvas.getBoundingClientRect();
  const { left, right } = curveRoom(theme);
  const share = (event.clientX - box.left - left) / (box.width - left - right);
  return Math.round(clamp(share, 0, 1) * scene.nReadings);
}

// ---- lines -------------------------------------------------------------------------------

const scoreOf = (series, region, name) => (region === "all" ? series.all : series[region])[name];

// What a chart shows; cells of several sizes cannot be compared by their number.
function aboutWords({ about, unit }, columns) {
  const isOneSize = columns.every(({ log }) => log.cellPx === columns[0].log.cellPx);
  return unit === UNITS.cells && !isOneSize ? `${about}, each of its map's size` : about;
}

// The blank map rests on the readings and cells of the first map that has log-odds.
const blankColumn = (columns) => Math.max(0, columns.findIndex(({ log }) => !log.coded));

const blankLabel = (columns) =>
  columns.every(({ log }) => log === columns[0].log) ? "blank" : `blank as ${LETTERS[blankColumn(columns)]}`;

// Of one map both regions, of several the chart's region; the blank map always.
function linesOf(p, { name, region }) {
  const { colours } = p.header;
  const blank = { ...BLANK_LINE, colour: colours.blank, label: blankLabel(p.columns) };
  const blankOf = (where) => scoreOf(p.columns[blankColumn(p.columns)].blank, where, name);
  if (!isSeveral(p)) {
    const [column] = p.columns;
    const line = { colour: p.theme.ink, width: 1.75 };
    return [
      { ...blank, values: blankOf("looked") },
      { ...line, dash: DASHES[1], values: column.series.unseen[name] },
      { ...line, dash: DASHES[0], values: column.series.looked[name] },
    ];
  }
  const maps = p.columns.map(({ series }, i) => ({
    label: LETTERS[i],
    values: scoreOf(series, region, name),
    colour: colours.columns[i],
    dash: DASHES[i],
    width: 1.75,
  }));
  return [{ ...blank, values: blankOf(region) }, ...maps.reverse()];
}

function showCurves(p) {
  for (const tile of p.tiles) {
    tile.lines ??= linesOf(p, tile);
    setText(tile.small, aboutWords(tile, p.columns));
    if (isSeveral(p)) showValues(tile, p.state.step);
    drawTile(tile, p.state.step, p.theme);
  }
}

function showValues({ lines, values, unit }, step) {
  const texts = lines.map((line) => `${line.label} ${unit.text(line.values[step])}`).reverse();
  if (values.children.length !== lines.length) {
    const parts = lines.map(({ colour }) => element("span", { style: `--mark: ${colour}` }));
    values.replaceChildren(...parts.reverse());
  }
  texts.forEach((text, i) => setText(values.children[i], text));
}

// After a change of a map, the theme or the size, all lines are drawn again.
function forgetCurves(p) {
  for (const tile of p.tiles ?? []) Object.assign(tile, { lines: null, picture: null });
}

function drawTile(tile, step, theme) {
  const { context, width, height } = fitted(tile.canvas);
  if (width === 0) return;
  const axes = axesOf(tile, curveRoom(theme), width, height);
  if (tile.picture?.width !== tile.canvas.width) tile.picture = pictureOfLines(tile, axes);
  drawLevels(context, axes, theme);
  const at = axes.x(step);
  // Faint after the step.
  context.globalAlpha = 0.3;
  context.drawImage(tile.picture, 0, 0, width, height);
  context.globalAlpha = 1;
  context.save();
  context.beginPath();
  context.rect(0, 0, at, height);
  context.clip();
  context.drawImage(tile.picture, 0, 0, width, height);
  context.restore();
  traceLine(context, at, 1, at, height - 1);
  strokeLine(context, theme.accent, 1);
  for (const { values, colour } of tile.lines) drawMark(context, axes, step, values[step], colour);
}

function axesOf({ lines, unit }, { left, right, top, bottom }, width, height) {
  const last = Math.max(1, lines[0].values.length - 1);
  // 0 to 100 % whatever the values; what has no upper end, up to its highest value.
  const highest = lines.map(({ values }) => values.reduce((m, v) => (v > m ? v : m), 0));
  const most = unit.most(Math.max(...highest));
  const x = (s) => left + (s / last) * (width - left - right);
  const y = (v) => height - bottom - (v / most) * (height - top - bottom);
  return { x, y, most, last, x0: left, x1: width - right, tick: unit.tick };
}

function pictureOfLines({ canvas, lines }, axes) {
  const picture = offscreen(canvas.width, canvas.height);
  const context = picture.getContext("2d");
  context.scale(pixelRatio(), pixelRatio());
  context.lineJoin = "round";
  for (const { values, colour, width, dash } of lines) {
    context.setLineDash(dash);
    traceCurve(context, values, axes);
    strokeLine(context, colour, width);
  }
  return picture;
}

function drawMark(context, { x, y }, step, value, colour) {
  if (Number.isNaN(value)) return;
  context.fillStyle = colour;
  context.beginPath();
  context.arc(x(step), y(value), 3, 0, TWO_PI);
  context.fill();
}

function drawLevels(context, { y, x0, x1, most, tick }, theme) {
  context.font = `${10 * theme.large}px ${theme.font}`;
  context.fillStyle = theme.muted;
  context.textBaseline = "middle";
  for (const share of [0, 0.5, 1]) {
    const at = Math.round(y(share * most)) + 0.5;
    traceLine(context, x0, at, x1, at);
    strokeLine(context, theme.line, 1);
    if (share !== 0.5) context.fillText(tick(share * most), x1 + 5, y(share * most));
  }
}

// Undefined scores leave a gap.
function traceCurve(context, values, { x, y, last }) {
  context.beginPath();
  let isOpen = false;
  for (let s = 0; s <= last; s++) {
    const isDefined = !Number.isNaN(values[s]);
    if (isDefined) context[isOpen ? "lineTo" : "moveTo"](x(s), y(values[s]));
    isOpen = isDefined;
  }
}

function traceLine(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
}

function strokeLine(context, colour, width, alpha = 1) {
  context.globalAlpha = alpha;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
  context.globalAlpha = 1;
}
