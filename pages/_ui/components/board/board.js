// The drawing board: puts the parts together and talks to Streamlit.

const boards = new WeakMap(); // by the element that Streamlit gives us
const memory = new Map(); // by key: what a board held when it left the screen

export default function (component) {
  const { data, key, parentElement, setStateValue } = component;
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
    tint: document.createElement("canvas"),
    widths: {},
    opacity: 0.6,
    straight: false,
    tool: "",
    doc: null,
    gesture: null,
    pointers: new Map(),
    keyboard: null,
    hover: null,
    draft: null,
    selected: -1,
    partsInWalls: 0,
    loading: 0,
    waiting: null,
    commitTimer: 0,
    lastCommit: -Infinity,
  };
  for (const [name, tool] of Object.entries(TOOLS)) if (tool.width) b.widths[name] = tool.width;
  listen(b);
  b.observer = new ResizeObserver(() => measure(b));
  b.observer.observe(canvas);
  // For tests and the curious: what the board holds, by value.
  root.boardState = () => ({
    camera: { ...b.camera },
    points: b.doc.points,
    strokes: b.doc.first + b.doc.strokes.length,
    mask: b.grid ? Array.from(b.grid.pixels).join("") : "",
  });
  return b;
}

function close(b) {
  b.closed = true;
  stopTimers(b);
  b.observer.disconnect();
}

function stopTimers(b) {
  clearTimeout(b.longPress);
  clearTimeout(b.commitTimer);
  cancelAnimationFrame(b.frame);
}

// --- What Python sends: length of the header, header (JSON), image, mask. ---

async function receive(b, data) {
  const turn = ++b.loading;
  const bytes = new Uint8Array(data);
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const image = bytes.subarray(4 + length, 4 + length + header.imageBytes);
  const packed = bytes.subarray(4 + length + header.imageBytes);
  b.root.style.height = `${header.heightPx}px`;
  const [bitmap, base] = await Promise.all([decodedImage(image), decodedMask(packed, header)]);
  // Later data may have overtaken these while they were decoded.
  if (turn !== b.loading || b.closed) return;
  take(b, header, bitmap, base);
}

const decodedImage = (bytes) => createImageBitmap(new Blob([bytes]));

async function decodedMask(packed, header) {
  if (!packed.length) return new Uint8Array(header.width * header.height);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bits = new Uint8Array(await new Response(stream).arrayBuffer());
  return unpackedBits(bits, header.width * header.height);
}

function take(b, header, bitmap, base) {
  // The same document again (its strokes folded) can wait until the hand lets go.
  if (b.gesture && b.doc.identity === identityOf(header)) {
    b.waiting = () => take(b, header, bitmap, base);
    return;
  }
  b.waiting = null;
  stopGesture(b);
  const isNewMode = !b.header || b.header.mode !== header.mode;
  const isNewSize = b.size.width !== header.width || b.size.height !== header.height;
  Object.assign(b, { header, bitmap, colours: header.colours, hasMask: header.hasMask });
  b.size = { width: header.width, height: header.height };
  b.tintWord = wordOf(b.colours.wallMask);
  b.doc = documentFor(b, header, base);
  b.grid = { ...b.size, pixels: new Uint8Array(base.length) };
  Object.assign(b.tint, b.size);
  if (isNewMode) buildToolbar(b);
  if (isNewMode || isNewSize) recallView(b, isNewSize);
  measure(b);
  redrawMask(b);
  b.root.dataset.ready = "1";
  showState(b);
}

// Edits survive wherever Python imposes the document that they were made on.
function documentFor(b, header, base) {
  const known = [b.doc, memory.get(header.key)?.doc].find((doc) => doc && doc.identity === identityOf(header));
  if (known) return advance(known, header, base);
  b.draft = null;
  b.selected = -1;
  return newDocument(header, base);
}

function remember(b) {
  if (!b.doc) return;
  const { doc, camera, size, tool, widths, opacity, straight } = b;
  memory.set(b.header.key, { doc, camera: { ...camera }, size, tool, widths, opacity, straight });
}

// The view and the tools of the last visit, as far as they fit what is shown now.
function recallView(b, isNewSize) {
  const last = memory.get(b.header.key);
  const tools = MODES[b.header.mode];
  if (last) Object.assign(b, { widths: last.widths, opacity: last.opacity, straight: last.straight });
  const isSame = last && last.size.width === b.size.width && last.size.height === b.size.height;
  if (isSame && b.camera.width === 1) b.camera = { ...last.camera };
  else if (isNewSize) b.camera.fitted = true;
  chooseTool(b, last && tools.includes(last.tool) ? last.tool : tools[0]);
}

function measure(b) {
  const { clientWidth, clientHeight } = b.canvas;
  if (!clientWidth || !b.doc) return;
  const ratio = window.devicePixelRatio || 1;
  b.canvas.width = Math.round(clientWidth * ratio);
  b.canvas.height = Math.round(clientHeight * ratio);
  resize(b.camera, b.size, clientWidth, clientHeight);
  showState(b);
  paint(b);
}

function readTheme(b) {
  const style = getComputedStyle(b.root);
  const of = (name) => style.getPropertyValue(name).trim();
  b.theme = { ink: style.color, paper: of("--paper"), line: of("--rim"), font: style.fontFamily };
  requestPaint(b);
}

function fail(b, error) {
  b.root.dataset.ready = "1";
  b.root.querySelector("[data-part=hint]").textContent = `The board could not be drawn: ${error.message}`;
}
