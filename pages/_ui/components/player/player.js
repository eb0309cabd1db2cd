// Wiring: what the student does, what is drawn again, and what Python hears of it.
//
// Python owns a document {rev, ...}. The player takes it over when it starts or when rev
// changes; from then on the student's hand rules, and every commit echoes rev.

// By key: what a player that the page unmounted showed, and what Python knows of it.
const remembered = new Map();

class Player {
  constructor(root) {
    this.root = root;
    this.model = null;
    this.load = 0;
    this.tiles = [];
    this.playback = new Playback(this);
    this.controls = new Controls(this);
    this.inspector = new Inspector(this);
    this.listen();
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(root);
  }

  part(name) {
    return this.root.querySelector(`[data-part=${name}]`);
  }

  listen() {
    const actions = {
      restart: () => this.walkTo(0),
      back: () => this.walkTo(this.state.step - 1),
      play: () => this.playback.toggle(),
      forward: () => this.walkTo(this.state.step + 1),
      unpin: () => this.inspector.unpin(),
    };
    for (const button of this.root.querySelectorAll("[data-do]")) {
      button.addEventListener(
        "click",
        () => this.model && actions[button.dataset.do](),
      );
    }
    this.root.addEventListener("keydown", (event) => this.onKey(event));
  }

  onKey(event) {
    if (!this.model || event.ctrlKey || event.metaKey || event.altKey) return;
    const { target } = event;
    if (target === this.stage.canvases.map && this.inspector.onKey(event)) {
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    const reach = event.shiftKey ? 10 : 1;
    const moves = {
      ArrowLeft: () => this.walkTo(this.state.step - reach),
      ArrowRight: () => this.walkTo(this.state.step + reach),
      Home: () => this.walkTo(0),
      End: () => this.walkTo(this.model.nReadings),
      Escape: () => this.inspector.unpin(),
      " ": () => this.playback.toggle(),
    };
    // Sliders, options and buttons keep the keys that are theirs.
    const theirs =
      (target.matches("select, input:not(.scrub)") && event.key !== "Escape") ||
      (target.matches("button") && event.key === " ");
    if (!moves[event.key] || theirs) return;
    event.preventDefault();
    event.stopPropagation();
    moves[event.key]();
  }

  // ---- from Python -----------------------------------------------------------------

  async receive(data, send) {
    this.send = send;
    if (!data) return;
    const [header, replay] = readPacked(data);
    const sameDocument = this.header?.document.rev === header.document.rev;
    const sameReplay = this.header?.digest === header.digest;
    if (!this.stage) this.start(header);
    this.header = header;
    if (!sameDocument) this.adopt(header);
    remembered.get(header.key).digest = header.digest;
    if (!sameReplay) await this.replace(replay);
    else if (!sameDocument) this.restore();
    else this.retheme();
  }

  start(header) {
    this.stage = new Stage(this.root, header.colours);
    this.root.classList.toggle("compact", header.document.compact);
    this.controls.build(header);
    this.playback.offerSpeeds(header.speeds);
    this.buildTiles(header.texts.scores);
    for (const [name, value] of Object.entries(header.colours)) {
      this.root.style.setProperty(`--colour-${name}`, value);
    }
  }

  // A remount without word from Python goes on where this player was. While it plays
  // nothing is sent, so that Python's word may be the step at which Play was pressed:
  // where that is all it knows of the same replay, the step that was shown counts.
  adopt(header) {
    const isNew = !this.state;
    const known = remembered.get(header.key);
    if (known && known.state.rev === header.document.rev) {
      this.state = known.state;
      return;
    }
    this.state = { ...header.document };
    const stale =
      isNew &&
      known?.digest === header.digest &&
      known.toldStep === header.document.step;
    if (stale) this.state.step = known.state.step;
    const toldStep = header.document.step;
    remembered.set(header.key, { state: this.state, toldStep });
  }

  // A running replay stops where it is: what was played is no more.
  async replace(replay) {
    const stopped = this.playback.playing;
    this.playback.pause(false);
    const load = ++this.load;
    const decoded = decodeReplay((await inflated(replay)).buffer);
    const preview = await decodePreview(decoded.preview);
    if (load !== this.load) return; // newer data is on its way
    this.model = new MapModel(decoded, this.header.constants);
    this.root.model = this.model;
    this.inspector.hideCard();
    this.stage.show(this.model, preview);
    this.restore();
    this.root.dataset.ready = "1";
    if (stopped) this.commit();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (this.state.compact && !still) this.playback.play();
  }

  // Everything on screen from the state.
  restore() {
    if (!this.model) return;
    this.state.step = Math.min(this.state.step, this.model.nReadings);
    this.readInk();
    this.controls.restore();
    this.playback.restore();
    this.inspector.restore();
    this.model.seek(this.state.step);
    this.recolour();
  }

  retheme() {
    this.readInk();
    this.refresh();
  }

  // ---- to Python -------------------------------------------------------------------

  commit(delay = 0) {
    if (this.state.compact) return;
    clearTimeout(this.commitTimer);
    const tell = () => {
      remembered.get(this.header.key).toldStep = this.state.step;
      this.send("committed", { ...this.state });
    };
    this.commitTimer = setTimeout(tell, delay);
  }

  // ---- scores ----------------------------------------------------------------------

  buildTiles(scores) {
    const panel = this.root.querySelector("[data-panel=scores]");
    for (const { name, label, about } of scores) {
      const value = element("output");
      const naming = { role: "img", "aria-label": `${label} over the readings` };
      const curve = element("canvas", naming);
      const head = element(
        "div",
        { class: "tile-head" },
        element("b", {}, label),
        value,
      );
      const tile = { class: "tile", "data-score": name };
      panel.append(element("div", tile, head, curve, element("small", {}, about)));
      this.scrubOn(curve);
      this.tiles.push({ name, value, curve });
    }
  }

  scrubOn(curve) {
    const go = (event) => this.goTo(stepAtCurve(curve, event, this.model.nReadings));
    curve.addEventListener("pointerdown", (event) => {
      this.playback.pause(false);
      curve.setPointerCapture(event.pointerId);
      go(event);
    });
    curve.addEventListener("pointermove", (event) => {
      if (curve.hasPointerCapture(event.pointerId)) go(event);
    });
    curve.addEventListener("pointerup", () => this.commit());
  }

  showScores() {
    const { step } = this.state;
    for (const { name, value, curve } of this.tiles) {
      value.textContent = percent(this.series[name][step]);
      drawCurve(curve, this.series[name], step, this.ink);
    }
  }

  // Colours of the page's theme, for the canvases.
  readInk() {
    const { colours } = this.header;
    const { evidenceWall: wall, evidenceFree: free } = colours;
    this.ink = { ...themeOf(this.root), wall, free };
  }

  // ---- what is drawn again -----------------------------------------------------------

  // A step by hand: stops the replay, and Python hears of it.
  walkTo(step) {
    this.playback.pause(false);
    this.goTo(step);
    this.commit(COMMIT_DELAY);
  }

  goTo(step, position = step) {
    const target = Math.min(this.model.nReadings, Math.max(0, step));
    this.playback.position = position;
    if (target === this.state.step && target === this.model.step) return;
    this.state.step = target;
    this.stage.cells.paintEntries(this.model.seek(target));
    this.refresh();
  }

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
    stage.cells.paintAll(state.overlay, allCells);
    this.controls.show();
    this.refresh();
    this.root.dataset.recolourMs = (performance.now() - began).toFixed(2);
  }

  refresh() {
    if (!this.model || !this.curves) return;
    const began = performance.now();
    this.stage.draw();
    this.playback.show();
    if (!this.state.compact) {
      if (this.inspector.tab === "scores") this.showScores();
      else this.inspector.show();
      this.report();
    }
    this.root.dataset.drawMs = (performance.now() - began).toFixed(2);
  }

  // For tests: what the player holds, readable from outside.
  report() {
    const { state, model, curves } = this;
    const { step } = state;
    const [tp, fp, fn, tn] = curves.counts.map((curve) => curve[step]);
    const { rev } = this.header.document;
    const held = { tp, fp, fn, tn, step, rev, explored: curves.explored[step] };
    Object.assign(this.root.dataset, held, {
      nReadings: model.nReadings,
      pWall: state.p_wall,
      pSpace: state.p_space,
    });
  }

  resize() {
    if (!this.model) return;
    this.stage.layout();
    this.refresh();
  }

  dispose() {
    this.playback.pause(false);
    clearTimeout(this.commitTimer);
    this.load++;
    this.observer.disconnect();
    this.stage?.dispose();
    this.model = null;
  }
}

export default function ({ data, parentElement, setStateValue }) {
  const root = parentElement.querySelector(".player");
  root.player ??= new Player(root);
  root.player.receive(data, setStateValue);
  return () => root.player.dispose();
}
