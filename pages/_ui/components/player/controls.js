// One map's controls: the prior, the update rule, and what the map shows.

const SLIDERS = { p_space: 0, p_wall: 1 }; // with the class of their cells
const OPTIONS = { rule: "rules", overlay: "overlays" };

const sliderOf = (p, name) => p.root.querySelector(`[data-slider=${name}]`);

// Rule and prior are the first map's; what is shown holds for all.
const holderOf = ({ state }, name) => (name === "overlay" ? state : state.columns[0]);

function buildControls(p, { texts, limits }) {
  for (const name of Object.keys(SLIDERS)) {
    const input = sliderOf(p, name).querySelector("input");
    Object.assign(input, limits[name]);
    input.addEventListener("input", () => {
      Object.assign(p.state.columns[0], movedTo(p, name, Number(input.value)));
      recolour(p);
    });
    input.addEventListener("change", () => commit(p, COMMIT_DELAY));
  }
  partOf(p.root, "uninformative").addEventListener("change", (event) => {
    choose(p, "uninformative", event.target.checked);
  });
  for (const [name, part] of Object.entries(OPTIONS)) {
    const options = texts[part].map((option) => radio(p, name, option));
    partOf(p.root, part).append(...options);
  }
}

function radio(p, name, { value, label, about }) {
  const input = element("input", { type: "radio", name, value });
  input.addEventListener("change", () => choose(p, name, value));
  const words = element("span", {}, label);
  if (about) words.append(element("small", {}, ...maths(about)));
  return element("label", {}, input, words);
}

function choose(p, name, value) {
  holderOf(p, name)[name] = value;
  recolour(p);
  commit(p);
}

function showControls(p) {
  const { root, state } = p;
  for (const name of Object.keys(OPTIONS)) {
    for (const input of root.querySelectorAll(`input[name=${name}]`)) {
      input.checked = input.value === holderOf(p, name)[name];
    }
  }
  partOf(root, "uninformative").checked = state.columns[0].uninformative;
  partOf(root, "overlay").value = state.overlay;
  for (const name of Object.keys(SLIDERS)) showSlider(p, name);
  const keys = state.overlay === "errors" ? errorKeys(p) : beliefKeys(p);
  p.legend.replaceChildren(...keys, legendKey("hatch", "not looked at"));
}

function showSlider(p, name) {
  const [setting] = p.state.columns;
  const [column] = p.columns;
  const box = sliderOf(p, name);
  const pFree = column.pFreePrior[SLIDERS[name]];
  const chosen = setting[name].toFixed(2);
  const factors = `${column.priorScale} \u00d7 ${chosen} = ${pFree.toFixed(3)}`;
  const { uninformative } = setting;
  Object.assign(box.querySelector("input"), { value: setting[name], disabled: uninformative || isLocked(p, name) });
  box.classList.toggle("off", uninformative);
  box.querySelector(".value").textContent = chosen;
  box.querySelector("small").replaceChildren(...maths(`p_free = ${uninformative ? pFree : factors}`));
}

const errorKeys = ({ header }) =>
  header.texts.errors.map(({ mark, label }) => legendKey(mark, label));

function beliefKeys({ header, state: { overlay } }) {
  const ramp = legendKey("ramp", "1");
  ramp.prepend(element("span", {}, ...maths("p_free 0")));
  if (overlay === "none") return [ramp];
  const { label } = header.texts.overlays.find(({ value }) => value === overlay);
  return [legendKey(overlay, label), ramp];
}
