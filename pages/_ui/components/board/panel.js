// The toolbar above the canvas and the line of words below it.

function buildToolbar(b) {
  const mode = b.header.mode;
  const part = (name) => partOf(b.root, name);
  part("tools").replaceChildren(...toolsOf(b).map((name) => toolButton(b, name)));
  const isWalls = mode === "walls";
  const hasAngles = MODES[mode].some((name) => ANGLED.has(name));
  const pieces = b.pieces.length ? ["next-piece", "accept-all", "reject-all"] : [];
  const edits = ["undo", "redo", ...(isWalls ? pieces : ["remove"])];
  part("edits").replaceChildren(...[...(hasAngles ? ["straight"] : []), ...edits].map((name) => actionButton(b, name)));
  part("view").replaceChildren(...["zoom-out", "fit", "zoom-in"].map((name) => actionButton(b, name)));
  part("width").oninput = (event) => setWidth(b, Number(event.target.value));
  part("opacity").value = String(Math.round(b.opacity * 100));
  part("opacity").oninput = (event) => setOpacity(b, Number(event.target.value) / 100);
  part("width-row").hidden = !isWalls;
}

function button(label, icon, onClick) {
  const element = document.createElement("button");
  element.type = "button";
  element.title = label;
  element.setAttribute("aria-label", label);
  element.innerHTML = svg(icon);
  element.addEventListener("click", onClick);
  return element;
}

function toolButton(b, name) {
  const tool = TOOLS[name];
  const element = button(`${tool.label} (${tool.key.toUpperCase()})`, tool.icon, () => chooseTool(b, name));
  element.dataset.tool = name;
  return element;
}

function actionButton(b, name) {
  const element = button(ACTIONS[name].label, ACTIONS[name].icon, () => act(b, name));
  element.dataset.act = name;
  return element;
}

function act(b, name) {
  if (!b.doc) return;
  const middle = [b.camera.width / 2, b.camera.height / 2];
  if (name === "undo") undo(b);
  if (name === "redo") redo(b);
  if (name === "remove") setPoints(b, []);
  if (name === "next-piece") nextPiece(b);
  if (name === "accept-all") decide(b, openPieces(b), ADDED);
  if (name === "reject-all") decide(b, openPieces(b), ERASED);
  if (name === "straight") b.straight = !b.straight;
  if (name === "fit") fit(b.camera, b.size);
  if (name === "zoom-in") zoomAt(b.camera, b.size, middle, ZOOM_STEP);
  if (name === "zoom-out") zoomAt(b.camera, b.size, middle, 1 / ZOOM_STEP);
  showState(b);
  requestPaint(b);
}

function chooseTool(b, name) {
  stopGesture(b);
  b.draft = null;
  b.tool = name;
  for (const element of b.root.querySelectorAll("[data-tool]")) {
    element.setAttribute("aria-pressed", String(element.dataset.tool === name));
  }
  const straight = b.root.querySelector("[data-act=straight]");
  if (straight) straight.disabled = !ANGLED.has(name);
  const width = b.widths[name];
  const row = partOf(b.root, "width-row");
  // Keeps its space, so that nothing moves when a tool without a width is chosen.
  row.dataset.off = width ? "0" : "1";
  row.querySelector("input").disabled = !width;
  if (width) setWidth(b, width);
  partOf(b.root, "hint").textContent = `${TOOLS[name].label}. ${TOOLS[name].hint}`;
  showCursor(b);
  showState(b);
}

function setWidth(b, width) {
  if (!b.widths[b.tool]) return;
  b.widths[b.tool] = clamp(Math.round(width), 1, MAX_WIDTH_PX);
  partOf(b.root, "width").value = String(b.widths[b.tool]);
  partOf(b.root, "width-value").textContent = `${b.widths[b.tool]} px`;
  requestPaint(b);
}

const changeWidth = (b, step) => setWidth(b, (b.widths[b.tool] ?? 0) + step);

function setOpacity(b, opacity) {
  b.opacity = opacity;
  requestPaint(b);
}

function showCursor(b) {
  const isHand = b.space || b.panning || b.tool === "hand";
  b.root.dataset.cursor = b.panning ? "grabbing" : isHand ? "grab" : "cross";
  requestPaint(b);
}

// Disables buttons without effect and updates the numbers.
function showState(b) {
  if (!b.doc) return;
  const nOpen = openPieces(b).length;
  const off = { undo: !b.doc.past.length, redo: !b.doc.future.length, remove: !b.doc.points.length };
  for (const name of ["next-piece", "accept-all", "reject-all"]) off[name] = !nOpen;
  for (const [name, isOff] of Object.entries(off)) {
    const element = b.root.querySelector(`[data-act=${name}]`);
    if (element) element.disabled = isOff;
  }
  b.root.querySelector("[data-act=straight]")?.setAttribute("aria-pressed", String(b.straight));
  partOf(b.root, "opacity-row").hidden = !b.hasMask;
  b.root.dataset.doubtful = String(nOpen);
  b.root.dataset.steps = String(b.doc.past.length);
  b.root.dataset.points = String(b.doc.points.length);
  showPosition(b);
}

function showPosition(b) {
  if (!b.doc) return;
  const at = b.keyboard ?? b.hover;
  const facts = [...summary(b), `${Math.round(b.camera.scale * 100)} %`];
  if (at) facts.unshift(`x ${Math.floor(at[0])}, y ${Math.floor(at[1])} px`);
  partOf(b.root, "facts").textContent = facts.join("  ·  ");
}

function summary(b) {
  const { mode } = b.header;
  if (mode === "walls") return b.pieces.length ? [`${b.root.dataset.doubtful} doubtful left`] : [];
  const points = b.doc.points;
  if (mode !== "trajectory" || !points.length) return [];
  const facts = [`${points.length} ${points.length === 1 ? "point" : "points"}, ${lengthText(b, lengthOf(points))}`];
  const parts = b.hasMask ? partsInside(b.mask, points).length : 0;
  if (parts) facts.push(`${parts} ${parts === 1 ? "part" : "parts"} in walls`);
  return facts;
}
