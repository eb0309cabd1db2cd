// The map player: handles input, redraws, and commits to Python.
//
// Python owns a document {rev, ...}. The player takes it over when it starts or when rev
// changes; from then on the student's choices apply, and every commit echoes rev.

const COMMIT_DELAY = 350; // ms; keys held down are one commit

// By key: the state of a player that the page unmounted, and what Python knows of it.
const remembered = new Map();

export default function ({ data, parentElement, setStateValue }) {
  const root = parentElement.querySelector(".player");
  root.player ??= opened(root);
  root.player.send = setStateValue;
  if (data) receive(root.player, data);
  return () => close(root.player);
}

function opened(root) {
  const canvas = (name) => root.querySelector(`[data-pane=${name}] canvas`);
  const p = {
    root,
    canvases: { drawing: canvas("drawing"), map: canvas("map") },
    card: root.querySelector(".card"),
    header: null,
    model: null,
    state: null,
    loading: 0,
    playing: false,
    position: 0,
    hover: null,
    pin: null,
    tab: "scores",
  };
  root.inspect = () => inspection(p);
  listenToTransport(p);
  listenToCells(p);
  listenToButtons(p);
  root.addEventListener("keydown", (event) => keyDown(p, event));
  p.observer = new ResizeObserver(() => resize(p));
  p.observer.observe(root);
  return p;
}

function close(p) {
  pause(p);
  clearTimeout(p.commitTimer);
  p.loading++;
  p.observer.disconnect();
  p.preview?.close();
  p.model = null;
}

function listenToButtons(p) {
  const actions = {
    restart: () => walkTo(p, 0),
    back: () => walkTo(p, p.state.step - 1),
    play: () => togglePlay(p),
    forward: () => walkTo(p, p.state.step + 1),
    unpin: () => unpin(p),
  };
  for (const button of p.root.querySelectorAll("[data-do]")) {
    button.addEventListener("click", () => p.model && actions[button.dataset.do]());
  }
}

function keyDown(p, event) {
  if (!p.model || event.ctrlKey || event.metaKey || event.altKey) return;
  const { target, key } = event;
  const onMap = target === p.canvases.map && !isInert(p);
  if (!(onMap && cellKey(p, event))) {
    const reach = event.shiftKey ? 10 : 1;
    const moves = {
      ArrowLeft: () => walkTo(p, p.state.step - reach),
      ArrowRight: () => walkTo(p, p.state.step + reach),
      Home: () => walkTo(p, 0),
      End: () => walkTo(p, p.model.nReadings),
      Escape: () => unpin(p),
      " ": () => togglePlay(p),
    };
    // Sliders, options and buttons keep their own keys.
    const isTheirs =
      (target.matches("select, input:not(.scrub)") && key !== "Escape") ||
      (target.matches("button") && key === " ");
    if (!moves[key] || isTheirs) return;
    moves[key]();
  }
  event.preventDefault();
  event.stopPropagation();
}

// ---- from Python -----------------------------------------------------------------------

// Until a new replay is decoded the old one stays, with its document and its choices.
async function receive(p, data) {
  const turn = ++p.loading;
  const [header, replay] = readPacked(data);
  if (!p.header) build(p, header);
  if (p.model && p.header.digest === header.digest) {
    if (p.header.document.rev === header.document.rev) retheme(p);
    else take(p, header, p.model, p.preview);
    return;
  }
  const decoded = decodeReplay((await inflated(replay)).buffer);
  const preview = await pictureOf(decoded.preview).catch(() => null);
  if (turn !== p.loading) return; // newer data is being decoded
  p.preview?.close();
  take(p, header, newModel(decoded, header.constants), preview);
}

function build(p, header) {
  p.root.classList.toggle("compact", header.document.compact);
  buildControls(p, header);
  buildSpeeds(p, header.speeds);
  buildTiles(p, header.texts.scores);
  for (const [name, value] of Object.entries(header.colours)) {
    p.root.style.setProperty(`--colour-${name}`, value);
  }
}

// Shows a replay under a document. One that was playing stops where it is.
function take(p, header, model, preview) {
  const wasPlaying = pause(p);
  p.state = adopted(header, p.state);
  Object.assign(p, { header, model, preview, hover: null });
  p.theme = themeOf(p.root);
  p.picture = newPicture(model, header.colours);
  fitState(p);
  hideCard(p);
  layOut(p);
  recolour(p);
  p.root.dataset.ready = "1";
  if (wasPlaying) commit(p);
  const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
  if (p.state.compact && !isStill) play(p);
}

// The choices that apply. A player that returns without a new document continues where it
// was. Nothing is sent while it plays, so Python may only know the step at which Play was
// pressed: if so, for the same replay, the step that was shown counts.
function adopted({ key, digest, document }, current) {
  const known = remembered.get(key);
  if (known?.state.rev === document.rev) {
    known.digest = digest;
    return known.state;
  }
  const state = { ...document };
  const isLate = !current && known?.digest === digest && known.toldStep === document.step;
  if (isLate) state.step = known.state.step;
  remembered.set(key, { state, digest, toldStep: document.step });
  return state;
}

// Makes the choices fit the replay: they may have been made on another one.
function fitState(p) {
  const { state, model } = p;
  state.step = clamp(state.step, 0, model.nReadings);
  p.pin = state.pin_px && cellHolding(model, ...state.pin_px);
  if (p.pin === null) state.pin_px = null;
  if (p.pin !== null) p.tab = "cell";
  p.position = state.step;
  seek(model, state.step);
  partOf(p.root, "scrub").max = model.nReadings;
  partOf(p.root, "speed").value = speedOf(p);
}

function retheme(p) {
  p.theme = themeOf(p.root);
  refresh(p);
}

// ---- to Python and to screen readers
// -----------------------------------------------------

function commit(p, delay = 0) {
  if (p.state.compact) return;
  clearTimeout(p.commitTimer);
  p.commitTimer = setTimeout(() => {
    remembered.get(p.header.key).toldStep = p.state.step;
    p.send("committed", { ...p.state });
    say(p, stateWords(p));
  }, delay);
}

// A screen reader is told the state at a stop, not each frame.
function say({ root }, words) {
  partOf(root, "said").textContent = words;
}

function stateWords(p) {
  const { step } = p.state;
  const scores = p.tiles.map(({ name, label }) => `${label} ${percent(p.series[name][step])}`);
  const pinned = p.pin === null ? [] : [cellWords(p.model, p.pin)];
  return [`${stepWords(p)}: ${scores.join(", ")}`, ...pinned].join(". ");
}

// ---- what is drawn again -----------------------------------------------------------------

// After a change of prior, rule, overlay or region: redraws all cells and curves.
function recolour(p) {
  const { state, model } = p;
  if (!model) return;
  const began = performance.now();
  setPrior(model, state);
  p.curves = scoreCurves(model, state.region);
  p.series = scoreSeries(p.curves, model.nCells);
  paintAll(p.picture, model, state);
  showControls(p);
  refresh(p);
  p.root.dataset.recolourMs = (performance.now() - began).toFixed(2);
}

function refresh(p) {
  if (!p.model) return;
  const began = performance.now();
  drawStage(p);
  showStep(p);
  if (!p.state.compact) {
    showTab(p);
    report(p);
  }
  p.root.dataset.drawMs = (performance.now() - began).toFixed(2);
}

// For tests: the state of the player, and the numbers behind it.
function report({ root, header, state, model, curves }) {
  const { step } = state;
  const [tp, fp, fn, tn] = curves.counts.map((curve) => curve[step]);
  Object.assign(root.dataset, { tp, fp, fn, tn, step, explored: curves.explored[step] });
  const { nReadings, cellPx } = model;
  Object.assign(root.dataset, { rev: header.document.rev, nReadings, cellPx });
  Object.assign(root.dataset, { pWall: state.p_wall, pSpace: state.p_space });
}

function inspection(p) {
  const { model, hover, pin, scale } = p;
  const logOdds = Array.from(model.counts, (_, c) => logOddsAt(model, c));
  const history = pin === null ? null : historyOf(model, pin);
  const bars = p.terms?.bars.map((_, i) => barX(p.terms.slot, i));
  return { hover, pin, scale, logOdds, history, bars };
}

function resize(p) {
  if (!p.model) return;
  layOut(p);
  refresh(p);
}
