// Readings add up: a number line of log-odds with p above it, and a bar for the prior and
// for each reading below it.

const SVG = "http://www.w3.org/2000/svg";
const LINE_ROOM = { side: 14, axis: 46, bars: 72, height: 188 };
const BAR_MAX = 20; // height of a bar with its gap, px
const P_TICKS = [0.5, 0.9, 0.1, 0.98, 0.02, 0.7, 0.3, 0.8, 0.2, 0.95, 0.05, 0.999, 0.001];
const TICK_GAP = 30; // px between labels of p

function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// The ends of the line: 4, or the next multiple of it that holds all bars.
function reachOf(bars) {
  const most = Math.max(...bars.map(({ to }) => Math.abs(to)));
  return 4 * Math.max(1, Math.ceil(most / 4));
}

function showLine(p) {
  const { root, state, constants } = p;
  const bars = ladderOf(state, constants);
  const box = partOf(root, "line");
  const width = box.clientWidth;
  const { side, height } = LINE_ROOM;
  const reach = reachOf(bars);
  const x = (l) => side + ((l + reach) / (2 * reach)) * (width - 2 * side);
  p.line = { reach, x, width };
  const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, role: "img" });
  picture.setAttribute("aria-label", `Number line of log-odds. ${sumWords(p)}`);
  picture.append(...axis(x, reach), ...totalMark(bars.at(-1).to, x, width), ...rungs(bars, x, state.prior));
  partOf(root, "picture").replaceChildren(picture);
  placePrior(p);
  showSum(p, bars);
  partOf(root, "undo").disabled = partOf(root, "turn").disabled = state.chips.length === 0;
  for (const name of ["read-empty", "read-object"]) {
    partOf(root, name).disabled = state.chips.length >= p.header.maxChips;
  }
}

function axis(x, reach) {
  const { axis: y } = LINE_ROOM;
  const parts = [svg("path", { class: "axis", d: `M${x(-reach)} ${y}H${x(reach)}` })];
  for (let l = -reach; l <= reach; l += reach / 4) {
    parts.push(svg("path", { class: "axis", d: `M${x(l)} ${y}v5` }));
    parts.push(svg("text", { x: x(l), y: y + 16 }, l === 0 ? "0" : signed(l, 0)));
  }
  const taken = [];
  for (const p of P_TICKS) {
    const at = x(logit(p));
    if (Math.abs(logit(p)) > reach || taken.some((other) => Math.abs(other - at) < TICK_GAP)) continue;
    taken.push(at);
    parts.push(svg("path", { class: "axis", d: `M${at} ${y}v-5` }));
    parts.push(svg("text", { x: at, y: y - 9 }, String(p)));
  }
  return parts;
}

// One row a reading; if the prior is taken off, the row holds two bars.
function rungs(bars, x, prior) {
  const rows = bars.at(-1).reading + 1;
  const pitch = Math.min(BAR_MAX, (LINE_ROOM.height - LINE_ROOM.bars - 4) / rows);
  const isTwo = bars.some(({ kind }) => kind === "less");
  const zero = { class: "guide", d: `M${x(0)} ${LINE_ROOM.axis + 20}V${LINE_ROOM.height}` };
  return [hatch(), svg("path", zero), ...bars.flatMap((bar) => rung(bar, x, { pitch, isTwo, prior }))];
}

function rung({ kind, from, to, reading }, x, { pitch, isTwo, prior }) {
  const full = pitch - Math.min(5, pitch / 4);
  const thick = isTwo && kind !== "prior" ? full / 2 : full;
  const y = LINE_ROOM.bars + reading * pitch + (kind === "less" ? thick : 0);
  const [left, right] = [Math.min(x(from), x(to)), Math.max(x(from), x(to))];
  const name = kind === "reading" ? (to < from ? "wall" : "free") : kind;
  const bar = { class: `bar ${name}`, x: left, y, width: Math.max(1.5, right - left), height: thick };
  const parts = [svg("rect", bar), svg("path", { class: "end", d: `M${x(to)} ${y}v${thick}` })];
  if (kind !== "less") {
    const label = kind === "prior" ? `prior ${prior.toFixed(2)}` : String(reading);
    // On the side of the bar away from where it ends.
    const isBehind = to < from;
    const place = { class: `rung ${isBehind ? "behind" : "before"}`, x: isBehind ? right + 6 : left - 6 };
    parts.push(svg("text", { ...place, y: y + full / 2 + 3.5 }, label));
  }
  return parts;
}

function hatch() {
  const size = { id: "less-hatch", width: 5, height: 5, patternUnits: "userSpaceOnUse" };
  const lines = svg("path", { class: "hatch", d: "M-1 6L6 -1M-1 1L1 -1M4 6L6 4" });
  return svg("defs", {}, svg("pattern", size, lines));
}

// The map's value: one mark on both scales.
function totalMark(total, x, width) {
  const { axis: y, height } = LINE_ROOM;
  const at = x(total);
  const value = probability(pFreeOf(total));
  const half = 30 + 3.5 * value.length; // of the words, so that they stay on the page
  const text = svg("text", { class: "total", x: clamp(at, half, width - half), y: 14 });
  const parts = [["letter", 0, "p"], ["small", 3, "free"], ["value", -3, ` = ${value}`]];
  text.append(...parts.map(([name, dy, words]) => svg("tspan", { class: name, dy }, words)));
  return [
    svg("path", { class: "total-line", d: `M${at} 20V${height}` }),
    svg("circle", { class: "total-dot", cx: at, cy: y, r: 6 }),
    text,
  ];
}

function sumWords({ state, constants }) {
  const total = totalOf(state, constants);
  const n = state.chips.length;
  const said = `log-odds ${signedOrZero(total)}, p free ${probability(pFreeOf(total))}`;
  return `prior ${state.prior.toFixed(2)}, ${n} reading${n === 1 ? "" : "s"}: ${said}`;
}

// ---- the prior's marker: a slider whose steps are hundredths of p -------------------------

function placePrior({ root, state, line, header }) {
  const marker = partOf(root, "prior");
  marker.style.transform = `translate(${line.x(logit(state.prior))}px, ${LINE_ROOM.axis}px)`;
  const [low, high] = header.limits.prior;
  const values = { valuemin: low, valuemax: high, valuenow: state.prior.toFixed(2) };
  values.valuetext = `p ${state.prior.toFixed(2)}, log-odds ${signedOrZero(logit(state.prior))}`;
  for (const [name, value] of Object.entries(values)) marker.setAttribute(`aria-${name}`, value);
}

function setPrior(p, prior) {
  const { hidden, locked } = p.header;
  if ([...hidden, ...locked].includes("p_wall")) return;
  const [low, high] = p.header.limits.prior;
  p.state.prior = clamp(Math.round(100 * prior) / 100, low, high);
  showAdding(p);
}

function priorKey(p, target, direction, isFar) {
  if (target !== partOf(p.root, "prior")) return false;
  setPrior(p, p.state.prior + direction * (isFar ? 0.1 : 0.01));
  commit(p, COMMIT_DELAY, sumWords);
  return true;
}

function listenToPrior(p) {
  const marker = partOf(p.root, "prior");
  let isHeld = false;
  marker.addEventListener("pointerdown", (event) => {
    marker.setPointerCapture(event.pointerId);
    isHeld = true;
  });
  marker.addEventListener("pointermove", (event) => {
    if (!isHeld) return;
    const { side } = LINE_ROOM;
    const { reach, width } = p.line;
    const at = event.clientX - partOf(p.root, "line").getBoundingClientRect().left;
    setPrior(p, pFreeOf(((at - side) / (width - 2 * side)) * 2 * reach - reach));
  });
  const end = () => {
    if (isHeld) commit(p, 0, sumWords);
    isHeld = false;
  };
  marker.addEventListener("pointerup", end);
  marker.addEventListener("pointercancel", end);
}

// ---- the sum, its terms coloured as their bars ---------------------------------------------

function showSum({ root }, bars) {
  const names = { prior: "prior", less: "less" };
  const terms = bars.flatMap(({ kind, from, to }, i) => {
    const name = names[kind] ?? (to < from ? "wall" : "free");
    const amount = signedOrZero(to - from);
    return [i ? " " : "", element("span", { class: `term ${name}` }, amount)];
  });
  const total = bars.at(-1).to;
  const result = element("b", {}, signedOrZero(total));
  partOf(root, "sum").replaceChildren(element("i", {}, "l"), " = ", ...terms, " = ", result);
}
