// The tools that place points: waypoints, free hand, ruler and crop frame.

const WAYPOINT = 1;
const FREEHAND = 0;
const FREEHAND_CSS_PX = 1.2; // largest shift of a path by simplifying, on the screen
const CLICK_CSS_PX = 5;
const MIN_CROP_PX = 8;

const reachOf = (event) => (event.pointerType === "touch" ? { point: 22, segment: 14 } : { point: 10, segment: 6 });
const screenDistance = (b, p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) * b.camera.scale;

// A point of a path: whole quarters of a pixel, inside the drawing.
const kept = (b, p) =>
  [b.size.width, b.size.height].map((size, axis) => Math.round(clamp(p[axis], 0, size - 0.25) * 4) / 4);

function pointAt(b, p, event) {
  let [best, nearest] = [-1, reachOf(event).point];
  b.doc.points.forEach((q, i) => {
    const d = screenDistance(b, p, q);
    if (d <= nearest) [best, nearest] = [i, d];
  });
  return best;
}

function segmentAt(b, p, event) {
  const points = b.doc.points;
  let [best, nearest] = [-1, reachOf(event).segment];
  for (let i = 1; i < points.length; i++) {
    const d = distanceToSegment(p, points[i - 1], points[i]) * b.camera.scale;
    if (d <= nearest) [best, nearest] = [i, d];
  }
  return best;
}

function waypoints(b, p, event) {
  const before = b.doc.points;
  if (!event.altKey) {
    const hit = pointAt(b, p, event);
    if (hit >= 0) return dragged(b, hit, before);
    const segment = segmentAt(b, p, event);
    if (segment > 0) return dragged(b, inserted(b, segment, [...kept(b, p), WAYPOINT]), before);
  }
  if (before.length >= b.header.maxPoints) return null;
  const last = before[before.length - 1];
  const at = last && isStraight(b, event) ? turnedTo45(last, p) : p;
  return dragged(b, inserted(b, before.length, [...kept(b, at), WAYPOINT]), before);
}

function inserted(b, index, point) {
  b.doc.points = b.doc.points.toSpliced(index, 0, point);
  return index;
}

function dragged(b, index, before) {
  b.selected = index;
  let start = null;
  return {
    move(p, event) {
      start ??= p;
      if (screenDistance(b, p, start) < 1 && b.doc.points === before) return;
      const neighbour = b.doc.points[index - 1];
      const at = neighbour && isStraight(b, event) ? turnedTo45(neighbour, p) : p;
      b.doc.points = b.doc.points.with(index, [...kept(b, at), b.doc.points[index][2]]);
    },
    end: () => setPoints(b, b.doc.points, before),
    cancel: () => (b.doc.points = before),
  };
}

function removePoint(b, index) {
  if (index < 0 || index >= b.doc.points.length) return;
  b.selected = Math.min(index, b.doc.points.length - 2);
  setPoints(b, b.doc.points.toSpliced(index, 1));
}

function freehand(b, p) {
  const before = b.doc.points;
  const raw = [p];
  b.selected = -1;
  const show = (points, kind) => {
    b.doc.points = [...before, ...points.map((q) => [...kept(b, q), kind])];
  };
  return {
    move(q) {
      if (screenDistance(b, q, raw[raw.length - 1]) < 1) return;
      raw.push(q);
      show(raw, FREEHAND);
    },
    end() {
      const isClick = raw.length === 1;
      const tolerance = Math.max(0.5, FREEHAND_CSS_PX / b.camera.scale);
      const room = b.header.maxPoints - before.length;
      show(room < 2 ? [] : atMost(room, raw, tolerance), isClick ? WAYPOINT : FREEHAND);
      setPoints(b, b.doc.points, before);
    },
    cancel: () => (b.doc.points = before),
  };
}

// Two clicks, or one drag; an end can be dragged again later.
function ruler(b, p, event) {
  const hit = b.draft ? -1 : pointAt(b, p, event);
  if (hit >= 0) return dragged(b, hit, b.doc.points);
  const first = b.draft ?? kept(b, p);
  const placed = b.draft !== null;
  const second = (q, ev) => kept(b, isStraight(b, ev) ? turnedTo45(first, q) : q);
  b.draft = first;
  b.draftEnd = placed ? second(p, event) : first;
  return {
    move: (q, ev) => (b.draftEnd = second(q, ev)),
    end() {
      if (screenDistance(b, first, b.draftEnd) < CLICK_CSS_PX) return;
      b.draft = null;
      setPoints(b, [first, b.draftEnd].map((q) => [...q, WAYPOINT]));
    },
    cancel: () => (b.draft = null),
  };
}

const cropBox = (points) => ({
  x0: Math.min(points[0][0], points[1][0]),
  y0: Math.min(points[0][1], points[1][1]),
  x1: Math.max(points[0][0], points[1][0]),
  y1: Math.max(points[0][1], points[1][1]),
});

const cropPoints = (b, p, q) =>
  [p, q].map(([x, y]) => [
    clamp(Math.round(x), 0, b.size.width),
    clamp(Math.round(y), 0, b.size.height),
    WAYPOINT,
  ]);

// A drag draws a new frame; dragging a corner resizes the frame, its inside moves it.
function frame(b, p, event) {
  const before = b.doc.points;
  const box = before.length === 2 ? cropBox(before) : null;
  const corners = box && [[box.x0, box.y0], [box.x1, box.y0], [box.x1, box.y1], [box.x0, box.y1]];
  const corner = box ? corners.findIndex((q) => screenDistance(b, p, q) <= reachOf(event).point) : -1;
  const isInside = box && corner < 0 && p[0] > box.x0 && p[0] < box.x1 && p[1] > box.y0 && p[1] < box.y1;
  const fixed = corner >= 0 ? corners[(corner + 2) % 4] : p;
  const shifted = (q) => {
    const [w, h] = [box.x1 - box.x0, box.y1 - box.y0];
    const x = clamp(box.x0 + q[0] - p[0], 0, b.size.width - w);
    const y = clamp(box.y0 + q[1] - p[1], 0, b.size.height - h);
    return cropPoints(b, [x, y], [x + w, y + h]);
  };
  return {
    move: (q) => (b.doc.points = isInside ? shifted(q) : cropPoints(b, fixed, q)),
    end() {
      const now = b.doc.points.length === 2 ? cropBox(b.doc.points) : null;
      const isLarge = now && now.x1 - now.x0 >= MIN_CROP_PX && now.y1 - now.y0 >= MIN_CROP_PX;
      setPoints(b, isLarge ? b.doc.points : before, before);
    },
    cancel: () => (b.doc.points = before),
  };
}
