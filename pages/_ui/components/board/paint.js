// Everything that is drawn on the canvas, once a frame at most.

const ARROW_GAP_PX = 64;
const ARROW_PX = 5.5;

function requestPaint(b) {
  if (b.frame || b.closed) return;
  b.frame = requestAnimationFrame(() => {
    b.frame = 0;
    if (!b.closed) paint(b);
  });
}

function paint(b) {
  const { ctx, camera, canvas } = b;
  const ratio = canvas.width / camera.width;
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, camera.width, camera.height);
  if (!b.doc) return;
  paintDrawing(b);
  ({ walls: paintExtent, trajectory: paintPath, measure: paintRuler, crop: paintFrame })[b.header.mode](b);
  paintCursor(b);
}

function paintDrawing(b) {
  const { ctx, camera, size } = b;
  const rect = [camera.x, camera.y, size.width * camera.scale, size.height * camera.scale];
  ctx.fillStyle = b.colours.paper;
  ctx.fillRect(...rect);
  // At high zoom a pixel is shown as a square.
  ctx.imageSmoothingQuality = "high";
  ctx.imageSmoothingEnabled = camera.scale < 3;
  if (b.bitmap) ctx.drawImage(b.bitmap, ...rect);
  if (b.hasMask) {
    ctx.imageSmoothingEnabled = camera.scale < 1;
    ctx.globalAlpha = b.opacity;
    ctx.drawImage(b.tint, ...rect);
    ctx.globalAlpha = 1;
  }
  ctx.strokeStyle = b.theme.line;
  ctx.lineWidth = 1;
  ctx.strokeRect(rect[0] - 0.5, rect[1] - 0.5, rect[2] + 1, rect[3] + 1);
}

// A line with a light rim, so that it is seen on ink and on paper.
function trace(b, points, colour, width = 2, dash = []) {
  if (points.length < 2) return;
  const { ctx } = b;
  ctx.beginPath();
  points.forEach((p, i) => ctx[i ? "lineTo" : "moveTo"](...toScreen(b.camera, p)));
  ctx.lineJoin = ctx.lineCap = "round";
  ctx.setLineDash([]);
  ctx.strokeStyle = b.colours.halo;
  ctx.lineWidth = width + 2.5;
  ctx.stroke();
  ctx.setLineDash(dash);
  ctx.lineCap = dash.length ? "butt" : "round";
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.stroke();
  ctx.setLineDash([]);
}

function disc(b, [sx, sy], radius, fill, rim) {
  const { ctx } = b;
  ctx.beginPath();
  ctx.arc(sx, sy, radius, 0, 2 * Math.PI);
  ctx.fillStyle = fill;
  ctx.strokeStyle = rim;
  ctx.lineWidth = 1.75;
  ctx.fill();
  ctx.stroke();
}

function label(b, text, [sx, sy]) {
  const { ctx, camera } = b;
  ctx.font = `600 13px ${b.theme.font}`;
  const width = ctx.measureText(text).width + 14;
  const x = clamp(sx - width / 2, 4, Math.max(camera.width - width - 4, 4));
  const y = clamp(sy - 12, 4, Math.max(camera.height - 28, 4));
  ctx.beginPath();
  ctx.roundRect(x, y, width, 24, 5);
  ctx.fillStyle = b.theme.paper;
  ctx.strokeStyle = b.theme.line;
  ctx.lineWidth = 1;
  ctx.fill();
  ctx.stroke();
  ctx.fillStyle = b.theme.ink;
  ctx.textBaseline = "middle";
  ctx.fillText(text, x + 7, y + 12.5);
}

// While a straight line or a rectangle is drawn: how long, how large.
function paintExtent(b) {
  const extent = b.gesture && b.gesture.extent;
  if (!extent) return;
  const [[xa, ya], [xb, yb]] = extent;
  const text = BOXES.has(b.tool)
    ? `${Math.abs(xb - xa).toFixed(0)} x ${Math.abs(yb - ya).toFixed(0)} px`
    : lengthText(b, Math.hypot(xb - xa, yb - ya));
  const [sx, sy] = toScreen(b.camera, [xb, yb]);
  label(b, text, [sx, sy - 28]);
}

function paintPath(b) {
  const points = b.doc.points;
  const colour = b.colours.path;
  trace(b, points, colour);
  paintArrows(b, points, colour);
  const inWalls = b.hasMask ? partsInside(b.mask, points) : [];
  for (const part of inWalls) trace(b, part, b.colours.falseWall, 3.5, [4, 3]);
  b.partsInWalls = inWalls.length;
  points.forEach((p, i) => {
    const isEnd = i === 0 || i === points.length - 1;
    if (p[2] === FREEHAND && !isEnd && i !== b.selected) return disc(b, toScreen(b.camera, p), 2, colour, colour);
    const radius = i === b.selected ? 7 : isEnd ? 6 : 4.5;
    disc(b, toScreen(b.camera, p), radius, i === 0 ? colour : b.colours.halo, i === 0 ? b.colours.halo : colour);
  });
  if (points.length) paintEndNames(b, points, ["start", "end"], b.colours.path);
  paintTarget(b, points);
}

// What a click would do here: select this point, insert one, or append one.
function paintTarget(b, points) {
  if (b.tool !== "waypoints" || b.gesture || b.panning || b.space || !b.hover || !points.length) return;
  const mouse = { pointerType: "mouse" };
  const hit = pointAt(b, b.hover, mouse);
  if (hit >= 0) return disc(b, toScreen(b.camera, points[hit]), 7.5, b.colours.path, b.colours.halo);
  const at = toScreen(b.camera, b.hover);
  const { ctx } = b;
  if (segmentAt(b, b.hover, mouse) < 0) {
    ctx.beginPath();
    ctx.moveTo(...toScreen(b.camera, points[points.length - 1]));
    ctx.lineTo(...at);
    ctx.setLineDash([4, 5]);
    ctx.lineWidth = 1.25;
    ctx.strokeStyle = b.colours.path;
    ctx.stroke();
    ctx.setLineDash([]);
  }
  disc(b, at, 4.5, b.colours.halo, b.colours.path);
}

function paintEndNames(b, points, [first, last], colour) {
  const name = (text, p) => {
    const { ctx } = b;
    const [sx, sy] = toScreen(b.camera, p);
    ctx.font = `600 12px ${b.theme.font}`;
    ctx.textBaseline = "middle";
    ctx.lineJoin = "round";
    ctx.lineWidth = 4;
    ctx.strokeStyle = b.colours.halo;
    ctx.strokeText(text, sx + 11, sy - 10);
    ctx.fillStyle = colour;
    ctx.fillText(text, sx + 11, sy - 10);
  };
  name(first, points[0]);
  if (points.length > 1) name(last, points[points.length - 1]);
}

// Arrow heads at even distances on the screen show which way the path runs.
function paintArrows(b, points, colour) {
  const { ctx, camera } = b;
  let left = ARROW_GAP_PX / 2;
  for (let i = 1; i < points.length; i++) {
    const [p, q] = [toScreen(camera, points[i - 1]), toScreen(camera, points[i])];
    const length = Math.hypot(q[0] - p[0], q[1] - p[1]);
    for (; left < length; left += ARROW_GAP_PX) {
      const share = left / length;
      const at = [p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share];
      arrowHead(ctx, at, Math.atan2(q[1] - p[1], q[0] - p[0]), colour, b.colours.halo);
    }
    left -= length;
  }
}

function arrowHead(ctx, [x, y], angle, fill, rim) {
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(angle);
  ctx.beginPath();
  ctx.moveTo(ARROW_PX + 1, 0);
  ctx.lineTo(-ARROW_PX, -ARROW_PX);
  ctx.lineTo(-ARROW_PX + 2.5, 0);
  ctx.lineTo(-ARROW_PX, ARROW_PX);
  ctx.closePath();
  ctx.lineJoin = "round";
  ctx.lineWidth = 2;
  ctx.strokeStyle = rim;
  ctx.stroke();
  ctx.fillStyle = fill;
  ctx.fill();
  ctx.restore();
}

function paintRuler(b) {
  const far = b.draft && (b.gesture ? b.draftEnd : b.hover && rulerEnd(b));
  const ends = b.draft ? (far ? [b.draft, far] : [b.draft]) : b.doc.points;
  if (ends.length === 2) trace(b, ends, b.colours.mark, 2);
  for (const p of ends) disc(b, toScreen(b.camera, p), 5, b.colours.halo, b.colours.mark);
  if (ends.length > 0) paintEndNames(b, ends, ["1", "2"], b.colours.mark);
  if (ends.length < 2) return;
  labelAbove(b, lengthText(b, lengthOf(ends)), ...ends.map((end) => toScreen(b.camera, end)));
}

// Beside the middle of a line, on its upper side and far enough not to cover it.
function labelAbove(b, text, p, q) {
  const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
  let [nx, ny] = [(q[1] - p[1]) / length, (p[0] - q[0]) / length];
  if (ny > 0) [nx, ny] = [-nx, -ny];
  b.ctx.font = `600 13px ${b.theme.font}`;
  const half = b.ctx.measureText(text).width / 2 + 7;
  const away = half * Math.abs(nx) + 12 * Math.abs(ny) + 10;
  label(b, text, [(p[0] + q[0]) / 2 + nx * away, (p[1] + q[1]) / 2 + ny * away]);
}

const rulerEnd = (b) => kept(b, b.straight ? turnedTo45(b.draft, b.hover) : b.hover);

function lengthText(b, px) {
  const metres = b.header.metresPerPx;
  return metres ? `${px.toFixed(1)} px, ${(px * metres).toFixed(2)} m` : `${px.toFixed(1)} px`;
}

function paintFrame(b) {
  if (b.doc.points.length !== 2) return;
  const { ctx, camera, size } = b;
  const box = cropBox(b.doc.points);
  const [x0, y0] = toScreen(camera, [box.x0, box.y0]);
  const [x1, y1] = toScreen(camera, [box.x1, box.y1]);
  ctx.beginPath();
  ctx.rect(camera.x, camera.y, size.width * camera.scale, size.height * camera.scale);
  ctx.rect(x0, y0, x1 - x0, y1 - y0);
  ctx.fillStyle = "rgb(0 0 0 / 45%)";
  ctx.fill("evenodd");
  const corners = [[box.x0, box.y0], [box.x1, box.y0], [box.x1, box.y1], [box.x0, box.y1]];
  trace(b, [...corners, corners[0]], b.colours.mark, 2);
  for (const corner of corners) disc(b, toScreen(camera, corner), 5, b.colours.halo, b.colours.mark);
  label(b, `${box.x1 - box.x0} x ${box.y1 - box.y0} px`, [(x0 + x1) / 2, y1 - 22]);
}

// The brush at its real size; for the keyboard a cross-hair.
function paintCursor(b) {
  const at = b.keyboard ?? b.hover;
  if (!at || b.panning) return;
  const { ctx } = b;
  const [sx, sy] = toScreen(b.camera, at);
  const width = b.widths[b.tool];
  const ring = (radius, colour, line) => {
    ctx.beginPath();
    ctx.arc(sx, sy, radius, 0, 2 * Math.PI);
    ctx.lineWidth = line;
    ctx.strokeStyle = colour;
    ctx.stroke();
  };
  if (width) {
    const radius = Math.max((width * b.camera.scale) / 2, 2);
    ring(radius, b.colours.halo, 3);
    ring(radius, b.tool === "eraser" ? b.colours.eraser : b.colours.stroke, 1.5);
  }
  if (!b.keyboard) return;
  for (const [colour, line] of [[b.colours.halo, 4], [b.colours.crosshair, 1.75]]) {
    ctx.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      ctx.moveTo(sx + 4 * dx, sy + 4 * dy);
      ctx.lineTo(sx + 14 * dx, sy + 14 * dy);
    }
    ctx.lineWidth = line;
    ctx.strokeStyle = colour;
    ctx.stroke();
  }
}
