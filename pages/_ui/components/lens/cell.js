// The panel of the selected cell, the line on the pixel at the pointer, and what a
// screen reader is told.

const HEARD = ["says free", "says wall", "says nothing"];

// What a reading does to the map, in a word: 0 free, 1 wall, 2 nothing.
const leaningOf = (logOdds) => (logOdds > 0 ? 0 : logOdds < 0 ? 1 : 2);

function selectedOf({ state, cells, constants }) {
  const c = state.row * cells.nCols + state.col;
  const [inView, empty, object] = [cells.inView[c], cells.empty[c], cells.object[c]];
  return { inView, empty, object, ...saidOf(empty, object, constants) };
}

function showCell(p) {
  const { root, state } = p;
  const cell = selectedOf(p);
  const isRead = cell.which !== null;
  const put = (name, ...words) => setText(partOf(root, name), words.join(""));
  put("cell-name", `Cell row ${state.row}, column ${state.col}`);
  put("in-view", `${cell.inView} of ${state.size ** 2}`, unsaidWords(cell));
  put("n-empty", String(cell.empty));
  put("n-object", String(cell.object));
  put("q", isRead ? `${cell.empty} / ${cell.empty + cell.object} = ${inHundredths(cell.q)}` : DASH);
  put("p-free", isRead ? inHundredths(cell.pFree) : DASH);
  put("log-odds", isRead ? oddsWords(cell) : DASH);
  put("verdict", isRead ? HEARD[leaningOf(cell.logOdds)] : "not read: the map keeps what it holds");
  root.querySelectorAll("[data-case]").forEach((line) => {
    const isLive = Number(line.dataset.case) === cell.which;
    line.toggleAttribute("data-live", isLive);
    if (isLive) line.setAttribute("aria-current", "true");
    else line.removeAttribute("aria-current");
  });
  partOf(root, "read-cell").disabled = !isRead || state.chips.length >= p.header.maxChips;
}

function unsaidWords({ inView, empty, object }) {
  const rest = inView - empty - object;
  return rest ? `; of ${rest} nothing is said` : "";
}

function oddsWords({ pFree, logOdds }) {
  return `ln(${inHundredths(pFree)} / ${inHundredths(1 - pFree)}) = ${signedOrZero(logOdds)}`;
}

// Two decimals where they are exact, else three.
function inHundredths(value) {
  return value.toFixed(Math.abs(value - Number(value.toFixed(2))) < 1e-9 ? 2 : 3);
}

// A sign on what is not zero.
const signedOrZero = (value) => (Number(value.toFixed(2)) === 0 ? "0.00" : signed(value, 2));

function cellWords(p) {
  const { row, col } = p.state;
  const cell = selectedOf(p);
  if (cell.which === null) return `cell ${row}, ${col}: not read`;
  return `cell ${row}, ${col}: ${cell.empty} empty, ${cell.object} object, ${HEARD[leaningOf(cell.logOdds)]}`;
}

// The pixel at the pointer: its ray and its z.
function showPixel(p) {
  setText(partOf(p.root, "pixel"), p.hover ? pixelWords(p) : "Point at a pixel: its ray and its z.");
}

function pixelWords({ world, state, constants, hover: { row, col } }) {
  const name = `Pixel row ${row}, column ${col}`;
  const { kind, ray, z } = pixelAt(world, poseOf(state), sensorOf(state), constants, row, col);
  if (kind === OUT_OF_VIEW) return `${name}: out of view`;
  if (ray === null) return `${name}: the robot stands on it`;
  const away = `${name}, ${ray.distance.toFixed(1)} px away`;
  if (z > state.range + constants.edgeEps) {
    return `${away}: its ray meets nothing within range; ${["", "nothing is said", "empty"][kind]}`;
  }
  const side = ray.distance < z ? "before it" : "at it or behind it";
  return `${away}; its ray meets a wall at z = ${z.toFixed(1)}: ${side}, ${["", "nothing said", "empty", "object"][kind]}`;
}

function showHidden({ root, world, kinds }) {
  const n = countHidden(world, kinds);
  setText(partOf(root, "n-hidden"), `${grouped(n)} free pixel${n === 1 ? " is" : "s are"} called object`);
}
