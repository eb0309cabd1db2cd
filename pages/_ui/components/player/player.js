// The map player: handles input, redraws, and commits to Python.
//
// Python owns a document {rev, columns, ...}. The player takes it over when it starts or
// when rev changes; from then on the student's choices apply, and every commit echoes rev.

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
  const p = {
    root,
    card: root.querySelector(".card"),
    legend: element("span", { class: "legend" }),
    differenceKeys: element("span", { class: "legend" }),
    loading: 0,
    playing: false,
    position: 0,
    hover: null,
    pin: null,
    tab: "scores",
    byHand: [],
  };
  root.inspect = () => inspection(p);
  listenToTransport(p);
  listenToTabs(p);
  listenToButtons(p);
  root.addEventListener("keydown", (event) => keyDown(p, event));
  listenToPage(p);
  p.observer = new ResizeObserver(() => resize(p));
  p.observer.observe(root);
  return p;
}

function close(p) {
  p.film = null;
  pause(p);
  clearTimeout(p.commitTimer);
  p.loading++;
  p.observer.disconnect();
  document.removeEventListener("keydown", p.pageKey);
  p.columns = null;
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
    button.addEventListener("click", () => p.columns && actions[button.dataset.do]());
  }
}

function keyDown(p, event) {
  if (!p.columns || event.ctrlKey || event.metaKey || event.altKey) return;
  const { target, key } = event;
  const view = isInert(p) ? null : p.views.find(({ kind, canvas }) => kind === "map" && canvas === target);
  if (!(view && cellKey(p, view, event))) {
    const reach = event.shiftKey ? 10 : 1;
    const moves = {
      ArrowLeft: () => walkTo(p, p.state.step - reach),
      ArrowRight: () => walkTo(p, p.state.step + reach),
      Home: () => walkTo(p, 0),
      End: () => walkTo(p, p.scene.nReadings),
      Escape: () => unpin(p),
      " ": () => togglePlay(p),
    };
    if (p.state.compact && key !== " ") return;
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

// Until new parts are decoded the old ones stay, with their document and its choices.
async function receive(p, data) {
  const turn = ++p.loading;
  const [header, ...payloads] = readPacked(data);
  if (!p.header) build(p, header);
  await holdParts(header.parts, payloads);
  if (turn !== p.loading) return; // newer data is being decoded
  offer(p, header.texts);
  const isSame = p.columns && p.header.digest === header.digest;
  if (isSame && p.header.document.rev === header.document.rev) retheme(p);
  else take(p, header);
}

function build(p, header) {
  p.root.classList.toggle("compact", header.document.compact);
  p.referee = newReferee(p, header);
  buildControls(p, header);
  buildSpeeds(p, header.speeds);
  buildSaving(p);
  buildBar(p, header);
  buildStory(p, header);
  const { columns, ...colours } = header.colours;
  columns.forEach((value, i) => p.root.style.setProperty(`--colour-column${i}`, value));
  for (const [name, value] of Object.entries(colours)) {
    p.root.style.setProperty(`--colour-${name}`, value);
  }
}

// Shows a replay under a document. One that was playing stops where it is.
function take(p, header) {
  const wasPlaying = pause(p);
  p.state = adopted(header, p.state);
  for (const setting of p.state.columns) Object.assign(setting, header.fixed);
  for (const column of p.columns ?? []) column.key = null; // the step may be another
  Object.assign(p, { header, hover: null, finalF2: null });
  showLimits(p);
  learnParts(p, header);
  p.scene = partNamed(p, "scene ") ?? p.scene;
  p.beams = partNamed(p, "beams ") ?? null;
  p.root.classList.toggle("unjudged", !header.hasTruth);
  p.root.classList.toggle("unprimed", !header.hasPrior);
  p.theme = themeOf(p.root);
  hideCard(p);
  p.shown = null;
  if (!p.scene) {
    request(p);
    return;
  }
  fitState(p);
  recolour(p);
  if (wasPlaying) commit(p);
  if (p.state.compact && !isStill() && !isAsking(p) && !isOver(p)) play(p);
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
  const state = { ...document, columns: document.columns.map((column) => ({ ...column })) };
  const isLate = !current && known?.digest === digest && known.toldStep === document.step;
  if (isLate) state.step = known.state.step;
  remembered.set(key, { state, digest, toldStep: document.step });
  return state;
}

// Makes the choices fit the replay: they may have been made on another one.
function fitState(p) {
  const { state, scene } = p;
  state.step = clamp(state.step, 0, scene.nReadings);
  p.pin = state.pin_px && cellHolding(scene.pixels, ...state.pin_px) !== null ? state.pin_px : null;
  state.pin_px = p.pin;
  if (p.pin !== null || !p.header.hasTruth) p.tab = "cell";
  p.position = state.step;
  partOf(p.root, "scrub").max = scene.nReadings;
  partOf(p.root, "speed").value = state.speed ?? WHOLE;
}

function retheme(p) {
  p.theme = themeOf(p.root);
  forgetCurves(p);
  refresh(p);
}

// ---- what is drawn again -----------------------------------------------------------------

// After a change of a setting or of what is shown: redraws the maps that it changes.
// Where a part is missing, what is shown stays until it comes. Returns whether all are there.
function recolour(p) {
  const { state } = p;
  if (!state.columns.every((setting) => isHeld(p, setting))) {
    request(p);
    return false;
  }
  const began = performance.now();
  assembleColumns(p);
  const changed = p.columns.filter((column, i) => renewColumn(p, column, state.columns[i]));
  buildStage(p);
  const isAnother = p.columns.length !== p.shown;
  if (isAnother) {
    p.shown = p.columns.length;
    if (!p.state.compact) buildTiles(p);
    layOut(p);
  }
  if (!p.state.compact) {
    if (changed.length || isAnother) recompare(p);
    forgetCurves(p);
    showControls(p);
    showBar(p);
  }
  refresh(p);
  p.root.dataset.ready = "1";
  p.root.dataset.recolourMs = (performance.now() - began).toFixed(2);
  return true;
}

// Scores and paints a map under its setting; returns whether either had changed.
function renewColumn(p, column, setting) {
  const key = JSON.stringify([setting, p.state.overlay]);
  if (column.key === key) return false;
  column.key = key;
  setPrior(column, setting);
  if (p.header.hasTruth) scoreColumn(p, column);
  column.picture ??= newPicture(column.log, p.header.colours);
  paintAll(column.picture, column, p.state.overlay);
  return true;
}

function scoreColumn(p, column) {
  column.curves = scoreCurves(column);
  column.series = scoreSeries(column.curves, column.log.nCells);
  column.blank = blankSeries(column.log, p.header.constants);
}

function refresh(p) {
  if (!p.columns) return;
  const began = performance.now();
  drawStage(p);
  showStep(p);
  if (p.state.compact) {
    showStory(p);
  } else {
    showTab(p);
    if (isSeveral(p)) {
      showReferee(p);
      if (p.header.hasTruth) showQuestion(p);
    }
  }
  report(p);
  p.root.dataset.drawMs = (performance.now() - began).toFixed(2);
}

function resize(p) {
  if (!p.columns) return;
  layOut(p);
  forgetCurves(p);
  refresh(p);
}
