// Two predictions: asked once, kept, and shown again with what comes out.

const ANSWERS = {
  silent: { yes: "yes, it can", no: "no, it cannot" },
  second: { both: "in both", p: "only in p", l: "only in l", neither: "in neither" },
};

function buildPredictions(p) {
  for (const [name, answers] of Object.entries(ANSWERS)) {
    const buttons = Object.entries(answers).map(([value, label]) => {
      const button = element("button", { type: "button" }, label);
      button.addEventListener("click", () => answer(p, name, value));
      return button;
    });
    partOf(p.root, `${name}-answers`).append(...buttons);
  }
}

function answer(p, name, value) {
  p.state[name] = value;
  showPredictions(p);
  // The buttons go; who used the keyboard goes on from the result.
  partOf(p.root, `${name}-result`).focus({ preventScroll: true });
  commit(p);
}

function showPredictions(p) {
  const results = { silent: silentWords, second: secondWords };
  for (const [name, answers] of Object.entries(ANSWERS)) {
    const said = p.state[name];
    partOf(p.root, `${name}-answers`).hidden = said !== "";
    partOf(p.root, `${name}-result`).hidden = said === "";
    if (said) setText(partOf(p.root, `${name}-result`), `You said: ${answers[said]}. ${results[name](p)}`);
  }
}

// The cells in view that hold both and whose reading moves nothing.
function silentCells({ cells, constants }) {
  return [...cells.empty.keys()].filter((c) => {
    const { which, logOdds } = saidOf(cells.empty[c], cells.object[c], constants);
    return which === 2 && logOdds === 0;
  });
}

function silentWords(p) {
  const { cells } = p;
  const silent = silentCells(p);
  if (!silent.length) return "From here no cell that holds both says nothing: move or turn the robot until one does.";
  const c = silent[0];
  const place = `row ${Math.floor(c / cells.nCols)}, column ${c % cells.nCols}`;
  const more = silent.length > 1 ? `, as do ${silent.length - 1} more` : "";
  const n = cells.empty[c];
  return `It can: from here the cell in ${place} says nothing${more}. It has ${n} empty and ${n} object pixels.`;
}

// The first and the second of two equal readings that say empty, in p and in l.
function secondSteps({ state, constants }) {
  const after = (chips) => totalOf({ ...state, chips }, constants);
  const l = [after([]), after(["e"]), after(["e", "e"])];
  const steps = (values) => [values[1] - values[0], values[2] - values[1]];
  return { l: steps(l), p: steps(l.map(pFreeOf)) };
}

function secondWords(p) {
  const { l, p: inP } = secondSteps(p);
  const [first, second] = inP.map((step) => signed(step, 3));
  const isSame = Math.abs(inP[0] - inP[1]) < 5e-4;
  return (
    `From the prior ${p.state.prior.toFixed(2)}, two empty readings move l by ${signedOrZero(l[0])} each` +
    (isSame
      ? `, and p by ${first} each: from this prior they happen to be equal in p as well.`
      : `, but p by ${first} and then by ${second}.`)
  );
}
