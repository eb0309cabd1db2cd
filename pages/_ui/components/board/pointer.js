// Mouse, pen, touch and keys: input becomes a gesture of the chosen tool.

const LONG_PRESS_MS = 550;
const STILL_CSS_PX = 8;
const WHEEL_RATE = 0.0016;

function listen(b) {
  const on = (target, name, handler, options) => target.addEventListener(name, handler, options);
  const { canvas, root } = b;
  on(canvas, "pointerdown", (event) => pointerDown(b, event));
  on(canvas, "pointermove", (event) => pointerMove(b, event));
  on(canvas, "pointerup", (event) => pointerUp(b, event));
  on(canvas, "pointercancel", (event) => pointerLost(b, event));
  on(canvas, "pointerleave", () => hoverAt(b, null));
  on(canvas, "contextmenu", (event) => contextMenu(b, event));
  on(canvas, "wheel", (event) => wheel(b, event), { passive: false });
  on(canvas, "blur", () => ((b.keyboard = null), (b.space = false), requestPaint(b)));
  on(root, "keydown", (event) => keyDown(b, event));
  on(root, "keyup", (event) => keyUp(b, event));
  const elsewhere = (event) => event.composedPath().includes(canvas) || sendNow(b);
  for (const name of ["pointerdown", "keydown"]) {
    on(document, name, elsewhere, { capture: true, signal: b.heard.signal });
  }
}

function screenPoint(b, event) {
  const rect = b.canvas.getBoundingClientRect();
  return [event.clientX - rect.left, event.clientY - rect.top];
}

const imagePoint = (b, event) => toImage(b.camera, screenPoint(b, event));

function pointerDown(b, event) {
  if (!b.doc) return;
  b.root.dataset.keys = "0";
  b.canvas.focus({ preventScroll: true });
  b.canvas.setPointerCapture(event.pointerId);
  b.keyboard = null;
  b.pointers.set(event.pointerId, screenPoint(b, event));
  if (b.pointers.size > 1) return startPinch(b);
  if (event.button === 1 || b.space || b.tool === "hand") return startPan(b);
  // With Ctrl it is a right click on a Mac.
  if (event.button !== 0 || event.ctrlKey) return;
  b.pressedAt = screenPoint(b, event);
  startGesture(b, imagePoint(b, event), event);
  if (event.pointerType === "touch" && b.tool === "waypoints") armLongPress(b, event);
}

function startGesture(b, point, event) {
  b.gesture = TOOLS[b.tool].start(b, point, event);
  requestPaint(b);
}

function stopGesture(b) {
  clearTimeout(b.longPress);
  const gesture = b.gesture;
  b.gesture = null;
  if (gesture) gesture.cancel();
  takeWaiting(b);
  requestPaint(b);
}

// Applies what Python sent during the gesture.
function takeWaiting(b) {
  const waiting = b.waiting;
  b.waiting = null;
  if (waiting) waiting();
}

// Touch has no right button: a point held still is deleted.
function armLongPress(b, event) {
  const hit = b.gesture ? b.selected : -1;
  const point = imagePoint(b, event);
  b.longPress = setTimeout(() => {
    if (!b.gesture) return;
    stopGesture(b);
    if (pointAt(b, point, event) === hit) removePoint(b, hit);
  }, LONG_PRESS_MS);
}

function pointerMove(b, event) {
  if (!b.doc) return;
  const at = screenPoint(b, event);
  if (b.pressedAt && Math.hypot(at[0] - b.pressedAt[0], at[1] - b.pressedAt[1]) > STILL_CSS_PX) clearTimeout(b.longPress);
  hoverAt(b, event.pointerType === "touch" ? null : toImage(b.camera, at));
  if (!b.pointers.has(event.pointerId)) return;
  const before = b.pointers.get(event.pointerId);
  b.pointers.set(event.pointerId, at);
  if (b.pinch) return movePinch(b);
  if (b.panning) pan(b.camera, b.size, at[0] - before[0], at[1] - before[1]);
  if (b.gesture) {
    // A fast pointer sends several positions per frame.
    const events = event.getCoalescedEvents ? event.getCoalescedEvents() : [];
    for (const one of events.length ? events : [event]) b.gesture.move(imagePoint(b, one), event);
    showState(b);
  }
  requestPaint(b);
}

function pointerUp(b, event) {
  clearTimeout(b.longPress);
  b.pointers.delete(event.pointerId);
  b.pressedAt = null;
  if (b.gesture) endGesture(b);
  if (b.pointers.size === 0) stopPan(b);
  requestPaint(b);
}

function endGesture(b) {
  const gesture = b.gesture;
  b.gesture = null;
  gesture.end();
  takeWaiting(b);
  showState(b);
  requestPaint(b);
}

function pointerLost(b, event) {
  b.pointers.delete(event.pointerId);
  stopGesture(b);
  if (b.pointers.size === 0) stopPan(b);
}

function startPan(b) {
  b.panning = true;
  showCursor(b);
}

function stopPan(b) {
  b.panning = b.pinch = null;
  showCursor(b);
}

// A second finger turns the gesture of the first into a movement of the view.
function startPinch(b) {
  stopGesture(b);
  b.panning = true;
  b.pinch = pinchOf(b);
}

function pinchOf(b) {
  const [p, q] = [...b.pointers.values()];
  return { middle: [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], spread: Math.hypot(p[0] - q[0], p[1] - q[1]) };
}

function movePinch(b) {
  if (b.pointers.size < 2) return;
  const [before, now] = [b.pinch, pinchOf(b)];
  pan(b.camera, b.size, now.middle[0] - before.middle[0], now.middle[1] - before.middle[1]);
  if (before.spread > 0) zoomAt(b.camera, b.size, now.middle, now.spread / before.spread);
  b.pinch = now;
  showState(b);
  requestPaint(b);
}

function hoverAt(b, point) {
  b.hover = point;
  showPosition(b);
  requestPaint(b);
}

function contextMenu(b, event) {
  event.preventDefault();
  if (!b.doc || b.header.mode !== "trajectory" || event.pointerType === "touch") return;
  removePoint(b, pointAt(b, imagePoint(b, event), event));
  requestPaint(b);
}

// The wheel zooms if the board has the focus or Ctrl is held; else it scrolls the page.
function wheel(b, event) {
  const hasFocus = b.root.getRootNode().activeElement === b.canvas;
  if (!b.doc || !(hasFocus || event.ctrlKey || event.metaKey)) return;
  event.preventDefault();
  const lines = event.deltaMode === 1 ? 16 : 1;
  const rate = event.ctrlKey ? WHEEL_RATE * 5 : WHEEL_RATE;
  zoomAt(b.camera, b.size, screenPoint(b, event), Math.exp(-clamp(event.deltaY * lines, -300, 300) * rate));
  b.hover = imagePoint(b, event);
  showState(b);
  requestPaint(b);
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

function keyDown(b, event) {
  if (!b.doc) return;
  b.root.dataset.keys = "1";
  const onCanvas = event.target === b.canvas;
  const control = event.ctrlKey || event.metaKey;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  let done = true;
  if (control && key === "z") (event.shiftKey ? redo : undo)(b);
  else if (control && key === "y") redo(b);
  else if (control || event.altKey || !onCanvas) done = false;
  else if (key in ARROWS) moveKeyboard(b, ARROWS[key], event);
  else done = canvasKey(b, key, event);
  if (!done) return;
  event.preventDefault();
  // Streamlit listens for single letters on the whole page.
  event.stopPropagation();
  requestPaint(b);
}

function canvasKey(b, key, event) {
  const tool = toolsOf(b).find((name) => TOOLS[name].key === key);
  if (tool) chooseTool(b, tool);
  else if (key === " ") holdSpace(b, true);
  else if (key === "Enter") pressKeyboard(b, event);
  else if (key === "Escape") cancelAll(b);
  else if (key === "n") act(b, "next-piece");
  else if (key === "Delete" || key === "Backspace") deleteSelected(b);
  else if (key === "[" || key === "]") changeWidth(b, key === "]" ? 1 : -1);
  else if (key === "+" || key === "=") act(b, "zoom-in");
  else if (key === "-") act(b, "zoom-out");
  else if (key === "0") act(b, "fit");
  else return false;
  return true;
}

function keyUp(b, event) {
  if (event.key === " ") holdSpace(b, false);
}

function holdSpace(b, held) {
  b.space = held;
  showCursor(b);
}

function cancelAll(b) {
  stopGesture(b);
  b.draft = null;
  b.selected = -1;
}

function deleteSelected(b) {
  if (b.header.mode === "trajectory") removePoint(b, b.selected);
}

// The keyboard has a cursor of its own: arrows move it, Enter presses and lets go.
function moveKeyboard(b, [dx, dy], event) {
  const step = (event.shiftKey ? 10 : 1) * Math.max(1, Math.round(1 / b.camera.scale));
  const from = b.keyboard ?? b.hover ?? [b.size.width / 2, b.size.height / 2];
  const snap = (value, size) => clamp(Math.floor(value) + 0.5, 0.5, size - 0.5);
  b.keyboard = [snap(from[0] + dx * step, b.size.width), snap(from[1] + dy * step, b.size.height)];
  reveal(b.camera, b.size, b.keyboard);
  // Shift is the larger step here, not the straight angle.
  if (b.gesture) b.gesture.move(b.keyboard, null);
  showPosition(b);
}

function pressKeyboard(b) {
  b.keyboard ??= [Math.floor(b.size.width / 2) + 0.5, Math.floor(b.size.height / 2) + 0.5];
  if (b.gesture) return endGesture(b);
  startGesture(b, b.keyboard, { pointerType: "mouse", shiftKey: false });
  if (TOOLS[b.tool].clicks && b.gesture) endGesture(b);
}
