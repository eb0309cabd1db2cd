// One cell: hover tells its numbers, a click pins it and shows its readings one by one.

class Inspector {
  constructor(player) {
    this.player = player;
    this.root = player.root;
    this.card = this.root.querySelector(".card");
    this.terms = new TermsChart(player.part("terms"));
    this.tab = "scores";
    this.listen();
  }

  get stage() {
    return this.player.stage;
  }

  get model() {
    return this.player.model;
  }

  listen() {
    for (const canvas of this.root.querySelectorAll(".pane canvas")) {
      canvas.addEventListener("pointermove", (event) => this.pointAt(event));
      canvas.addEventListener("pointerleave", () => this.leave());
      canvas.addEventListener("blur", () => this.leave());
      canvas.addEventListener("click", (event) => this.clickAt(event));
    }
    for (const tab of this.root.querySelectorAll("[data-tab]")) {
      tab.addEventListener("click", () => this.showTab(tab.dataset.tab));
    }
    const { canvas } = this.terms;
    canvas.addEventListener("click", (event) => {
      const bar = this.terms.barAt(event);
      if (bar) this.player.walkTo(bar.term ? bar.term.reading + 1 : 0);
    });
    canvas.addEventListener("pointermove", (event) => this.pointAtTerm(event));
    canvas.addEventListener("pointerleave", () => this.hideCard());
  }

  get inert() {
    return !this.model || this.player.state.compact;
  }

  // ---- hovering --------------------------------------------------------------------

  pointAt(event) {
    if (this.inert || event.pointerType === "touch") return;
    const cell = this.stage.cellAt(event);
    if (cell !== null) this.hover(cell, event);
  }

  hover(cell, point) {
    const moved = cell !== this.stage.hover;
    this.stage.hover = cell;
    if (moved) this.stage.draw();
    this.showCard(point, this.title(cell), this.facts(cell));
  }

  leave() {
    if (this.inert) return;
    this.hideCard();
    this.stage.hover = null;
    this.stage.draw();
  }

  // On the map canvas, reached by Tab, arrows walk from cell to cell and Enter pins.
  // Returns whether the key was one of these.
  onKey(event) {
    const { stage, model } = this;
    const { nCols, nCells } = model;
    const moves = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -nCols, ArrowDown: nCols };
    const from = stage.hover ?? stage.pin ?? Math.floor(nCells / 2);
    if (event.key === "Enter") {
      this.pin(from);
      return true;
    }
    const move = moves[event.key];
    if (move === undefined) return false;
    const to = from + move;
    const row = (c) => Math.floor(c / nCols);
    const leavesRow = Math.abs(move) === 1 && row(to) !== row(from);
    if (to >= 0 && to < nCells && !leavesRow) this.hover(to, stage.pointAt(to));
    return true;
  }

  // ---- pinning ---------------------------------------------------------------------

  clickAt(event) {
    this.root.focus({ preventScroll: true });
    if (this.inert) return;
    const cell = this.stage.cellAt(event);
    if (cell !== null) this.pin(cell);
  }

  // Pinning the pinned cell again unpins it.
  pin(cell) {
    this.setPin(cell === this.stage.pin ? null : cell);
  }

  unpin() {
    if (this.stage.pin !== null) this.setPin(null);
  }

  // The pin is kept in px of the drawing, so that it survives another cell size.
  setPin(cell) {
    const { stage, player } = this;
    stage.pin = cell;
    player.state.pin_px = cell === null ? null : stage.centre(cell);
    stage.draw();
    this.showTab(cell === null ? "scores" : "cell");
    player.commit(COMMIT_DELAY);
  }

  restore() {
    const point = this.player.state.pin_px;
    this.stage.pin = point ? this.stage.cellHolding(...point) : null;
    if (this.stage.pin !== null) this.showTab("cell");
  }

  // ---- what is told of a cell --------------------------------------------------------

  title(c) {
    const { nCols } = this.model;
    return `Cell row ${Math.floor(c / nCols)}, column ${c % nCols}`;
  }

  facts(c) {
    const { model } = this;
    const l = model.mapLogOdds(c);
    return [
      ["class", model.isWall[c] ? "wall cell" : "space cell"],
      ["truth", model.truth[c] ? "wall" : "free"],
      ["prior p_free", model.pFreePrior[model.isWall[c]].toFixed(3)],
      ["readings k", String(model.counts[c])],
      ["log-odds l", signed(l, 3)],
      ["declared", model.isOccupied(c) ? "wall" : "no wall"],
      ["p_free", probability(pFreeOf(l))],
      ["p_occupied", probability(pFreeOf(-l))],
    ];
  }

  showTab(name) {
    this.tab = name;
    for (const tab of this.root.querySelectorAll("[data-tab]")) {
      tab.setAttribute("aria-selected", String(tab.dataset.tab === name));
    }
    for (const panel of this.root.querySelectorAll("[data-panel]")) {
      panel.hidden = panel.dataset.panel !== name;
    }
    this.player.part("regions").hidden = name !== "scores";
    this.player.part("axis-name").hidden = name !== "cell";
    this.player.refresh();
  }

  show() {
    const { pin } = this.stage;
    const panel = this.root.querySelector("[data-panel=cell]");
    panel.dataset.pinned = pin === null ? "0" : "1";
    if (pin === null) return;
    this.player.part("cell-name").textContent = this.title(pin);
    this.player.part("cell-facts").replaceChildren(...rows(this.facts(pin)));
    const history = this.model.history(pin);
    this.terms.draw(history, this.player.state.step, this.player.ink);
  }

  // ---- the terms of the pinned cell --------------------------------------------------

  pointAtTerm(event) {
    const bar = this.terms.barAt(event);
    if (bar) this.showCard(event, ...this.termCard(bar));
    else this.hideCard();
  }

  termCard({ term, to }) {
    if (!term) {
      const prior = [
        ["l_0", signed(to, 3)],
        ["p_free", probability(pFreeOf(to))],
      ];
      return ["Prior", prior];
    }
    const l0 = this.model.logOddsPrior[this.model.isWall[this.stage.pin]];
    const less = this.model.once ? [] : [["less l_0", signed(-l0, 3)]];
    const facts = [
      ["p_free(reading)", probability(pFreeOf(term.said))],
      ["its log-odds", signed(term.said, 3)],
      ...less,
      ["adds", signed(term.added, 3)],
      ["then l", signed(term.total, 3)],
    ];
    return [`Reading ${term.reading + 1}`, facts];
  }

  // ---- the card at the pointer -------------------------------------------------------

  showCard(point, title, facts) {
    const { card } = this;
    card.replaceChildren(element("b", {}, title), element("dl", {}, ...rows(facts)));
    card.hidden = false;
    const box = this.root.getBoundingClientRect();
    const x = point.clientX - box.left;
    const y = point.clientY - box.top;
    const { offsetWidth: width, offsetHeight: height } = card;
    const left = x + 18 + width < box.width ? x + 18 : x - 18 - width;
    const top = y + 14 + height < box.height ? y + 14 : y - 14 - height;
    card.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, top)}px)`;
  }

  hideCard() {
    this.card.hidden = true;
  }
}
