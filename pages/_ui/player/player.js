// Wiring: what the student does, what is drawn again, and what Python hears of it.
//
// Python owns a document {rev, ...}. The player takes it over when it starts or when rev
// changes; from then on the student's hand rules, and every commit echoes rev.

const COMMIT_DELAY = 350; // ms; keys held down are one commit
const LOOP_PAUSE = 1.6; // s at the end of a compact replay
const remembered = new Map(); // by key: state of a player that the page unmounted

function readData(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  return { header, replay: bytes.subarray(4 + length) };
}

class Player {
  constructor(root) {
    this.root = root;
    this.playing = false;
    this.model = null;
    this.load = 0;
    this.tab = "scores";
    this.terms = new TermsChart(this.part("terms"));
    this.tiles = [];
    this.listen();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(root);
  }

  part(name) {
    return this.root.querySelector(`[data-part=${name}]`);
  }

  // ---- from Python ---------------------------------------------------------------

  async receive(data, send) {
    this.send = send;
    if (!data) return;
    const { header, replay } = readData(data);
    const sameDocument = this.header?.document.rev === header.document.rev;
    const sameReplay = this.header?.digest === header.digest;
    if (!this.stage) this.start(header);
    this.header = header;
    if (!sameDocument) this.adopt(header);
    if (sameReplay) {
      this.readInk(); // perhaps the theme has changed
      if (!sameDocument) this.restore();
      this.refresh();
      return;
    }
    const stopped = this.playing;
    this.pause(false);
    await this.show(replay);
    if (stopped) this.commit();
  }

  start(header) {
    this.stage = new Stage(this.root, header.colours);
    this.root.classList.toggle("compact", header.document.compact);
    this.buildChoices(header.texts);
    this.buildTiles(header.texts.scores);
    const speeds = header.speeds.map((v) => element("option", { value: v }, `${v} readings/s`));
    this.part("speed").replaceChildren(...speeds);
    for (const [name, value] of Object.entries(header.colours)) {
      this.root.style.setProperty(`--colour-${name}`, value);
    }
  }

  // A remount without word from Python goes on where this player was.
  adopt(header) {
    const known = remembered.get(header.key);
    const goesOn = known && known.rev === header.document.rev;
    this.state = goesOn ? known : { ...header.document };
    remembered.set(header.key, this.state);
  }

  async show(replay) {
    const load = ++this.load;
    const model = new MapModel(decodeReplay(await inflate(replay)), this.header.constants);
    if (load !== this.load) return; // newer data is on its way
    this.stage.model = null;
    await this.stage.show(model);
    if (load !== this.load) return;
    this.model = model;
    this.root.model = model;
    this.state.step = Math.min(this.state.step, model.nReadings);
    this.position = this.state.step;
    this.stage.hover = null;
    this.hideCard();
    this.restore();
    this.root.dataset.ready = "1";
    if (this.state.compact && !matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.play();
    }
  }

  // Everything on screen from the state.
  restore() {
    if (!this.model) return;
    const { state, model } = this;
    state.step = Math.min(state.step, model.nReadings);
    this.position = state.step;
    state.speed ??= this.header.speeds.reduce((best, v) =>
      Math.abs(v - model.nReadings / 10) < Math.abs(best - model.nReadings / 10) ? v : best,
    );
    this.part("scrub").max = model.nReadings;
    this.part("speed").value = state.speed;
    this.showChoices();
    this.readInk();
    this.restorePin();
    model.seek(state.step);
    this.recolour();
  }

  // ---- to Python -----------------------------------------------------------------

  commit(delay = 0) {
    if (this.state.compact) return;
    clearTimeout(this.commitTimer);
    this.commitTimer = setTimeout(() => this.send("committed", { ...this.state }), delay);
  }

  // ---- building ------------------------------------------------------------------

  buildChoices(texts) {
    const choose = (name, after) => (value) => {
      this.state[name] = value;
      after();
      this.commit();
    };
    const fill = (part, options, group, onChoose) =>
      this.part(part).append(...options.map((o) => radio(group, o, onChoose)));
    const recolour = () => this.recolour();
    fill("rules", texts.rules, "rule", choose("rule", recolour));
    fill("overlays", texts.overlays, "overlay", choose("overlay", recolour));
    fill("regions", texts.regions, "region", choose("region", recolour));
  }

  buildTiles(scores) {
    for (const { name, label, about } of scores) {
      const value = element("output", {});
      const curve = element("canvas", { role: "img", "aria-label": `${label} over the readings` });
      const words = element("div", { class: "tile-words" }, element("b", {}, label), value);
      this.root.querySelector("[data-panel=scores]").append(
        element("div", { class: "tile", "data-score": name }, words, curve, element("small", {}, about)),
      );
      this.scrubOn(curve);
      this.tiles.push({ name, value, curve });
    }
  }

  scrubOn(curve) {
    const go = (event) => this.goTo(stepAtCurve(curve, event, this.model.nReadings));
    curve.addEventListener("pointerdown", (event) => {
      this.pause(false);
      curve.setPointerCapture(event.pointerId);
      go(event);
    });
    curve.addEventListener("pointermove", (event) => {
      if (curve.hasPointerCapture(event.pointerId)) go(event);
    });
    curve.addEventListener("pointerup", () => this.commit());
  }

  readInk() {
    const style = getComputedStyle(this.root);
    const of = (name) => style.getPropertyValue(name).trim();
    const { colours } = this.header;
    this.ink = {
      text: of("--ink"),
      muted: this.resolved("var(--muted)"),
      line: this.resolved("var(--line)"),
      font: style.fontFamily,
      mark: this.resolved("var(--accent)"),
      wall: colours.evidenceWall,
      free: colours.evidenceFree,
    };
  }

  // A canvas cannot read color-mix() through a variable: let the page work it out.
  resolved(colour) {
    const probe = element("i", { hidden: "" });
    probe.style.color = colour;
    this.root.append(probe);
    const value = getComputedStyle(probe).color;
    probe.remove();
    return value;
  }

  // ---- events --------------------------------------------------------------------

  listen() {
    const { root } = this;
    const actions = {
      restart: () => this.walkTo(0),
      back: () => this.walkTo(this.state.step - 1),
      play: () => this.toggle(),
      forward: () => this.walkTo(this.state.step + 1),
      unpin: () => this.unpin(),
    };
    for (const button of root.querySelectorAll("[data-do]")) {
      button.addEventListener("click", () => this.model && actions[button.dataset.do]());
    }
    root.addEventListener("keydown", (event) => this.onKey(event));
    for (const tab of root.querySelectorAll("[data-tab]")) {
      tab.addEventListener("click", () => this.showTab(tab.dataset.tab));
    }
    this.listenToTransport();
    this.listenToPrior();
    this.listenToStage();
    this.listenToTerms();
  }

  listenToTransport() {
    const scrub = this.part("scrub");
    scrub.addEventListener("input", () => {
      this.pause(false);
      this.goTo(Number(scrub.value));
    });
    scrub.addEventListener("change", () => this.commit(COMMIT_DELAY));
    this.part("speed").addEventListener("change", (event) => {
      this.state.speed = Number(event.target.value);
      this.commit();
    });
  }

  listenToPrior() {
    for (const name of ["p_wall", "p_space"]) {
      const input = this.root.querySelector(`[data-slider=${name}] input`);
      input.addEventListener("input", () => {
        this.state[name] = Number(input.value);
        this.recolour();
      });
      input.addEventListener("change", () => this.commit(COMMIT_DELAY));
    }
    this.part("uninformative").addEventListener("change", (event) => {
      this.state.uninformative = event.target.checked;
      this.recolour();
      this.commit();
    });
  }

  listenToStage() {
    for (const canvas of this.root.querySelectorAll(".pane canvas")) {
      canvas.addEventListener("pointermove", (event) => {
        if (event.pointerType !== "touch") this.hoverAt(event);
      });
      canvas.addEventListener("pointerleave", () => this.leave());
      canvas.addEventListener("blur", () => this.leave());
      canvas.addEventListener("click", (event) => this.clickAt(event));
    }
  }

  listenToTerms() {
    const { canvas } = this.terms;
    canvas.addEventListener("click", (event) => {
      const bar = this.terms.barAt(event);
      if (bar) this.walkTo(bar.term ? bar.term.reading + 1 : 0);
    });
    canvas.addEventListener("pointermove", (event) => this.hoverTerm(event));
    canvas.addEventListener("pointerleave", () => this.hideCard());
  }

  onKey(event) {
    if (!this.model || event.ctrlKey || event.metaKey || event.altKey) return;
    const inside = event.target;
    const ownKeys = inside.matches("select, input:not(.scrub)");
    const reach = event.shiftKey ? 10 : 1;
    const moves = {
      ArrowLeft: () => this.walkTo(this.state.step - reach),
      ArrowRight: () => this.walkTo(this.state.step + reach),
      Home: () => this.walkTo(0),
      End: () => this.walkTo(this.model.nReadings),
      Escape: () => this.unpin(),
      " ": () => this.toggle(),
    };
    const pressed = event.key === " " && inside.matches("button");
    if (inside === this.stage.canvases.map && this.inspect(event)) return;
    if (!moves[event.key] || pressed || (ownKeys && event.key !== "Escape")) return;
    event.preventDefault();
    event.stopPropagation();
    moves[event.key]();
  }

  // On the map canvas, reached by Tab, arrows walk from cell to cell and Enter pins.
  inspect(event) {
    const { stage, model } = this;
    const moves = {
      ArrowLeft: -1, ArrowRight: 1, ArrowUp: -model.nCols, ArrowDown: model.nCols, Enter: 0,
    };
    if (!(event.key in moves)) return false;
    event.preventDefault();
    event.stopPropagation();
    const from = stage.hover ?? stage.pin ?? Math.floor(model.nCells / 2);
    if (event.key === "Enter") {
      this.pin(from);
      return true;
    }
    const to = from + moves[event.key];
    const leavesRow = Math.abs(moves[event.key]) === 1
      && Math.floor(to / model.nCols) !== Math.floor(from / model.nCols);
    if (to >= 0 && to < model.nCells && !leavesRow) this.hoverOn(to, stage.pointAt(to));
    return true;
  }

  // ---- playback ------------------------------------------------------------------

  play() {
    if (this.playing || !this.model) return;
    if (this.state.step >= this.model.nReadings) this.goTo(0);
    this.position = this.state.step;
    this.playing = true;
    this.showPlaying();
    let then = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      this.advance(Math.min(0.1, (now - then) / 1000));
      then = now;
      this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  advance(seconds) {
    const last = this.model.nReadings;
    this.position += seconds * this.state.speed;
    if (this.position < last) {
      this.goTo(Math.floor(this.position), this.position);
      return;
    }
    this.goTo(last, this.position);
    if (!this.state.compact) this.pause();
    else if (this.position > last + LOOP_PAUSE * this.state.speed) this.goTo(0);
  }

  pause(tell = true) {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.frame);
    this.showPlaying();
    if (tell) this.commit();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  showPlaying() {
    const button = this.root.querySelector("[data-do=play]");
    button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    this.root.dataset.playing = this.playing ? "1" : "0";
  }

  // A step by hand: stops the replay, and Python hears of it.
  walkTo(step) {
    this.pause(false);
    this.goTo(step);
    this.commit(COMMIT_DELAY);
  }

  goTo(step, position = step) {
    const target = Math.min(this.model.nReadings, Math.max(0, step));
    this.position = position;
    if (target === this.state.step && target === this.model.step) return;
    this.state.step = target;
    this.stage.paintEntries(this.model.seek(target));
    this.refresh();
  }

  // ---- the prior and the choices ---------------------------------------------------

  // After a change of prior, rule, overlay or region: all cells and all curves anew.
  recolour() {
    const { state, model, stage } = this;
    if (!model) return;
    const began = performance.now();
    model.setPrior({
      pWall: state.p_wall,
      pSpace: state.p_space,
      uninformative: state.uninformative,
      once: state.rule === "prior_once",
    });
    const allCells = state.region === "all";
    this.curves = model.scoreCurves(allCells);
    this.series = scoreSeries(this.curves, model.nCells);
    stage.overlay = state.overlay;
    stage.allCells = allCells;
    stage.paintAll();
    this.showPrior();
    this.showLegend();
    this.refresh();
    this.root.dataset.recolourMs = (performance.now() - began).toFixed(2);
  }

  showChoices() {
    for (const name of ["rule", "overlay", "region"]) {
      for (const input of this.root.querySelectorAll(`input[name=${name}]`)) {
        input.checked = input.value === this.state[name];
      }
    }
    this.part("uninformative").checked = this.state.uninformative;
    for (const name of ["p_wall", "p_space"]) {
      const input = this.root.querySelector(`[data-slider=${name}] input`);
      Object.assign(input, this.header.limits[name]);
      input.value = this.state[name];
    }
  }

  showPrior() {
    const { state } = this;
    for (const name of ["p_wall", "p_space"]) {
      const box = this.root.querySelector(`[data-slider=${name}]`);
      const input = box.querySelector("input");
      input.disabled = state.uninformative;
      box.classList.toggle("off", state.uninformative);
      box.querySelector("output").textContent = state[name].toFixed(2);
      const p = this.model.pFreePrior[name === "p_wall" ? 1 : 0];
      box.querySelector("small").textContent = state.uninformative
        ? "p_free = 0.5"
        : `p_free = ${this.model.scale} \u00d7 ${state[name].toFixed(2)} = ${p.toFixed(3)}`;
    }
  }

  showLegend() {
    const part = this.part("map-legend");
    if (this.state.overlay === "errors") {
      const keys = this.header.texts.errors.map(({ mark, label }) =>
        element("span", { class: "key" }, element("i", { class: `mark-${mark}` }), label),
      );
      part.replaceChildren(...keys);
      return;
    }
    const ramp = element("span", { class: "key ramp" }, "p_free 0", element("i", { class: "mark-ramp" }), "1");
    const overlay = this.header.texts.overlays.find((o) => o.value === this.state.overlay);
    const keys = this.state.overlay === "none"
      ? []
      : [element("span", { class: "key" }, element("i", { class: `mark-${overlay.value}` }), overlay.label)];
    part.replaceChildren(...keys, ramp);
  }

  // ---- what changes with the step --------------------------------------------------

  refresh() {
    if (!this.model || !this.curves) return;
    const began = performance.now();
    this.stage.draw();
    this.showTransport();
    if (!this.state.compact) {
      if (this.tab === "scores") this.showScores();
      else this.showCell();
      this.report();
    }
    this.root.dataset.drawMs = (performance.now() - began).toFixed(2);
  }

  showTransport() {
    const { step } = this.state;
    const last = this.model.nReadings;
    const scrub = this.part("scrub");
    scrub.value = step;
    scrub.style.setProperty("--done", `${(100 * step) / Math.max(1, last)}%`);
    scrub.setAttribute("aria-valuetext", `reading ${step} of ${last}`);
    this.part("counter").textContent = `reading ${step} of ${last}`;
  }

  showScores() {
    const { step } = this.state;
    for (const { name, value, curve } of this.tiles) {
      value.textContent = percent(this.series[name][step]);
      drawCurve(curve, this.series[name], step, this.ink);
    }
  }

  // For tests: what the player holds, readable from outside.
  report() {
    const { step } = this.state;
    const [tp, fp, fn, tn] = this.curves.counts.map((curve) => curve[step]);
    Object.assign(this.root.dataset, {
      tp, fp, fn, tn, step,
      explored: this.curves.explored[step],
      nReadings: this.model.nReadings,
      rev: this.header.document.rev,
      pWall: this.state.p_wall,
      pSpace: this.state.p_space,
    });
  }

  resize() {
    if (!this.model) return;
    this.stage.layout();
    this.refresh();
  }

  // ---- one cell --------------------------------------------------------------------

  hoverAt(event) {
    const cell = this.stage.cellAt(event);
    if (!this.state.compact && cell !== null) this.hoverOn(cell, event);
  }

  hoverOn(cell, point) {
    const moved = cell !== this.stage.hover;
    this.stage.hover = cell;
    if (moved) this.stage.draw();
    this.showCard(point, this.cellTitle(cell), this.cellFacts(cell));
  }

  leave() {
    if (!this.model) return;
    this.hideCard();
    this.stage.hover = null;
    this.stage.draw();
  }

  clickAt(event) {
    const cell = this.stage.cellAt(event);
    this.root.focus({ preventScroll: true });
    if (!this.state.compact && cell !== null) this.pin(cell);
  }

  // Pinning the pinned cell again unpins it.
  pin(cell) {
    if (cell === this.stage.pin) {
      this.unpin();
      return;
    }
    this.stage.pin = cell;
    this.rememberPin();
    this.showTab("cell");
    this.stage.draw();
    this.commit(COMMIT_DELAY);
  }

  unpin() {
    if (this.stage.pin === null) return;
    this.stage.pin = null;
    this.rememberPin();
    this.showTab("scores");
    this.stage.draw();
    this.commit(COMMIT_DELAY);
  }

  // The pin is kept in px of the drawing, so that it survives another cell size.
  rememberPin() {
    if (this.stage.pin === null) {
      this.state.pin_px = null;
      return;
    }
    const { x, y, side } = this.stage.cellBox(this.stage.pin);
    this.state.pin_px = [x + side / 2, y + side / 2];
  }

  restorePin() {
    const { pin_px: point } = this.state;
    this.stage.pin = point ? this.stage.cellHolding(...point) : null;
    if (this.stage.pin !== null) this.showTab("cell");
  }

  cellTitle(c) {
    const { nCols } = this.model;
    return `Cell row ${Math.floor(c / nCols)}, column ${c % nCols}`;
  }

  cellFacts(c) {
    const { model } = this;
    const l = model.mapLogOdds(c);
    const p = pFreeOf(l);
    return [
      ["class", model.isWall[c] ? "wall cell" : "space cell"],
      ["truth", model.truth[c] ? "wall" : "free"],
      ["prior p_free", model.pFreePrior[model.isWall[c]].toFixed(3)],
      ["readings k", String(model.counts[c])],
      ["log-odds l", signed(l, 3)],
      ["declared", model.isOccupied(c) ? "wall" : "no wall"],
      ["p_free", probability(p)],
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
    this.part("regions").hidden = name !== "scores";
    this.part("axis-name").hidden = name !== "cell";
    this.refresh();
  }

  showCell() {
    const { pin } = this.stage;
    this.root.querySelector("[data-panel=cell]").dataset.pinned = pin === null ? "0" : "1";
    if (pin === null) return;
    const history = this.model.history(pin);
    this.part("cell-name").textContent = this.cellTitle(pin);
    this.part("cell-facts").replaceChildren(...rows(this.cellFacts(pin)));
    this.terms.draw(history, this.state.step, this.ink);
    this.root.dataset.terms = history.terms.length;
  }

  hoverTerm(event) {
    const bar = this.terms.barAt(event);
    if (!bar) {
      this.hideCard();
      return;
    }
    this.showCard(event, ...this.termCard(bar));
  }

  termCard({ term, to }) {
    const l0 = this.model.logOddsPrior[this.model.isWall[this.stage.pin]];
    if (!term) return ["Prior", [["l_0", signed(to, 3)], ["p_free", probability(pFreeOf(to))]]];
    const said = [["p_free(reading)", probability(pFreeOf(term.said))], ["its log-odds", signed(term.said, 3)]];
    const less = this.model.once ? [] : [["less l_0", signed(-l0, 3)]];
    return [
      `Reading ${term.reading + 1}`,
      [...said, ...less, ["adds", signed(term.added, 3)], ["then l", signed(term.total, 3)]],
    ];
  }

  // ---- the card at the pointer -------------------------------------------------------

  showCard(event, title, facts) {
    const card = this.root.querySelector(".card");
    card.replaceChildren(element("b", {}, title), element("dl", {}, ...rows(facts)));
    card.hidden = false;
    const box = this.root.getBoundingClientRect();
    const x = event.clientX - box.left;
    const y = event.clientY - box.top;
    const { offsetWidth: width, offsetHeight: height } = card;
    const left = x + 18 + width < box.width ? x + 18 : x - 18 - width;
    const top = y + 14 + height < box.height ? y + 14 : y - 14 - height;
    card.style.transform = `translate(${Math.max(0, left)}px, ${Math.max(0, top)}px)`;
  }

  hideCard() {
    this.root.querySelector(".card").hidden = true;
  }

  dispose() {
    this.pause(false);
    clearTimeout(this.commitTimer);
    this.load++;
    this.observer.disconnect();
    this.stage?.dispose();
  }
}

export default function ({ data, parentElement, setStateValue }) {
  const root = parentElement.querySelector(".player");
  root.player ??= new Player(root);
  root.player.receive(data, setStateValue);
  return () => root.player.dispose();
}
