// What is drawn on the stage, in px of the page; and the robot and its handle above it.

const HANDLE_AT = 40; // from the robot's middle, px of the page
const LABEL_MIN = 26; // px: in smaller cells a word cannot be read
const GRID_MIN = 7; // px: closer lines would be a grey

// The stage takes the width that the page gives it, and at most the height.
function layOut(p) {
  const { root, world } = p;
  const box = root.querySelector(".stage");
  const room = root.querySelector(".measure").clientHeight;
  const width = root.querySelector(".first").clientWidth || root.clientWidth;
  p.scale = Math.min(width / world.width, room / world.height);
  box.style.width = `${world.width * p.scale}px`;
  box.style.height = `${world.height * p.scale}px`;
}

function drawStage(p) {
  const { context } = fitted(p.canvas);
  if (!(p.scale > 0)) return;
  drawPixels(p, context);
  drawGrid(p, context);
  drawCone(p, context);
  drawLabels(p, context);
  drawSelected(p, context);
  if (p.hover) drawRay(p, context);
  placeRobot(p);
}

function inksOf(colours) {
  const ink = (name) => pixelOf(rgbOf(colours[name]));
  // By what the reading says, on free pixels and on wall.
  return {
    free: [ink("paper"), ink("unsaid"), ink("empty"), ink("hidden")],
    wall: [ink("wall"), ink("wall"), ink("wall"), ink("object")],
  };
}

function drawPixels({ world, kinds, scale, picture, inks }, context) {
  const pixels = new Uint32Array(picture.image.data.buffer);
  kinds.forEach((kind, i) => (pixels[i] = (world.walls[i] ? inks.wall : inks.free)[kind]));
  picture.canvas.getContext("2d").putImageData(picture.image, 0, 0);
  context.imageSmoothingEnabled = false;
  context.drawImage(picture.canvas, 0, 0, world.width * scale, world.height * scale);
}

function drawGrid({ world, scale, state, colours }, context) {
  const lines = (step, alpha, width) => {
    context.beginPath();
    for (let x = step; x < world.width; x += step) traceLine(context, x, 0, x, world.height, scale);
    for (let y = step; y < world.height; y += step) traceLine(context, 0, y, world.width, y, scale);
    strokeAs(context, colours.ink, width, alpha);
  };
  if (scale >= GRID_MIN) lines(1, 0.08, 1);
  lines(state.size, 0.4, 1);
}

function traceLine(context, x0, y0, x1, y1, scale) {
  context.moveTo(x0 * scale, y0 * scale);
  context.lineTo(x1 * scale, y1 * scale);
}

function strokeAs(context, colour, width, alpha = 1) {
  context.globalAlpha = alpha;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
  context.globalAlpha = 1;
}

function drawCone({ state, scale, colours }, context) {
  const { x, y, theta } = poseOf(state);
  const half = radians(state.fov) / 2;
  context.beginPath();
  if (state.fov < 360) context.moveTo(x * scale, y * scale);
  context.arc(x * scale, y * scale, state.range * scale, theta - half, theta + half);
  if (state.fov < 360) context.closePath();
  strokeAs(context, colours.halo, 3.5, 0.7);
  context.setLineDash([6, 4]);
  strokeAs(context, colours.sensor, 1.75);
  context.setLineDash([]);
}

// What the reading says of a cell, in a word.
function labelOf(said) {
  if (said.which === null) return "";
  return ["empty", "object", `q ${said.q.toFixed(2)}`][said.which];
}

function drawLabels(p, context) {
  const { cells, scale, colours, theme } = p;
  const side = cells.cellPx * scale;
  if (side < LABEL_MIN * theme.large) return;
  context.font = `${clamp(side / 5, 9, 14) * theme.large}px ${theme.font}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.strokeStyle = colours.halo;
  context.lineWidth = 3;
  context.fillStyle = colours.ink;
  for (let c = 0; c < cells.inView.length; c++) {
    const label = labelOf(saidOf(cells.empty[c], cells.object[c], p.constants));
    if (!label) continue;
    const [x, y] = [((c % cells.nCols) + 0.5) * side, (Math.floor(c / cells.nCols) + 0.5) * side];
    context.globalAlpha = 0.75;
    context.strokeText(label, x, y);
    context.globalAlpha = 1;
    context.fillText(label, x, y);
  }
}

function drawSelected({ state, scale, colours }, context) {
  const side = state.size * scale;
  context.beginPath();
  context.rect(state.col * side, state.row * side, side, side);
  strokeAs(context, colours.halo, 5);
  strokeAs(context, colours.crosshair, 2.5);
}

// The ray of the pixel at the pointer: whole up to the hit, dashed beyond it.
function drawRay(p, context) {
  const { scale, state, colours, hover } = p;
  const { ray, z } = pixelAt(p.world, poseOf(state), sensorOf(state), p.constants, hover.row, hover.col);
  context.beginPath();
  context.rect(hover.col * scale, hover.row * scale, scale, scale);
  strokeAs(context, colours.ink, 1.5);
  if (!ray || Number.isNaN(z)) return;
  const at = (t) => [ray.x + t * ray.ux, ray.y + t * ray.uy];
  const end = Math.min(z, state.range);
  const dashed = Math.max(end, ray.distance);
  context.beginPath();
  traceLine(context, ray.x, ray.y, ...at(end), scale);
  strokeAs(context, colours.halo, 3.5, 0.8);
  strokeAs(context, colours.ink, 1.5);
  context.beginPath();
  traceLine(context, ...at(end), ...at(dashed), scale);
  context.setLineDash([3, 3]);
  strokeAs(context, colours.ink, 1.5);
  context.setLineDash([]);
  if (end === z) drawHit(context, at(z), p);
}

function drawHit(context, [x, y], { scale, colours }) {
  context.beginPath();
  context.arc(x * scale, y * scale, 4, 0, 2 * Math.PI);
  context.fillStyle = colours.crosshair;
  context.fill();
  strokeAs(context, colours.halo, 1.5);
}

// Robot and handle are buttons, so that Tab reaches them.
function placeRobot({ root, state, scale }) {
  const { x, y, theta } = poseOf(state);
  const [robotX, robotY] = [x * scale, y * scale];
  const place = (name, left, top) => (partOf(root, name).style.transform = `translate(${left}px, ${top}px)`);
  place("robot", robotX, robotY);
  place("handle", robotX + HANDLE_AT * Math.cos(theta), robotY + HANDLE_AT * Math.sin(theta));
}
