// The window onto the drawing: image pixels to CSS pixels of the canvas and back.
// screen = image * scale + offset; the same for both axes.

const MAX_SCALE = 48;
const FIT_MARGIN_PX = 12;
const KEEP_IN_VIEW_PX = 64; // at least this much of the drawing stays on the canvas
const ZOOM_STEP = 1.4;

const newCamera = () => ({ scale: 1, x: 0, y: 0, width: 1, height: 1, fitted: true });

function fitScale(camera, size) {
  const room = (length) => Math.max(length - 2 * FIT_MARGIN_PX, 16);
  return Math.min(room(camera.width) / size.width, room(camera.height) / size.height, MAX_SCALE);
}

function fit(camera, size) {
  camera.scale = fitScale(camera, size);
  camera.x = (camera.width - size.width * camera.scale) / 2;
  camera.y = (camera.height - size.height * camera.scale) / 2;
  camera.fitted = true;
}

function keptInView(camera, size) {
  const bounded = (offset, length, view) =>
    clamp(offset, Math.min(KEEP_IN_VIEW_PX - length, view - length), Math.max(view - KEEP_IN_VIEW_PX, 0));
  camera.x = bounded(camera.x, size.width * camera.scale, camera.width);
  camera.y = bounded(camera.y, size.height * camera.scale, camera.height);
}

function zoomAt(camera, size, [sx, sy], factor) {
  const low = Math.min(fitScale(camera, size) / 2, 1);
  const scale = clamp(camera.scale * factor, low, MAX_SCALE);
  const ratio = scale / camera.scale;
  camera.x = sx - (sx - camera.x) * ratio;
  camera.y = sy - (sy - camera.y) * ratio;
  camera.scale = scale;
  camera.fitted = false;
  keptInView(camera, size);
}

function pan(camera, size, dx, dy) {
  camera.x += dx;
  camera.y += dy;
  camera.fitted = false;
  keptInView(camera, size);
}

function resize(camera, size, width, height) {
  const middle = toImage(camera, [camera.width / 2, camera.height / 2]);
  [camera.width, camera.height] = [width, height];
  if (camera.fitted) return fit(camera, size);
  camera.x = width / 2 - middle[0] * camera.scale;
  camera.y = height / 2 - middle[1] * camera.scale;
  keptInView(camera, size);
}

const toImage = (camera, [sx, sy]) => [(sx - camera.x) / camera.scale, (sy - camera.y) / camera.scale];
const toScreen = (camera, [x, y]) => [x * camera.scale + camera.x, y * camera.scale + camera.y];

// Scrolls a point of the drawing into view; for the keyboard's cursor.
function reveal(camera, size, point) {
  const [sx, sy] = toScreen(camera, point);
  const shift = (s, length) => clamp(s, 24, Math.max(length - 24, 24)) - s;
  const [dx, dy] = [shift(sx, camera.width), shift(sy, camera.height)];
  if (dx || dy) pan(camera, size, dx, dy);
}
