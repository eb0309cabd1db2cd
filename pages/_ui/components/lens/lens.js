// The lens: takes what Python sends, redraws, and commits to Python.
//
// Python owns a document {rev, ...}. The lens takes it over when it starts or when rev
// changes; from then on the student's choices apply, and every commit echoes rev.

const COMMIT_DELAY = 300; // ms; keys held down are one commit

// By key: the state of a lens that the page unmounted.
const remembered = new Map();

export default function ({ data, parentElement, setStateValue }) {
  const root = parentElement.querySelector(".lens");
  root.lens ??= opened(root);
  root.lens.send = setStateValue;
  if (data) receive(root.lens, JSON.parse(data));
  return () => close(root.lens);
}

function opened(root) {
  const p = { root, canvas: root.querySelector("canvas"), header: null, state: null, hover: null, pending: null };
  listen(p);
  listenToPrior(p);
  root.addEventListener("pointerleave", () => flush(p));
  p.observer = new ResizeObserver(() => resize(p));
  p.observer.observe(root);
  root.inspect = () => inspection(p);
  return p;
}

function close(p) {
  clearTimeout(p.commitTimer);
  cancelAnimationFrame(p.frame);
  p.observer.disconnect();
}

// ---- from Python -----------------------------------------------------------------------

function receive(p, header) {
  if (!p.header) build(p, header);
  const isSame = p.header.document.rev === header.document.rev && p.state;
  p.header = header;
  p.theme = themeOf(p.root);
  obeyLimits(p.root, header);
  if (!isSame) {
    const known = remembered.get(header.key);
    p.state = known?.rev === header.document.rev ? known : stateOf(header.document);
    remembered.set(header.key, p.state);
  }
  resize(p);
  p.root.dataset.ready = "1";
}

function build(p, header) {
  const { constants, colours } = header;
  const world = worldOf(header.world);
  const canvas = offscreen(world.width, world.height);
  const image = canvas.getContext("2d").createImageData(world.width, world.height);
  Object.assign(p, { header, world, constants, colours, inks: inksOf(colours), picture: { canvas, image } });
  for (const [name, value] of Object.entries(colours)) p.root.style.setProperty(`--colour-${name}`, value);
  buildControls(p);
  buildSaving(p);
}

// ---- to Python and to screen readers ---------------------------------------------------

// What was changed is heard: the selected cell, or the sum of the readings.
function commit(p, delay = 0, heard = cellWords) {
  clearTimeout(p.commitTimer);
  p.pending = () => {
    p.pending = null;
    p.send("committed", textsOf(p.state));
    setText(partOf(p.root, "said"), heard(p));
  };
  p.commitTimer = setTimeout(() => p.pending?.(), delay);
}

// A pointer that leaves the lens may be about to leave the page.
function flush(p) {
  clearTimeout(p.commitTimer);
  p.pending?.();
}

// ---- what is drawn again ---------------------------------------------------------------

// Once a frame at most.
function requestShow(p) {
  if (p.frame) return;
  p.frame = requestAnimationFrame(() => {
    p.frame = 0;
    show(p);
  });
}

// The reading from where the robot stands.
function show(p) {
  if (!p.state) return;
  const began = performance.now();
  const { world, state, constants } = p;
  p.kinds = readPixels(world, poseOf(state), sensorOf(state), constants);
  p.cells = countCells(world, p.kinds, state.size);
  drawStage(p);
  showCell(p);
  showPixel(p);
  showHidden(p);
  showControls(p);
  showPlaces(p);
  p.root.dataset.showMs = (performance.now() - began).toFixed(2);
}

// The readings that add up; they do not depend on the robot.
function showAdding(p) {
  if (!p.state || !p.kinds) return;
  showLine(p);
  showChips(p);
  showCounting(p);
  showControls(p);
}

// Where things are, for who does not see them.
function showPlaces({ root, state }) {
  const label = (name, words) => partOf(root, name).setAttribute("aria-label", words);
  label("robot", `Robot at x ${state.x}, y ${state.y}. Arrow keys move it.`);
  const handle = partOf(root, "handle");
  handle.setAttribute("aria-valuenow", state.heading);
  handle.setAttribute("aria-valuetext", `${state.heading} degrees`);
}

function resize(p) {
  if (!p.state) return;
  layOut(p);
  show(p);
  showAdding(p);
}

// For tests: the student's choices and the numbers of the reading.
function inspection({ state, cells, kinds, world, scale, constants }) {
  const said = Array.from(cells.empty, (n, c) => saidOf(n, cells.object[c], constants).logOdds);
  const [empty, object] = [Array.from(cells.empty), Array.from(cells.object)];
  const total = totalOf(state, constants);
  return { texts: textsOf(state), empty, object, said, hidden: countHidden(world, kinds), scale, total };
}
