// Which pixels a stroke covers, and the geometry of lines.
// A pixel belongs to a line if its test point lies within half the line's width, or if one of the line's points lies in it, so that a thin dot has at least one pixel. The test
// point is a little right of and below the centre: a line of width 2 along the pixels
// covers two rows of them, not one or three.

const TEST_POINT = 0.5 + 1 / 64;
const ADDED = 1; // values of a pixel of the corrections; 0 is neither
const ERASED = 2;
const ERASING = new Set(["eraser", "clear"]);
const BOXES = new Set(["rectangle", "outline", "clear"]);

const noBox = () => ({ x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity });
const isEmptyBox = (box) => box.x1 <= box.x0 || box.y1 <= box.y0;
const wholeOf = (grid) => ({ x0: 0, y0: 0, x1: grid.width, y1: grid.height });

function growBox(box, x0, y0, x1, y1) {
  box.x0 = Math.min(box.x0, x0);
  box.y0 = Math.min(box.y0, y0);
  box.x1 = Math.max(box.x1, x1);
  box.y1 = Math.max(box.y1, y1);
}

const unionBox = (a, b) => {
  const box = { ...a };
  growBox(box, b.x0, b.y0, b.x1, b.y1);
  return box;
};

// A grid is {width, height, pixels: Uint8Array}. Returns the box that may have changed.
function applyStroke(grid, stroke) {
  const value = ERASING.has(stroke.kind) ? ERASED : ADDED;
  const dirty = noBox();
  if (BOXES.has(stroke.kind)) {
    for (const box of boxesOf(stroke)) fillBox(grid, box, value, dirty);
    return dirty;
  }
  const points = stroke.points;
  for (const [x, y] of points) fillPixel(grid, Math.floor(x), Math.floor(y), value, dirty);
  if (points.length === 1) fillCapsule(grid, points[0], points[0], stroke.width / 2, value, dirty);
  for (let i = 1; i < points.length; i++) {
    fillCapsule(grid, points[i - 1], points[i], stroke.width / 2, value, dirty);
  }
  return dirty;
}

function boxesOf(stroke) {
  const [[xa, ya], [xb, yb]] = stroke.points;
  const [x0, x1, y0, y1] = [Math.min(xa, xb), Math.max(xa, xb), Math.min(ya, yb), Math.max(ya, yb)];
  if (stroke.kind !== "outline") return [[x0, y0, x1, y1]];
  const r = stroke.width / 2;
  return [
    [x0 - r, y0 - r, x1 + r, y0 + r],
    [x0 - r, y1 - r, x1 + r, y1 + r],
    [x0 - r, y0 - r, x0 + r, y1 + r],
    [x1 - r, y0 - r, x1 + r, y1 + r],
  ];
}

function fillBox(grid, box, value, dirty) {
  const edge = (at, size) => clamp(Math.ceil(at - TEST_POINT), 0, size);
  const [c0, c1] = [edge(box[0], grid.width), edge(box[2], grid.width)];
  const [r0, r1] = [edge(box[1], grid.height), edge(box[3], grid.height)];
  if (c1 <= c0 || r1 <= r0) return;
  for (let r = r0; r < r1; r++) grid.pixels.fill(value, r * grid.width + c0, r * grid.width + c1);
  growBox(dirty, c0, r0, c1, r1);
}

function fillPixel(grid, col, row, value, dirty) {
  if (col < 0 || row < 0 || col >= grid.width || row >= grid.height) return;
  grid.pixels[row * grid.width + col] = value;
  growBox(dirty, col, row, col + 1, row + 1);
}

// All pixels within a radius of a segment. A capsule is convex: one run a row.
function fillCapsule(grid, a, b, radius, value, dirty) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const squared = dx * dx + dy * dy;
  const reach = radius * Math.sqrt(squared);
  const row0 = clamp(Math.ceil(Math.min(a[1], b[1]) - radius - TEST_POINT), 0, grid.height);
  const row1 = clamp(Math.floor(Math.max(a[1], b[1]) + radius - TEST_POINT) + 1, 0, grid.height);
  for (let row = row0; row < row1; row++) {
    const y = row + TEST_POINT - a[1];
    const [left, right] = rowInterval(dx, dy, y, radius, squared, reach);
    if (left > right) continue;
    const x = a[0] - TEST_POINT;
    const c0 = clamp(Math.ceil(x + left), 0, grid.width);
    const c1 = clamp(Math.floor(x + right) + 1, 0, grid.width);
    if (c1 <= c0) continue;
    grid.pixels.fill(value, row * grid.width + c0, row * grid.width + c1);
    growBox(dirty, c0, row, c1, row + 1);
  }
}

function rowInterval(dx, dy, y, radius, squared, reach) {
  let [left, right] = [Infinity, -Infinity];
  if (squared > 0) {
    const [l1, r1] = solved(dx, -y * dy, squared - y * dy);
    const [l2, r2] = solved(dy, y * dx - reach, y * dx + reach);
    if (Math.max(l1, l2) <= Math.min(r1, r2)) [left, right] = [Math.max(l1, l2), Math.min(r1, r2)];
  }
  for (const [shift, height] of [[0, y], [dx, y - dy]]) {
    const half = radius * radius - height * height;
    if (half < 0) continue;
    const root = Math.sqrt(half);
    left = Math.min(left, shift - root);
    right = Math.max(right, shift + root);
  }
  return [left, right];
}

// The x with low <= factor * x <= high.
function solved(factor, low, high) {
  if (factor === 0) return low > 0 || high < 0 ? [Infinity, -Infinity] : [-Infinity, Infinity];
  const [p, q] = [low / factor, high / factor];
  return p < q ? [p, q] : [q, p];
}

// Douglas and Peucker, without recursion: the points that matter within a tolerance.
function simplified(points, tolerance) {
  if (points.length < 3) return points;
  const keep = new Uint8Array(points.length);
  keep[0] = keep[points.length - 1] = 1;
  const open = [[0, points.length - 1]];
  while (open.length) {
    const [first, last] = open.pop();
    let [far, worst] = [-1, tolerance];
    for (let i = first + 1; i < last; i++) {
      const d = distanceToSegment(points[i], points[first], points[last]);
      if (d > worst) [far, worst] = [i, d];
    }
    if (far < 0) continue;
    keep[far] = 1;
    open.push([first, far], [far, last]);
  }
  return points.filter((_, i) => keep[i]);
}

// The same with a limited number of points: a long line is simplified more.
function atMost(limit, points, tolerance) {
  let few = simplified(points, tolerance);
  for (let t = 2 * tolerance; few.length > limit; t *= 2) few = simplified(few, t);
  return few;
}

function distanceToSegment(p, a, b) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const squared = dx * dx + dy * dy;
  const share = squared ? clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / squared, 0, 1) : 0;
  return Math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

// Parts of a polyline that run over marked pixels: [[x, y], [x, y]] pairs.
function partsInside(grid, points) {
  const inside = ([x, y]) => {
    const [c, r] = [Math.floor(x), Math.floor(y)];
    return c >= 0 && r >= 0 && c < grid.width && r < grid.height && grid.pixels[r * grid.width + c] === 1;
  };
  const parts = [];
  for (let i = 1; i < points.length; i++) {
    const [a, b] = [points[i - 1], points[i]];
    const n = Math.max(1, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) * 2));
    const at = (k) => [a[0] + ((b[0] - a[0]) * k) / n, a[1] + ((b[1] - a[1]) * k) / n];
    let start = null;
    for (let k = 0; k <= n; k++) {
      const now = inside(at(k));
      if (now && start === null) start = k;
      if (start !== null && (!now || k === n)) {
        parts.push([at(Math.max(start - 0.5, 0)), at(now ? k : k - 0.5)]);
        start = null;
      }
    }
  }
  return parts;
}

function lengthOf(points) {
  let sum = 0;
  for (let i = 1; i < points.length; i++) {
    sum += Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
  }
  return sum;
}

// The end of a straight line, turned to the nearest multiple of 45 degrees.
function turnedTo45(from, to) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const angle = (Math.round(Math.atan2(dy, dx) / (Math.PI / 4)) * Math.PI) / 4;
  const [ux, uy] = [Math.cos(angle), Math.sin(angle)];
  const along = dx * ux + dy * uy;
  return [from[0] + along * ux, from[1] + along * uy];
}
