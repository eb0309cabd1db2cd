// The document as Python writes it, texts, and as the lens holds it.

function stateOf(document) {
  const [x, y, heading] = document.pose.split("_").map(Number);
  const [row, col] = document.cell.split("_").map(Number);
  return {
    rev: document.rev,
    x,
    y,
    heading,
    size: Number(document.size),
    row,
    col,
    range: Number(document.range),
    fov: Number(document.fov),
    behind: document.behind,
    clear: document.clear,
    prior: Number(document.prior),
    rule: document.rule,
    chips: document.chips ? document.chips.split("_") : [],
  };
}

function textsOf(state) {
  const { rev, behind, clear, rule } = state;
  return {
    rev,
    pose: [state.x, state.y, state.heading].join("_"),
    size: String(state.size),
    cell: `${state.row}_${state.col}`,
    range: String(state.range),
    fov: String(state.fov),
    behind,
    clear,
    prior: state.prior.toFixed(2),
    rule,
    chips: state.chips.join("_"),
  };
}

const radians = (degrees) => (degrees * Math.PI) / 180;

const poseOf = ({ x, y, heading }) => ({ x, y, theta: radians(heading) });

const sensorOf = ({ range, fov, behind, clear }) => ({
  range,
  fov: radians(fov),
  isUnseenBehind: behind === "unseen",
  clears: clear === "1",
});

// The cell of another size that holds the middle of the one selected.
function resized(state, size) {
  const at = (i) => Math.floor(((i + 0.5) * state.size) / size);
  return { size, row: at(state.row), col: at(state.col) };
}

// Where the robot comes to stand on its way to a place: in the world, on half pixels, not
// in a wall. Along a wall it slides.
function freePlace(world, { x: fromX, y: fromY }, x, y) {
  const snapped = (value, size) => clamp(Math.round(2 * value) / 2, 0.5, size - 0.5);
  const [toX, toY] = [snapped(x, world.width), snapped(y, world.height)];
  const places = [[toX, toY], [toX, fromY], [fromX, toY]];
  const [freeX, freeY] = places.find(([px, py]) => isFreeAt(world, px, py)) ?? [fromX, fromY];
  return { x: freeX, y: freeY };
}

const isFreeAt = (world, x, y) => !isWallAt(world, Math.floor(y), Math.floor(x));

// A step of the robot; a wall in its way is stepped over, as a hand would lift it.
function stepped(world, { x, y }, dx, dy) {
  let [toX, toY] = [x + dx, y + dy];
  const isInside = () => toX >= 0.5 && toY >= 0.5 && toX <= world.width - 0.5 && toY <= world.height - 0.5;
  while (isInside() && !isFreeAt(world, toX, toY)) [toX, toY] = [toX + Math.sign(dx), toY + Math.sign(dy)];
  return isInside() ? { x: toX, y: toY } : { x, y };
}

const wrapped = (degrees) => ((Math.round(degrees) % 360) + 360) % 360;
