// The score curves and the waterfall of one cell's log-odds.

function line(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

const CURVE_ROOM = { left: 4, right: 32, top: 6, bottom: 6 };

// A score over all readings, 0 to 100 % whatever the values; faint after the step.
function drawCurve(canvas, values, step, ink) {
  const { context, width, height } = fitted(canvas);
  if (width === 0) return;
  const last = Math.max(1, values.length - 1);
  const { left, right, top, bottom } = CURVE_ROOM;
  const x = (s) => left + (s / last) * (width - left - right);
  const y = (v) => height - bottom - v * (height - top - bottom);
  context.strokeStyle = ink.line;
  context.lineWidth = 1;
  context.font = `10px ${ink.font}`;
  context.fillStyle = ink.muted;
  context.textBaseline = "middle";
  for (const level of [0, 0.5, 1]) {
    line(
      context,
      left,
      Math.round(y(level)) + 0.5,
      width - right,
      Math.round(y(level)) + 0.5,
    );
    if (level !== 0.5)
      context.fillText(`${100 * level} %`, width - right + 5, y(level));
  }
  context.lineJoin = "round";
  context.strokeStyle = ink.ink;
  context.lineWidth = 1.25;
  context.globalAlpha = 0.3;
  traceCurve(context, values, step, last, x, y);
  context.globalAlpha = 1;
  context.lineWidth = 1.75;
  traceCurve(context, values, 0, step, x, y);
  context.strokeStyle = ink.accent;
  context.lineWidth = 1;
  line(context, x(step), 1, x(step), height - 1);
  if (Number.isNaN(values[step])) return;
  context.fillStyle = ink.accent;
  context.beginPath();
  context.arc(x(step), y(values[step]), 3, 0, TWO_PI);
  context.fill();
}

// Undefined scores leave a gap.
function traceCurve(context, values, from, to, x, y) {
  context.beginPath();
  let open = false;
  for (let s = from; s <= to; s++) {
    if (Number.isNaN(values[s])) {
      open = false;
      continue;
    }
    if (open) context.lineTo(x(s), y(values[s]));
    else context.moveTo(x(s), y(values[s]));
    open = true;
  }
  context.stroke();
}

function stepAtCurve(canvas, event, last) {
  const box = canvas.getBoundingClientRect();
  const { left, right } = CURVE_ROOM;
  const share = (event.clientX - box.left - left) / (box.width - left - right);
  return Math.round(Math.min(1, Math.max(0, share)) * last);
}

// ---- one cell ----------------------------------------------------------------------

const TERMS_ROOM = { left: 34, right: 8, top: 6, bottom: 17 };
const SLOT_MAX = 36;

function niceStep(span, wanted) {
  const rough = span / wanted;
  const unit = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * unit).find((s) => s >= rough);
}

// Bars of the waterfall: the prior, then each reading from the old total to the new.
function waterfall(history, step) {
  const bars = [{ label: "prior", from: 0, to: history.prior, done: true, term: null }];
  let total = history.prior;
  for (const term of history.terms) {
    bars.push({
      label: String(term.reading + 1),
      from: total,
      to: term.total,
      done: term.reading < step,
      term,
    });
    total = term.total;
  }
  return bars;
}

class TermsChart {
  constructor(canvas) {
    this.canvas = canvas;
    this.bars = [];
  }

  draw(history, step, ink) {
    this.bars = waterfall(history, step);
    const { context, width, height } = fitted(this.canvas);
    if (width === 0) return;
    const { left, right, top, bottom } = TERMS_ROOM;
    this.slot = Math.min(SLOT_MAX, (width - left - right) / this.bars.length);
    const ends = this.bars.flatMap((bar) => [bar.from, bar.to]);
    const low = Math.min(-1, ...ends);
    const high = Math.max(1, ...ends);
    const y = (v) => top + ((high - v) / (high - low)) * (height - top - bottom);
    context.font = `10.5px ${ink.font}`;
    this.drawAxis(context, width, low, high, y, ink);
    this.drawBars(context, y, ink);
    this.drawLabels(context, height, ink);
    this.drawStep(context, height, ink);
  }

  drawAxis(context, width, low, high, y, ink) {
    const { left, right } = TERMS_ROOM;
    const tick = niceStep(high - low, 4);
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.lineWidth = 1;
    for (let v = Math.ceil(low / tick) * tick; v <= high + 1e-9; v += tick) {
      const zero = Math.abs(v) < 1e-9;
      context.strokeStyle = zero ? ink.muted : ink.line;
      line(
        context,
        left,
        Math.round(y(v)) + 0.5,
        width - right,
        Math.round(y(v)) + 0.5,
      );
      context.fillStyle = ink.muted;
      const text = zero ? "0" : (v > 0 ? "+" : "\u2212") + formatTick(Math.abs(v));
      context.fillText(text, left - 6, y(v));
    }
  }

  drawBars(context, y, ink) {
    const thick = Math.max(1, this.slot * 0.72);
    this.bars.forEach((bar, i) => {
      const x = this.x(i) - thick / 2;
      const [a, b] = [y(bar.from), y(bar.to)];
      context.globalAlpha = bar.done ? 1 : 0.28;
      context.fillStyle = bar.to < bar.from ? ink.wall : ink.free;
      context.fillRect(x, Math.min(a, b), thick, Math.max(1, Math.abs(b - a)));
      context.strokeStyle = ink.ink;
      context.lineWidth = 1.5;
      line(context, x, b, i + 1 < this.bars.length ? x + this.slot : x + thick, b);
    });
    context.globalAlpha = 1;
  }

  // Reading numbers, as many as fit without touching.
  drawLabels(context, height, ink) {
    context.textAlign = "center";
    context.textBaseline = "bottom";
    let free = -Infinity;
    this.bars.forEach((bar, i) => {
      const half = context.measureText(bar.label).width / 2;
      if (this.x(i) - half < free) return;
      context.fillStyle = ink.muted;
      const x = Math.max(half, this.x(i));
      context.fillText(bar.label, x, height - 2);
      free = x + half + 6;
    });
  }

  // The line between what the map holds at this step and what is still to come.
  drawStep(context, height, ink) {
    const done = this.bars.filter((bar) => bar.done).length;
    const x = this.x(done - 0.5);
    context.strokeStyle = ink.accent;
    context.lineWidth = 1;
    context.setLineDash([3, 2]);
    line(context, x, 2, x, height - TERMS_ROOM.bottom);
    context.setLineDash([]);
  }

  x(i) {
    return TERMS_ROOM.left + (i + 0.5) * this.slot;
  }

  barAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const i = Math.floor((event.clientX - box.left - TERMS_ROOM.left) / this.slot);
    return this.bars[i] ?? null;
  }
}

function formatTick(value) {
  return value >= 1 || value === 0
    ? String(Math.round(value * 10) / 10)
    : value.toFixed(1);
}
