// Several maps: the bar above them, with examples, what is shown and the number of maps;
// and the question that is asked before the robot drives.

// The examples and the answers to the question; a lesson has others.
function offer(p, { presets, answers }) {
  const offered = JSON.stringify([presets, answers]);
  if (offered === p.offered) return; // a button that has the focus stays
  p.offered = offered;
  const buttons = presets.map(({ label, columns }) => {
    const button = element("button", { type: "button", class: "preset" }, label);
    button.addEventListener("click", () => showExample(p, columns));
    return button;
  });
  partOf(p.root, "presets").replaceChildren(...buttons);
  offerAnswers(p, answers);
}

function buildBar(p, { texts }) {
  const overlay = partOf(p.root, "overlay");
  overlay.append(...texts.overlays.map(({ value, label }) => element("option", { value }, label)));
  overlay.addEventListener("change", () => choose(p, "overlay", overlay.value));
  const third = partOf(p.root, "third");
  third.addEventListener("click", () => {
    const { columns } = p.state;
    const last = columns[columns.length - 1];
    setColumns(p, columns.length > 2 ? columns.slice(0, 2) : [...columns, { ...last }]);
  });
}

function setColumns(p, columns) {
  p.state.columns = columns.map((column) => ({ ...column }));
  p.byHand = [];
  p.open = null;
  pause(p);
  if (recolour(p)) commit(p);
}

// An example starts before the first reading, with the question.
function showExample(p, columns) {
  p.state.predicted = null;
  setColumns(p, columns);
  goTo(p, 0);
}

function showBar(p) {
  if (!isSeveral(p)) return;
  const n = p.state.columns.length;
  setText(partOf(p.root, "third"), n > 2 ? "Remove map C" : "Add a third map");
  showHeaders(p);
  buildPairing(p);
}

// ---- the question ------------------------------------------------------------------------

const ALIKE = 3; // the answer that no map finds more

function offerAnswers(p, answers) {
  const buttons = answers.map(({ value, label }) => {
    const button = element("button", { type: "button", class: "preset", "data-answer": value }, label);
    button.addEventListener("click", () => {
      p.state.predicted = value;
      refresh(p);
      commit(p);
      play(p);
    });
    return button;
  });
  partOf(p.root, "answers").replaceChildren(...buttons);
}

// Asked before the first reading; then the walls found so far, beside what was said.
function showQuestion(p) {
  const { predicted, step } = p.state;
  const buttons = partOf(p.root, "answers").children;
  const isAsked = predicted === null && step === 0 && buttons.length > 0;
  for (const button of buttons) {
    const answer = Number(button.dataset.answer);
    button.hidden = !isAsked || (answer !== ALIKE && answer >= p.columns.length);
  }
  setText(partOf(p.root, "question"), isAsked ? QUESTION : foundWords(p, predicted, step));
}

const QUESTION = "Before it drives: which map will find more of the walls that the robot looks at?";

function foundWords(p, predicted, step) {
  const found = p.columns.map(({ curves }, i) => {
    const [hits, , missed] = curves.looked.counts.map((count) => count[step]);
    return `${LETTERS[i]} finds ${grouped(hits)} of ${grouped(hits + missed)}`;
  });
  const said = predicted === ALIKE ? "none more than another" : LETTERS[predicted];
  return `${predicted === null ? "" : `You said: ${said}. `}Of the walls looked at, ${found.join(", ")}.`;
}
