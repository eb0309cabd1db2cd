// One reading at pixel level, as occsim.one_reading: numbers only, independent of the
// page. The constants are those of occsim.sensor.

// What a reading says of a pixel.
const [OUT_OF_VIEW, UNSAID, EMPTY, OBJECT] = [0, 1, 2, 3];

// A world from rows of text, # is wall.
function worldOf(rows) {
  const [height, width] = [rows.length, rows[0].length];
  const walls = Uint8Array.from(rows.join(""), (letter) => (letter === "#" ? 1 : 0));
  return { height, width, walls, boxes: wallBoxes(walls, width, height) };
}

// The walls as few rectangles [x0, y0, x1, y1]: a ray that meets one of them meets one
// of its pixels at the same distance.
function wallBoxes(walls, width, height) {
  const rest = Uint8Array.from(walls);
  const boxes = [];
  const isFull = (x0, x1, y) => rest.subarray(y * width + x0, y * width + x1).every(Boolean);
  for (let i = 0; i < rest.length; i++) {
    if (!rest[i]) continue;
    const [x0, y0] = [i % width, Math.floor(i / width)];
    let x1 = x0;
    while (x1 < width && rest[y0 * width + x1]) x1++;
    let y1 = y0;
    while (y1 < height && isFull(x0, x1, y1)) rest.fill(0, y1 * width + x0, y1++ * width + x1);
    boxes.push([x0, y0, x1, y1]);
  }
  return boxes;
}

const isWallAt = ({ walls, width }, row, col) => walls[row * width + col] === 1;

// Where a ray enters a box grown by a margin; infinite if it misses it. A robot that
// touches the box from outside is not in it unless the ray leads into it.
function entryInto([x0, y0, x1, y1], { x, y, ux, uy }, margin) {
  let [enters, leaves] = [-Infinity, Infinity];
  for (const [origin, direction, low, high] of [
    [x, ux, x0 - margin, x1 + margin],
    [y, uy, y0 - margin, y1 + margin],
  ]) {
    if (direction === 0) {
      if (origin < low || origin > high) return Infinity;
      continue;
    }
    const [a, b] = [(low - origin) / direction, (high - origin) / direction];
    enters = Math.max(enters, Math.min(a, b));
    leaves = Math.min(leaves, Math.max(a, b));
  }
  return enters > leaves || leaves < 1e-6 ? Infinity : Math.max(enters, 0);
}

// The distance z at which a ray first meets a wall; infinite for none. Touching a corner
// counts; the margin only decides whether it is touched.
function firstHit(world, ray, margin) {
  let nearest = Infinity;
  for (const box of world.boxes) {
    const touched = entryInto(box, ray, margin);
    if (touched === Infinity) continue;
    const exact = entryInto(box, ray, 0);
    nearest = Math.min(nearest, exact === Infinity ? touched : exact);
  }
  return nearest;
}

// The ray through the centre of a pixel; null where the centre is the robot's place.
function rayTo({ x, y }, row, col, { ownPixelEps }) {
  const [dx, dy] = [col + 0.5 - x, row + 0.5 - y];
  const distance = Math.hypot(dx, dy);
  if (distance <= ownPixelEps) return null;
  return { x, y, ux: dx / distance, uy: dy / distance, distance };
}

function isInView(ray, theta, { range, fov }, { edgeEps }) {
  if (ray.distance > range + edgeEps) return false;
  const off = Math.atan2(ray.uy, ray.ux) - theta;
  const turns = Math.round(off / (2 * Math.PI));
  return Math.abs(off - turns * 2 * Math.PI) <= fov / 2 + edgeEps;
}

// What a reading says of one pixel, with its ray and z. Eq. 4.22: before the hit empty,
// at it or beyond object.
function pixelAt(world, pose, sensor, constants, row, col) {
  const ray = rayTo(pose, row, col, constants);
  const isWall = isWallAt(world, row, col);
  if (ray === null) return { kind: isWall ? OBJECT : EMPTY, ray, z: isWall ? 0 : Infinity };
  if (!isInView(ray, pose.theta, sensor, constants)) return { kind: OUT_OF_VIEW, ray, z: NaN };
  const { edgeEps, surfaceDepth } = constants;
  const z = firstHit(world, ray, edgeEps);
  const { distance } = ray;
  let kind = OBJECT;
  if (z > sensor.range + edgeEps) kind = sensor.clears ? EMPTY : UNSAID;
  else if (distance < z) kind = EMPTY;
  else if (sensor.isUnseenBehind && !(isWall && distance - z <= surfaceDepth + edgeEps)) kind = UNSAID;
  return { kind, ray, z };
}

// What a reading says of every pixel.
function readPixels(world, pose, sensor, constants) {
  const kinds = new Uint8Array(world.walls.length);
  const reach = (at, size) => [
    Math.max(0, Math.floor(at - sensor.range - 1)),
    Math.min(size, Math.ceil(at + sensor.range + 1)),
  ];
  const [top, bottom] = reach(pose.y, world.height);
  const [left, right] = reach(pose.x, world.width);
  for (let row = top; row < bottom; row++) {
    for (let col = left; col < right; col++) {
      kinds[row * world.width + col] = pixelAt(world, pose, sensor, constants, row, col).kind;
    }
  }
  return kinds;
}

// Pixels of each cell: in view, empty, object.
function countCells(world, kinds, cellPx) {
  const [nRows, nCols] = [world.height / cellPx, world.width / cellPx];
  const count = () => new Int32Array(nRows * nCols);
  const cells = { nRows, nCols, cellPx, inView: count(), empty: count(), object: count() };
  kinds.forEach((kind, i) => {
    if (kind === OUT_OF_VIEW) return;
    const [row, col] = [Math.floor(i / world.width), i % world.width];
    const c = Math.floor(row / cellPx) * nCols + Math.floor(col / cellPx);
    cells.inView[c]++;
    if (kind === EMPTY) cells.empty[c]++;
    if (kind === OBJECT) cells.object[c]++;
  });
  return cells;
}

// Free pixels that the reading calls object.
function countHidden({ walls }, kinds) {
  return kinds.reduce((sum, kind, i) => sum + (kind === OBJECT && !walls[i] ? 1 : 0), 0);
}

// Eq. 4.22 for one cell: its case (0 all empty, 1 all object, 2 both; null: not read),
// the empty share, p_free and its log-odds.
function saidOf(nEmpty, nObject, { pFreeMin, pFreeMax }) {
  if (nEmpty + nObject === 0) return { which: null, q: NaN, pFree: NaN, logOdds: 0 };
  const q = nEmpty / (nEmpty + nObject);
  const which = q === 1 ? 0 : q === 0 ? 1 : 2;
  const pFree = clamp(q, pFreeMin, pFreeMax);
  return { which, q, pFree, logOdds: logit(pFree) };
}
