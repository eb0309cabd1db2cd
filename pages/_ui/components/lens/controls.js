// Settings of the sensor and of the cells, the update rule, and the readings that add up.

const CHOICES = {
  behind: [["occupied", "object"], ["unseen", "not seen"]],
  clear: [["1", "clears its pixels"], ["0", "says nothing"]],
  rule: [["prior_once", "Count the drawing once"], ["subtract_prior", "Take it off at every reading"]],
};
const SLIDERS = { range: " px", fov: "\u00b0" };

function buildControls(p) {
  const sizes = p.header.cellSizes.map((size) => [String(size), String(size)]);
  for (const [name, choices] of Object.entries({ ...CHOICES, size: sizes })) {
    partOf(p.root, name).append(...choices.map((choice) => radio(p, name, ...choice)));
  }
  for (const name of Object.keys(SLIDERS)) {
    const input = partOf(p.root, name);
    const [min, max] = p.header.limits[name];
    Object.assign(input, { min, max, step: 1 });
    input.addEventListener("input", () => setSensor(p, { [name]: Number(input.value) }));
    input.addEventListener("change", () => commit(p, COMMIT_DELAY));
  }
  buildChips(p);
}

function radio(p, name, value, label) {
  const input = element("input", { type: "radio", name, value });
  input.addEventListener("change", () => {
    if (name === "rule") {
      p.state.rule = value;
      showAdding(p);
      commit(p, 0, sumWords);
    } else {
      setSensor(p, name === "size" ? resized(p.state, Number(value)) : { [name]: value });
      commit(p);
    }
  });
  return element("label", {}, input, element("span", {}, label));
}

function setSensor(p, changes) {
  Object.assign(p.state, changes);
  requestShow(p);
}

function showControls({ root, state }) {
  for (const name of [...Object.keys(CHOICES), "size"]) {
    for (const input of partOf(root, name).querySelectorAll("input")) {
      input.checked = input.value === String(state[name]);
    }
  }
  for (const [name, unit] of Object.entries(SLIDERS)) {
    partOf(root, name).value = state[name];
    setText(partOf(root, `${name}-value`), `${state[name]}${unit}`);
  }
}

function buildChips(p) {
  const readCell = () => {
    const { empty, object } = selectedOf(p);
    return [...p.state.chips, `${empty}.${object}`];
  };
  const actions = {
    "read-empty": () => [...p.state.chips, "e"],
    "read-object": () => [...p.state.chips, "o"],
    "read-cell": readCell,
    undo: () => p.state.chips.slice(0, -1),
    turn: () => turned(p.state.chips),
  };
  for (const [name, act] of Object.entries(actions)) {
    partOf(p.root, name).addEventListener("click", () => {
      p.state.chips = act();
      showAdding(p);
      showCell(p);
      commit(p, 0, sumWords);
    });
  }
}

// The readings in their order, in words.
function showChips({ root, state, header }) {
  const words = state.chips.map((chip) => ({ e: "empty", o: "object" })[chip] ?? chip.replace(".", " : "));
  const most = words.length < header.maxChips ? "" : ` (${header.maxChips} at most)`;
  setText(partOf(root, "chips"), words.length ? words.join(", ") + most : "none yet");
}
