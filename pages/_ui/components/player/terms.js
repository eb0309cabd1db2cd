// The log-odds of one cell as a waterfall: the prior, then each reading from the old
// total to the new.

const TERMS_ROOM = { left: 34, right: 8, top: 6, bottom: 17 };
const SLOT_MAX = 36;

function waterfall({ prior, terms }, step) {
  const bars = [{ label: "prior", from: 0, to: prior, isDone: true, term: null }];
  for (const term of terms) {
    const from = bars[bars.length - 1].to;
    const label = String(term.reading + 1);
    bars.push({ label, from, to: term.total, isDone: term.reading < step, term });
  }
  return bars;
}

function showTerms(p) {
  const canvas = partOf(p.root, "terms");
  const bars = waterfall(historyOf(p.model, p.pin), p.state.step);
  const { context, width, height } = fitted(canvas);
  const { left, right, top, bottom } = TERMS_ROOM;
  const slot = Math.min(SLOT_MAX, (width - left - right) / bars.length);
  p.terms = { canvas, bars, slot };
  if (width === 0) return;
  const ends = bars.flatMap((bar) => [bar.from, bar.to]);
  const [low, high] = [Math.min(-1, ...ends), Math.max(1, ...ends)];
  const y = (v) => top + ((high - v) / (high - low)) * (height - top - bottom);
  context.font = `10.5px ${p.theme.font}`;
  drawTicks(context, y, { low, high, x0: left, x1: width - right }, p.theme);
  drawBars(context, y, p.terms, p.theme, p.header.colours);
  drawLabels(context, height, p.terms, p.theme);
  // The line between what the map holds at this step and what is still to come.
  const x = barX(slot, bars.filter((bar) => bar.isDone).length - 0.5);
  context.setLineDash([3, 2]);
  traceLine(context, x, 2, x, height - bottom);
  strokeLine(context, p.theme.accent, 1);
  context.setLineDash([]);
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

function drawBars(context, y, { bars, slot }, theme, colours) {
  const thick = Math.max(1, slot * 0.72);
  bars.forEach((bar, i) => {
    const x = barX(slot, i) - thick / 2;
    const [from, to] = [y(bar.from), y(bar.to)];
    const alpha = bar.isDone ? 1 : 0.28;
    context.globalAlpha = alpha;
    context.fillStyle = bar.to < bar.from ? colours.evidenceWall : colours.evidenceFree;
    context.fillRect(x, Math.min(from, to), thick, Math.max(1, Math.abs(to - from)));
    traceLine(context, x, to, x + (i + 1 < bars.length ? slot : thick), to);
    strokeLine(context, theme.ink, 1.5, alpha);
  });
}

// Reading numbers, as many as fit without touching.
function drawLabels(context, height, { bars, slot }, theme) {
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillStyle = theme.muted;
  let free = -Infinity;
  bars.forEach((bar, i) => {
    const half = context.measureText(bar.label).width / 2;
    if (barX(slot, i) - half < free) return;
    const x = Math.max(half, barX(slot, i));
    context.fillText(bar.label, x, height - 2);
    free = x + half + 6;
  });
}
