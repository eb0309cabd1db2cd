// One cell: hover shows its numbers, a click pins it and shows its readings one by one.

function listenToCells(p) {
  for (const canvas of Object.values(p.canvases)) {
    canvas.addEventListener("pointermove", (event) => {
      const cell = isInert(p) || event.pointerType === "touch" ? null : cellAt(p, event);
      if (cell !== null) hoverOn(p, cell, event);
    });
    canvas.addEventListener("pointerleave", () => leaveCell(p));
    canvas.addEventListener("blur", () => leaveCell(p));
    canvas.addEventListener("click", (event) => {
      p.root.focus({ preventScroll: true });
      const cell = isInert(p) ? null : cellAt(p, event);
      if (cell !== null) togglePin(p, cell);
    });
  }
  for (const tab of p.root.querySelectorAll("[data-tab]")) {
    tab.addEventListener("click", () => openTab(p, tab.dataset.tab));
  }
  listenToTerms(p, partOf(p.root, "terms"));
}

function listenToTerms(p, canvas) {
  canvas.addEventListener("click", (event) => {
    const bar = barAt(p.terms, event);
    if (bar) walkTo(p, bar.term ? bar.term.reading + 1 : 0);
  });
  canvas.addEventListener("pointermove", (event) => {
    const bar = barAt(p.terms, event);
    if (bar) showCard(p, event, ...termCard(p, bar));
    else hideCard(p);
  });
  canvas.addEventListener("pointerleave", () => hideCard(p));
}

const isInert = (p) => !p.model || p.state.compact;

// ---- hovering ------------------------------------------------------------------------

function hoverOn(p, cell, point) {
  const isNew = cell !== p.hover;
  p.hover = cell;
  if (isNew) drawStage(p);
  showCard(p, point, cellTitle(p.model, cell), cellFacts(p.model, cell));
}

function leaveCell(p) {
  hideCard(p);
  if (p.hover === null) return;
  p.hover = null;
  drawStage(p);
}

// On the map canvas, reached by Tab, arrows walk from cell to cell and Enter pins.
// Returns whether the key was one of these.
function cellKey(p, { key }) {
  const { nCols, nCells } = p.model;
  const from = p.hover ?? p.pin ?? Math.floor(nCells / 2);
  if (key === "Enter") {
    togglePin(p, from);
    return true;
  }
  const move = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -nCols, ArrowDown: nCols }[key];
  if (!move) return false;
  const to = from + move;
  const leavesRow = Math.abs(move) === 1 && Math.floor(to / nCols) !== Math.floor(from / nCols);
  if (to >= 0 && to < nCells && !leavesRow) {
    hoverOn(p, to, pointAt(p, to));
    say(p, cellWords(p.model, to));
  }
  return true;
}

// ---- pinning -------------------------------------------------------------------------

// Pinning the pinned cell again unpins it.
function togglePin(p, cell) {
  setPin(p, cell === p.pin ? null : cell);
}

function unpin(p) {
  if (p.pin !== null) setPin(p, null);
}

// The pin is kept in px of the drawing, so that it survives another cell size.
function setPin(p, cell) {
  p.pin = cell;
  p.state.pin_px = cell === null ? null : centreOf(p.model, cell);
  openTab(p, cell === null ? "scores" : "cell");
  commit(p, COMMIT_DELAY);
}

function openTab(p, name) {
  p.tab = name;
  refresh(p);
}

// ---- facts of a cell
// --------------------------------------------------------------------

function cellTitle(model, c) {
  const [row, column] = placeOf(model, c);
  return `Cell row ${row}, column ${column}`;
}

function cellFacts(model, c) {
  const logOdds = logOddsAt(model, c);
  return [
    ["class", model.isWall[c] ? "wall cell" : "space cell"],
    ["truth", model.truth[c] ? "wall" : "free"],
    ["prior p_free", model.pFreePrior[model.isWall[c]].toFixed(3)],
    ["readings k", String(model.counts[c])],
    ["log-odds l", signed(logOdds, 3)],
    ["declared", declaresWall(model, logOdds) ? "wall" : "no wall"],
    ["p_free", probability(pFreeOf(logOdds))],
    ["p_occupied", probability(pFreeOf(-logOdds))],
  ];
}

function cellWords(model, c) {
  const facts = cellFacts(model, c).map((fact) => fact.join(" "));
  return `${cellTitle(model, c)}: ${facts.join(", ")}`;
}

function termCard({ model, pin }, { term, to }) {
  if (!term)
    return [
      "Prior",
      [
        ["l_0", signed(to, 3)],
        ["p_free", probability(pFreeOf(to))],
      ],
    ];
  const facts = [
    ["p_free(reading)", probability(pFreeOf(term.said))],
    ["its log-odds", signed(term.said, 3)],
    ["adds", signed(term.added, 3)],
    ["then l", signed(term.total, 3)],
  ];
  if (!model.once) facts.splice(2, 0, ["less l_0", signed(-priorOf(model, pin), 3)]);
  return [`Reading ${term.reading + 1}`, facts];
}

function showTab(p) {
  const { root, pin, tab } = p;
  for (const button of root.querySelectorAll("[data-tab]")) {
    button.setAttribute("aria-selected", String(button.dataset.tab === tab));
  }
  for (const panel of root.querySelectorAll("[data-panel]")) {
    panel.hidden = panel.dataset.panel !== tab;
  }
  root.dataset.pinned = pin === null ? "0" : "1";
  if (tab === "scores") showScores(p);
  else if (pin !== null) showPinned(p);
}

function showPinned(p) {
  partOf(p.root, "cell-name").textContent = cellTitle(p.model, p.pin);
  partOf(p.root, "cell-facts").replaceChildren(...rows(cellFacts(p.model, p.pin)));
  showTerms(p);
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
