// The robot, its handle and the cells: mouse, pen, touch and keys.

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const TURN_DEG = 15; // of [ and ], and of an arrow with Shift
const LEAP_PX = 4; // of an arrow with Shift

function listen(p) {
  drag(p, "robot", (x, y, grip) => moveRobot(p, x - grip.x, y - grip.y));
  drag(p, "handle", (x, y) => turnTowards(p, x, y));
  p.canvas.addEventListener("pointermove", (event) => hoverAt(p, event));
  p.canvas.addEventListener("pointerleave", () => hoverAt(p, null));
  p.canvas.addEventListener("click", (event) => selectAt(p, event));
  p.root.addEventListener("keydown", (event) => keyDown(p, event));
}

// A point of the page in px of the world.
function placeAt({ canvas, scale }, event) {
  const box = canvas.getBoundingClientRect();
  return { x: (event.clientX - box.left) / scale, y: (event.clientY - box.top) / scale };
}

function pixelUnder(p, event) {
  const { x, y } = placeAt(p, event);
  const isInside = x >= 0 && y >= 0 && x < p.world.width && y < p.world.height;
  return isInside ? { row: Math.floor(y), col: Math.floor(x) } : null;
}

// A button that is dragged; grip is where in it the pointer took hold.
function drag(p, name, move) {
  const button = partOf(p.root, name);
  let grip = null;
  const on = (type, handler) => button.addEventListener(type, handler);
  on("pointerdown", (event) => {
    if (event.button !== 0) return;
    button.setPointerCapture(event.pointerId);
    const { x, y } = placeAt(p, event);
    grip = { x: x - p.state.x, y: y - p.state.y };
    p.hover = null;
  });
  on("pointermove", (event) => {
    if (!grip) return;
    const { x, y } = placeAt(p, event);
    move(x, y, grip);
  });
  const end = () => {
    if (grip) commit(p);
    grip = null;
  };
  on("pointerup", end);
  on("pointercancel", end);
}

function moveRobot(p, x, y) {
  Object.assign(p.state, freePlace(p.world, p.state, x, y));
  requestShow(p);
}

function turnTowards(p, x, y) {
  const { state } = p;
  if (x === state.x && y === state.y) return;
  state.heading = wrapped((Math.atan2(y - state.y, x - state.x) * 180) / Math.PI);
  requestShow(p);
}

function hoverAt(p, event) {
  p.hover = event && pixelUnder(p, event);
  requestShow(p);
}

function selectAt(p, event) {
  const pixel = pixelUnder(p, event);
  if (pixel) select(p, Math.floor(pixel.row / p.state.size), Math.floor(pixel.col / p.state.size));
}

function select(p, row, col) {
  const { nRows, nCols } = p.cells;
  Object.assign(p.state, { row: clamp(row, 0, nRows - 1), col: clamp(col, 0, nCols - 1) });
  changed(p);
}

// Shows a change and tells Python once the keys rest.
function changed(p) {
  requestShow(p);
  commit(p, COMMIT_DELAY);
}

function keyDown(p, event) {
  if (!p.state || event.ctrlKey || event.metaKey || event.altKey) return;
  if (!(onArrow(p, event) || onBracket(p, event))) return;
  event.preventDefault();
  // Streamlit listens for single letters on the whole page.
  event.stopPropagation();
}

function onBracket(p, { key, target }) {
  const turn = { "[": -TURN_DEG, "]": TURN_DEG }[key];
  if (!turn || target.matches("input")) return false;
  p.state.heading = wrapped(p.state.heading + turn);
  changed(p);
  return true;
}

function onArrow(p, { key, target, shiftKey }) {
  const arrow = ARROWS[key];
  if (!arrow) return false;
  const [dx, dy] = arrow;
  const { state, world } = p;
  if (target === p.canvas) select(p, state.row + dy, state.col + dx);
  else if (target === partOf(p.root, "robot")) {
    const reach = shiftKey ? LEAP_PX : 1;
    Object.assign(state, stepped(world, state, reach * dx, reach * dy));
    changed(p);
  } else if (target === partOf(p.root, "handle")) {
    state.heading = wrapped(state.heading + (dx + dy) * (shiftKey ? TURN_DEG : 1));
    changed(p);
  } else return priorKey(p, target, dx - dy, shiftKey);
  return true;
}
