// One cell: hover shows its numbers in all views, a click pins it and shows its readings
// one by one. Hovered and pinned places are points of the drawing, px: maps of another
// cell size show the cell that holds the same point.

function listenToView(p, view) {
  const { canvas } = view;
  canvas.addEventListener("pointermove", (event) => {
    const cell = isInert(p) || event.pointerType === "touch" ? null : cellAt(p, view, event);
    if (cell !== null) hoverOn(p, view, cell, event);
  });
  canvas.addEventListener("pointerleave", () => leaveCell(p));
  canvas.addEventListener("blur", () => leaveCell(p));
  canvas.addEventListener("click", (event) => {
    p.root.focus({ preventScroll: true });
    const cell = isInert(p) ? null : cellAt(p, view, event);
    if (cell !== null) togglePin(p, view, cell);
  });
}

function listenToTabs(p) {
  for (const tab of p.root.querySelectorAll("[data-tab]")) {
    tab.addEventListener("click", () => openTab(p, tab.dataset.tab));
  }
}

const isInert = (p) => !p.columns || p.state.compact;

const isAt = (point, grid, cell) => point !== null && cellHolding(grid, ...point) === cell;

// ---- hovering ------------------------------------------------------------------------

function hoverOn(p, view, cell, pointer) {
  const grid = gridUnder(p, view);
  const isNew = !isAt(p.hover, grid, cell);
  if (isNew) {
    p.hover = centreOf(grid, cell);
    drawStage(p);
  }
  showCard(p, pointer, cellTitle(grid, cell), factsIn(p, view, cell));
}

function leaveCell(p) {
  hideCard(p);
  if (p.hover === null) return;
  p.hover = null;
  drawStage(p);
}

// On a map's canvas, reached by Tab, arrows walk from cell to cell and Enter pins.
// Returns whether the key was one of these.
function cellKey(p, view, { key }) {
  const { log } = p.columns[view.column];
  const { nCols, nCells } = log;
  const start = p.hover ?? p.pin;
  const from = start ? cellHolding(log, ...start) : Math.floor(nCells / 2);
  if (key === "Enter") {
    togglePin(p, view, from);
    return true;
  }
  const move = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -nCols, ArrowDown: nCols }[key];
  if (!move) return false;
  const to = from + move;
  const leavesRow = Math.abs(move) === 1 && Math.floor(to / nCols) !== Math.floor(from / nCols);
  if (to >= 0 && to < nCells && !leavesRow) {
    hoverOn(p, view, to, screenPoint(p, view, centreOf(log, to)));
    say(p, cellWords(p, p.columns[view.column], to));
  }
  return true;
}

// ---- pinning -------------------------------------------------------------------------

// Pinning the pinned cell again unpins it.
function togglePin(p, view, cell) {
  const grid = gridUnder(p, view);
  setPin(p, isAt(p.pin, grid, cell) ? null : centreOf(grid, cell));
}

function unpin(p) {
  if (p.pin !== null) setPin(p, null);
}

// The pin is kept in px of the drawing, so that it survives another cell size.
function setPin(p, point) {
  p.pin = p.state.pin_px = point;
  openTab(p, point === null ? "scores" : "cell");
  commit(p, COMMIT_DELAY);
}

function openTab(p, name) {
  p.tab = p.header.hasTruth ? name : "cell"; // without a truth there are no scores
  refresh(p);
}

// ---- facts of a cell -----------------------------------------------------------------

function cellTitle(grid, c) {
  const [row, column] = placeOf(grid, c);
  return `${grid.cellPx > 1 ? "Cell" : "Pixel"} row ${row}, column ${column}`;
}

function factsIn(p, view, cell) {
  if (view.kind === "difference") return differenceFacts(p, cell);
  return cellFacts(p, p.columns[view.column], cell);
}

const CLASSES = { [SPACE]: "space cell", [WALL]: "wall cell", [UNKNOWN]: "unknown on the drawing" };

function cellFacts({ header }, column, c) {
  const logOdds = logOddsAt(column, c);
  const { truth, counts } = column.log;
  const known = [];
  if (header.hasPrior) known.push(["class", CLASSES[column.drawn[c]]]);
  if (header.hasTruth) known.push(["truth", truth[c] ? "wall" : "free"]);
  const declared = ["declared", declaresWall(column, logOdds) ? "wall" : "no wall"];
  if (column.log.coded) {
    const { hits, visits } = beamsOf(column.log, c);
    return [...known, ["beams that end here", grouped(hits)], ["or pass", grouped(visits - hits)], declared];
  }
  return [
    ...known,
    ["prior p_free", pFreeOf(priorOf(column, c)).toFixed(3)],
    ["readings k", grouped(column.laps * counts[c])],
    ["log-odds l", signed(logOdds, 3)],
    declared,
    ["p_free", probability(pFreeOf(logOdds))],
    ["p_occupied", probability(pFreeOf(-logOdds))],
  ];
}

function cellWords(p, column, c) {
  const facts = cellFacts(p, column, c).map((fact) => fact.join(" "));
  return `${cellTitle(column.log, c)}: ${facts.join(", ")}`;
}

// ---- the panels below the stage --------------------------------------------------------

function showTab(p) {
  const { root, pin } = p;
  const tab = openTabOf(p);
  for (const button of root.querySelectorAll("[data-tab]")) {
    button.setAttribute("aria-selected", String(button.dataset.tab === tab));
  }
  for (const panel of root.querySelectorAll("[data-panel]")) {
    panel.hidden = panel.dataset.panel !== tab;
  }
  root.dataset.pinned = pin === null ? "0" : "1";
  if (tab === "scores") showTables(p);
  if (p.header.hasTruth && (tab === "scores" || isSeveral(p))) showCurves(p);
  if (tab === "cell" && pin !== null) showPinned(p);
}

function showPinned(p) {
  const [column] = p.columns;
  const cell = cellHolding(column.log, ...p.pin);
  setText(partOf(p.root, "cell-name"), cellTitle(column.log, cell));
  partOf(p.root, "cell-facts").replaceChildren(...rows(cellFacts(p, column, cell)));
  showLadders(p);
}

const rows = (facts) =>
  facts.flatMap(([name, value]) => [element("dt", {}, ...maths(name)), element("dd", {}, value)]);

// ---- the card at the pointer -----------------------------------------------------------

function showCard({ root, card }, point, title, facts) {
  card.replaceChildren(element("b", {}, title), element("dl", {}, ...rows(facts)));
  card.hidden = false;
  const box = root.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = card;
  const [x, y] = [point.clientX - box.left, point.clientY - box.top];
  const left = x + 18 + width < box.width ? x + 18 : x - 18 - width;
  const top = y + 14 + height < box.height ? y + 14 : y - 14 - height;
  card.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, top)}px)`;
}

function hideCard({ card }) {
  card.hidden = true;
}
