// What the player tells Python, and a screen reader.

function commit(p, delay = 0) {
  clearTimeout(p.commitTimer);
  p.commitTimer = setTimeout(() => {
    remembered.get(p.header.key).toldStep = p.state.step;
    p.send("committed", { ...p.state, held: heldParts() });
    if (p.columns) say(p, stateWords(p));
  }, delay);
}

// Asks for the parts that a chosen map needs and the browser has not.
function request(p) {
  clearTimeout(p.commitTimer);
  p.send("committed", { ...p.state, held: heldParts() });
}

// A screen reader is told the state at a stop, not each frame.
function say({ root }, words) {
  setText(partOf(root, "said"), words);
}

function stateWords(p) {
  if (p.state.compact) return `${stepWords(p)}: ${storyWords(p)}`;
  const maps = p.columns.flatMap((_, i) => (isScored(p) ? [`${mapName(p, i)}${scoreWords(p, i)}`] : []));
  const pinned = p.pin === null ? [] : p.columns.map((c) => cellWords(p, c, cellHolding(c.log, ...p.pin)));
  const now = maps.length ? `${stepWords(p)}: ${maps.join("; ")}` : stepWords(p);
  return [now, ...pinned].join(". ");
}

const isScored = (p) => p.header.hasTruth && !isHidden(p, "scores");

const mapName = (p, i) => (isSeveral(p) ? `map ${LETTERS[i]}, ` : "");

function scoreWords({ columns, header, state }, i) {
  const { looked } = columns[i].series;
  const scores = header.texts.scores.map(
    ({ name, label, unit }) => `${label} ${UNITS[unit].text(looked[name][state.step])}`,
  );
  return `looked at: ${scores.join(", ")}`;
}
