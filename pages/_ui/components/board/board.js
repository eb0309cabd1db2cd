// The drawing board: puts the parts together and talks to Streamlit.

const boards = new WeakMap(); // by the element that Streamlit gives us
const memory = new Map(); // by key: what a board held when it left the screen

export default function (component) {
  const { data, parentElement, setStateValue } = component;
  let b = boards.get(parentElement);
  if (!b || !b.root.isConnected) {
    if (b) close(b);
    b = opened(parentElement);
    boards.set(parentElement, b);
  }
  b.setStateValue = setStateValue;
  readTheme(b);
  receive(b, data).catch((error) => fail(b, error));
  return () => {
    remember(b);
    close(b);
    boards.delete(parentElement);
  };
}

function opened(parentElement) {
  const root = parentElement.querySelector(".board");
  const canvas = root.querySelector("canvas");
  const b = {
    root,
    canvas,
    ctx: canvas.getContext("2d"),
    camera: newCamera(),
    size: { width: 1, height: 1 },
    tint: offscreen(1, 1),
    widths: {},
    pieces: [],
    opacity: 0.6,
    straight: false,
    tool: "",
    doc: null,
    gesture: null,
    pointers: new Map(),
    keyboard: null,
    hover: null,
    draft: null,
    sending: 0,
    said: 0,
    selected: -1,
    partsInWalls: 0,
    loading: 0,
    waiting: null,
    commitTimer: 0,
    lastCommit: -Infinity,
    heard: new AbortController(),
  };
  for (const [name, tool] of Object.entries(TOOLS)) if (tool.width) b.widths[name] = tool.width;
  listen(b);
  b.observer = new ResizeObserver(() => measure(b));
  b.observer.observe(canvas);
  // For tests and debugging: a copy of the board's state.
  root.boardState = () => ({
    camera: { ...b.camera },
    points: b.doc.points,
    steps: b.doc.past.length,
    mask: b.mask.pixels.join(""),
  });
  return b;
}

function close(b) {
  b.closed = true;
  b.heard.abort();
  stopTimers(b);
  b.observer.disconnect();
}

function stopTimers(b) {
  clearTimeout(b.longPress);
  clearTimeout(b.commitTimer);
  cancelAnimationFrame(b.frame);
}

// --- What Python sends: header, picture, base mask, corrections. ---

async function receive(b, data) {
  const turn = ++b.loading;
  const [header, picture, base, overlay, doubt] = readPacked(data);
  // On a large screen the board takes what the page leaves.
  b.root.style.height = `max(${header.heightPx}px, 100vh - 250px)`;
  const size = header.width * header.height;
  const [bitmap, walls, planes, doubtful] = await Promise.all([
    pictureOf(picture),
    decodedFlags(base, size),
    decodedFlags(overlay, 2 * size),
    decodedFlags(doubt, size),
  ]);
  // Newer data may have arrived while these were decoded.
  if (turn !== b.loading || b.closed) return;
  take(b, header, bitmap, walls, overlayOf(planes, size), doubtful);
}

async function decodedFlags(bytes, count) {
  return bytes.length ? unpackBits(await inflated(bytes), count) : new Uint8Array(count);
}

const overlayOf = (planes, size) =>
  planes.subarray(0, size).map((isAdded, i) => (isAdded ? ADDED : planes[size + i] ? ERASED : 0));

function take(b, header, bitmap, base, overlay, doubtful) {
  // The same document again (the scale has changed) can wait until the gesture ends.
  if (b.gesture && b.doc.identity === identityOf(header)) {
    b.waiting = () => take(b, header, bitmap, base, overlay, doubtful);
    return;
  }
  b.waiting = null;
  stopGesture(b);
  const isNewMode = !b.header || b.header.mode !== header.mode;
  const isNewSize = b.size.width !== header.width || b.size.height !== header.height;
  Object.assign(b, { header, bitmap, colours: header.colours, hasMask: header.hasMask });
  b.size = { width: header.width, height: header.height };
  b.tintWord = pixelOf(rgbOf(b.colours.wallMask));
  b.doubtWord = pixelOf(rgbOf(b.colours.doubtful));
  const hadPieces = b.pieces.length > 0;
  Object.assign(b, { doubtful, pieces: piecesOf(doubtful, header.width) });
  b.doc = documentFor(b, header, base, overlay);
  b.overlay = { ...b.size, pixels: b.doc.overlay };
  b.mask = { ...b.size, pixels: new Uint8Array(base.length) };
  Object.assign(b.tint, b.size);
  const isNewBar = isNewMode || hadPieces !== b.pieces.length > 0;
  if (isNewBar) buildToolbar(b);
  if (isNewBar || isNewSize) recallView(b, isNewSize);
  measure(b);
  refreshMask(b, wholeOf(b.size));
  b.root.dataset.ready = "1";
  showState(b);
}

// Edits survive if Python imposes the document that they were made on.
function documentFor(b, header, base, overlay) {
  const known = [b.doc, memory.get(header.key)?.doc].filter(Boolean);
  const same = known.find((doc) => doc.identity === identityOf(header));
  if (same) return same;
  b.draft = null;
  b.selected = -1;
  const doc = newDocument(header, base, overlay);
  const last = known.find((other) => holdsTheSame(other, doc));
  return last ? { ...doc, past: last.past, future: last.future } : doc;
}

function remember(b) {
  if (!b.doc) return;
  const { doc, camera, size, tool, widths, opacity, straight } = b;
  memory.set(b.header.key, { doc, camera: { ...camera }, size, tool, widths, opacity, straight });
}

// The view and the tools of the last visit, as far as they fit the current document.
function recallView(b, isNewSize) {
  const last = memory.get(b.header.key);
  const tools = toolsOf(b);
  if (last) Object.assign(b, { widths: last.widths, opacity: last.opacity, straight: last.straight });
  const isSame = last && last.size.width === b.size.width && last.size.height === b.size.height;
  if (isSame && b.camera.width === 1) b.camera = { ...last.camera };
  else if (isNewSize) b.camera.fitted = true;
  chooseTool(b, last && tools.includes(last.tool) ? last.tool : tools[0]);
}

function measure(b) {
  const { clientWidth, clientHeight } = b.canvas;
  if (!clientWidth || !b.doc) return;
  const ratio = pixelRatio();
  b.canvas.width = Math.round(clientWidth * ratio);
  b.canvas.height = Math.round(clientHeight * ratio);
  resize(b.camera, b.size, clientWidth, clientHeight);
  showState(b);
  paint(b);
}

function readTheme(b) {
  b.theme = themeOf(b.root);
  requestPaint(b);
}

function fail(b, error) {
  b.root.dataset.ready = "1";
  partOf(b.root, "hint").textContent = `The board could not be drawn: ${error.message}`;
}
