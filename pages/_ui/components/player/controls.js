// The prior, the update rule, what the map shows and which cells are scored.

const SLIDERS = ["p_wall", "p_space"];

class Controls {
  constructor(player) {
    this.player = player;
    this.root = player.root;
    this.listen();
  }

  slider(name) {
    return this.root.querySelector(`[data-slider=${name}] input`);
  }

  listen() {
    const { player } = this;
    for (const name of SLIDERS) {
      const input = this.slider(name);
      input.addEventListener("input", () => {
        player.state[name] = Number(input.value);
        player.recolour();
      });
      input.addEventListener("change", () => player.commit(COMMIT_DELAY));
    }
    player.part("uninformative").addEventListener("change", (event) => {
      this.choose("uninformative", event.target.checked);
    });
  }

  choose(name, value) {
    this.player.state[name] = value;
    this.player.recolour();
    this.player.commit();
  }

  build({ texts, limits }) {
    this.texts = texts;
    const fill = (part, name, options) => {
      const choices = options.map((o) => radio(name, o, (v) => this.choose(name, v)));
      this.player.part(part).append(...choices);
    };
    fill("rules", "rule", texts.rules);
    fill("overlays", "overlay", texts.overlays);
    fill("regions", "region", texts.regions);
    for (const name of SLIDERS) Object.assign(this.slider(name), limits[name]);
  }

  restore() {
    const { state } = this.player;
    for (const name of ["rule", "overlay", "region"]) {
      for (const input of this.root.querySelectorAll(`input[name=${name}]`)) {
        input.checked = input.value === state[name];
      }
    }
    for (const name of SLIDERS) this.slider(name).value = state[name];
    this.player.part("uninformative").checked = state.uninformative;
  }

  show() {
    for (const name of SLIDERS) this.showPrior(name);
    this.showLegend();
  }

  showPrior(name) {
    const { state, model } = this.player;
    const box = this.root.querySelector(`[data-slider=${name}]`);
    const p = model.pFreePrior[name === "p_wall" ? 1 : 0];
    const chosen = state[name].toFixed(2);
    this.slider(name).disabled = state.uninformative;
    box.classList.toggle("off", state.uninformative);
    box.querySelector("output").textContent = chosen;
    box.querySelector("small").textContent = state.uninformative
      ? `p_free = ${p}`
      : `p_free = ${model.scale} \u00d7 ${chosen} = ${p.toFixed(3)}`;
  }

  showLegend() {
    const { overlay } = this.player.state;
    const key = (mark, label) =>
      element("span", { class: "key" }, element("i", { class: `mark-${mark}` }), label);
    const keys = [];
    if (overlay === "errors") {
      keys.push(...this.texts.errors.map(({ mark, label }) => key(mark, label)));
    } else {
      const shown = this.texts.overlays.find(({ value }) => value === overlay);
      if (overlay !== "none") keys.push(key(overlay, shown.label));
      const ramp = key("ramp", "1");
      ramp.prepend("p_free 0");
      keys.push(ramp);
    }
    this.player.part("map-legend").replaceChildren(...keys);
  }
}
