// The tiles below the map: each score over the readings, as a number and as a curve.

const CURVE_ROOM = { left: 4, right: 32, top: 6, bottom: 6 };

function buildTiles(p, scores) {
  p.tiles = scores.map(({ name, label, about }) => {
    const value = element("span", { class: "value" });
    const naming = { role: "img", "aria-label": `${label} over the readings` };
    const canvas = element("canvas", naming);
    const head = element("div", { class: "tile-head" }, element("b", {}, label), value);
    const tile = element("div", { class: "tile", "data-score": name }, head, canvas);
    tile.append(element("small", {}, about));
    partOf(p.root, "scores").append(tile);
    scrubOn(p, canvas);
    return { name, label, value, canvas };
  });
}

function scrubOn(p, canvas) {
  const go = (event) => goTo(p, stepAtCurve(canvas, event, p.model.nReadings));
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

function stepAtCurve(canvas, event, last) {
  const box = canvas.getBoundingClientRect();
  const { left, right } = CURVE_ROOM;
  const share = (event.clientX - box.left - left) / (box.width - left - right);
  return Math.round(clamp(share, 0, 1) * last);
}

function showScores(p) {
  for (const { name, value, canvas } of p.tiles) {
    value.textContent = percent(p.series[name][p.state.step]);
    drawCurve(canvas, p.series[name], p.state.step, p.theme);
  }
}

// 0 to 100 % whatever the values; faint after the step.
function drawCurve(canvas, values, step, theme) {
  const { context, width, height } = fitted(canvas);
  if (width === 0) return;
  const last = Math.max(1, values.length - 1);
  const { left, right, top, bottom } = CURVE_ROOM;
  const x = (s) => left + (s / last) * (width - left - right);
  const y = (v) => height - bottom - v * (height - top - bottom);
  drawLevels(context, y, [left, width - right], theme);
  context.lineJoin = "round";
  traceCurve(context, values, step, last, x, y);
  strokeLine(context, theme.ink, 1.25, 0.3);
  traceCurve(context, values, 0, step, x, y);
  strokeLine(context, theme.ink, 1.75);
  traceLine(context, x(step), 1, x(step), height - 1);
  strokeLine(context, theme.accent, 1);
  if (Number.isNaN(values[step])) return;
  context.fillStyle = theme.accent;
  context.beginPath();
  context.arc(x(step), y(values[step]), 3, 0, TWO_PI);
  context.fill();
}

function drawLevels(context, y, [x0, x1], theme) {
  context.font = `10px ${theme.font}`;
  context.fillStyle = theme.muted;
  context.textBaseline = "middle";
  for (const level of [0, 0.5, 1]) {
    const at = Math.round(y(level)) + 0.5;
    traceLine(context, x0, at, x1, at);
    strokeLine(context, theme.line, 1);
    if (level !== 0.5) context.fillText(`${100 * level} %`, x1 + 5, y(level));
  }
}

// Undefined scores leave a gap.
function traceCurve(context, values, from, to, x, y) {
  context.beginPath();
  let isOpen = false;
  for (let s = from; s <= to; s++) {
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
