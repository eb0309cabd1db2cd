// The log-odds of one cell as a ladder: the prior, then the terms of each reading from the
// old total to the new. Where the rule subtracts the prior, a reading has two terms. Over
// several laps a reading is one bar of as many equal parts.

const TERMS_ROOM = { left: 34, right: 8, top: 6, bottom: 17 };
const SLOT_MAX = 36;
const PART_MIN = 3; // px: lower parts would be all lines

function ladderOf({ prior, terms }, step) {
  const bars = [{ label: "prior", from: 0, to: prior, isDone: true, term: null }];
  for (const term of terms) {
    const { from, middle } = spanOf(bars[bars.length - 1].to, term);
    const shared = { term, isDone: term.reading < step };
    bars.push({ ...shared, label: readingLabel(term), from, to: middle });
    if (term.off) bars.push({ ...shared, label: "", isOff: true, from: middle, to: term.total });
  }
  return bars;
}

const readingLabel = ({ reading, laps }) => `${reading + 1}${laps > 1 ? ` \u00d7${laps}` : ""}`;

// With one term a reading ends at its total, which is exact.
function spanOf(from, { said, off, total }) {
  return { from, middle: off ? from + said : total };
}

// Draws a ladder; returns where its bars are, for the pointer.
function drawLadder(p, canvas, bars) {
  const { context, width, height } = fitted(canvas);
  const { left, right, top, bottom } = TERMS_ROOM;
  const slot = Math.min(SLOT_MAX, (width - left - right) / bars.length);
  const ladder = { canvas, bars, slot };
  if (width === 0) return ladder;
  const ends = bars.flatMap((bar) => [bar.from, bar.to]);
  const [low, high] = p.termRange ?? [Math.min(-1, ...ends), Math.max(1, ...ends)];
  const y = (v) => top + ((high - v) / (high - low)) * (height - top - bottom);
  context.font = `${10.5 * p.theme.large}px ${p.theme.font}`;
  drawTicks(context, y, { low, high, x0: left, x1: width - right }, p.theme);
  drawBars(context, y, ladder, p.theme, p.header.colours);
  drawLabels(context, height, ladder, p.theme);
  // The line between what the map holds at this step and what is still to come.
  const x = barX(slot, bars.filter((bar) => bar.isDone).length - 0.5);
  context.setLineDash([3, 2]);
  traceLine(context, x, 2, x, height - bottom);
  strokeLine(context, p.theme.accent, 1);
  context.setLineDash([]);
  return ladder;
}

const barX = (slot, i) => TERMS_ROOM.left + (i + 0.5) * slot;

function barAt({ canvas, bars, slot }, event) {
  const x = event.clientX - canvas.getBoundingClientRect().left;
  return bars[Math.floor((x - TERMS_ROOM.left) / slot)] ?? null;
}

function drawTicks(context, y, { low, high, x0, x1 }, theme) {
  const tick = tickStep(high - low, 4);
  const digits = tick < 1 ? 1 : 0;
  context.textAlign = "right";
  context.textBaseline = "middle";
  context.fillStyle = theme.muted;
  for (let i = Math.ceil(low / tick); i * tick <= high + 1e-9; i++) {
    const at = Math.round(y(i * tick)) + 0.5;
    traceLine(context, x0, at, x1, at);
    strokeLine(context, i === 0 ? theme.muted : theme.line, 1);
    context.fillText(i === 0 ? "0" : signed(i * tick, digits), x0 - 6, y(i * tick));
  }
}

// The smallest of 1, 2, 5, 10, 20, ... that makes at most so many steps.
function tickStep(span, most) {
  const rough = span / most;
  const unit = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * unit).find((step) => step >= rough);
}

// What is subtracted is an outline: it says nothing of what the robot saw.
function drawBars(context, y, { bars, slot }, theme, colours) {
  const thick = Math.max(1, slot * 0.72);
  bars.forEach((bar, i) => {
    const x = barX(slot, i) - thick / 2;
    const [from, to] = [y(bar.from), y(bar.to)];
    const box = [x, Math.min(from, to), thick, Math.max(1, Math.abs(to - from))];
    const alpha = bar.isDone ? 1 : 0.28;
    const colour = bar.to < bar.from ? colours.evidenceWall : colours.evidenceFree;
    context.globalAlpha = alpha * (bar.isOff ? 0.3 : 1);
    context.fillStyle = colour;
    context.fillRect(...box);
    if (bar.isOff) outline(context, box, colour, alpha);
    divide(context, box, bar.term?.laps ?? 1, theme);
    traceLine(context, x, to, x + (i + 1 < bars.length ? slot : thick), to);
    strokeLine(context, theme.ink, 1.5, alpha);
  });
}

// Between the laps of a reading.
function divide(context, [x, top, width, height], laps, theme) {
  if (height < PART_MIN * laps) return;
  for (let lap = 1; lap < laps; lap++) {
    const at = top + (lap / laps) * height;
    traceLine(context, x, at, x + width, at);
    strokeLine(context, theme.paper, 1);
  }
}

function outline(context, [x, top, width, height], colour, alpha) {
  context.beginPath();
  context.rect(x + 0.75, top + 0.75, Math.max(0, width - 1.5), Math.max(0, height - 1.5));
  context.setLineDash([3, 2]);
  strokeLine(context, colour, 1.5, alpha);
  context.setLineDash([]);
}

// Reading numbers, as many as fit without touching.
function drawLabels(context, height, { bars, slot }, theme) {
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillStyle = theme.muted;
  let free = -Infinity;
  bars.forEach((bar, i) => {
    const half = context.measureText(bar.label).width / 2;
    if (!bar.label || barX(slot, i) - half < free) return;
    const x = Math.max(half, barX(slot, i));
    context.fillText(bar.label, x, height - 2);
    free = x + half + 6;
  });
}
