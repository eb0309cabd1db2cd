// What is drawn on the stage's canvases, in px of the drawing.

const TWO_PI = 2 * Math.PI;
const ROBOT_RADIUS = 5; // on the screen, px
const BEAM_END = 3;

const PAINTERS = {
  drawing: (p, _, context) => {
    drawUnscaled(context, p.paper);
    drawPath(p, context);
    drawSensor(p, context, true);
  },
  map: (p, { column }, context) => {
    const { picture, log } = p.columns[column];
    drawPicture(picture, log, context);
    drawSensor(p, context, false);
  },
  difference: (p, _, context) => drawPicture(p.comparison.picture, p.comparison, context),
};

function drawStage(p) {
  if (p.scale === 0) return;
  for (const view of p.views) drawView(p, view);
}

function drawView(p, view) {
  const context = view.canvas.getContext("2d");
  const scale = p.scale * ratioOf(view.canvas);
  context.setTransform(scale, 0, 0, scale, 0, 0);
  PAINTERS[view.kind](p, view, context);
  drawRobot(p, context);
  const grid = gridUnder(p, view);
  if (p.pin) drawPin(p, grid, context);
  if (p.hover) drawCrosshair(p, grid, context);
}

// A picture that has the canvas's own pixels.
function drawUnscaled(context, picture) {
  context.save();
  context.resetTransform();
  context.drawImage(picture, 0, 0);
  context.restore();
}

// Strokes the path begun, with widths on the screen.
function stroke(p, context, colour, width, alpha = 1) {
  context.globalAlpha = alpha;
  context.strokeStyle = colour;
  context.lineWidth = (width * p.theme.large) / p.scale;
  context.stroke();
  context.globalAlpha = 1;
}

const poseOf = ({ poses }, index) => poses.subarray(3 * index, 3 * index + 3);

// The reading just taken; before the first one, the next reading.
const currentReading = ({ state }) => Math.max(0, state.step - 1);

function tracePath(scene, context, from, to) {
  context.beginPath();
  for (let i = from; i < to; i++) {
    const [x, y] = poseOf(scene, i);
    if (i === from) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
}

function drawPath(p, context) {
  const { path } = p.header.colours;
  const here = currentReading(p);
  context.lineJoin = "round";
  tracePath(p.scene, context, here, p.scene.nReadings);
  stroke(p, context, path, 1.2, 0.28);
  tracePath(p.scene, context, 0, here + 1);
  stroke(p, context, path, 1.5, 0.8);
}

function drawSensor(p, context, isFilled) {
  if (p.beams) drawBeams(p, context, isFilled);
  else drawCone(p, context, isFilled);
}

// The ends of a scan's beams that say something: [x, y, whether it is a hit].
function endsOf({ beams, scene }, index) {
  const { nBeams, reachPx, bearings, ranges } = beams;
  const [x, y, theta] = poseOf(scene, index);
  const ends = [];
  for (let b = 0; b < nBeams; b++) {
    const range = ranges[index * nBeams + b];
    if (range === NOTHING) continue;
    const [z, bearing] = [(range / REACH) * reachPx, theta + bearings[b]];
    ends.push([x + z * Math.cos(bearing), y + z * Math.sin(bearing), range < REACH]);
  }
  return ends;
}

function drawBeams(p, context, isFilled) {
  const { sensor, halo } = p.header.colours;
  const index = currentReading(p);
  const [x, y] = poseOf(p.scene, index);
  const ends = endsOf(p, index);
  context.beginPath();
  for (const [endX, endY] of ends) {
    context.moveTo(x, y);
    context.lineTo(endX, endY);
  }
  stroke(p, context, sensor, 1, isFilled ? 0.3 : 0.12);
  const side = BEAM_END / p.scale;
  context.beginPath();
  for (const [endX, endY, isHit] of ends) {
    if (isHit) context.rect(endX - side / 2, endY - side / 2, side, side);
  }
  stroke(p, context, halo, 1, 0.6);
  context.fillStyle = sensor;
  context.fill();
}

function drawCone(p, context, isFilled) {
  const { scene, scale } = p;
  const { sensor, halo } = p.header.colours;
  const [x, y, theta] = poseOf(scene, currentReading(p));
  const half = scene.fovRad / 2;
  const isCone = scene.fovRad < TWO_PI - 1e-6;
  context.beginPath();
  if (isCone) context.moveTo(x, y);
  context.arc(x, y, scene.rangePx, theta - half, theta + half);
  if (isCone) context.closePath();
  context.fillStyle = sensor;
  context.globalAlpha = p.state.step === 0 ? 0.08 : 0.18;
  if (isFilled) context.fill();
  stroke(p, context, halo, 3, 0.75);
  context.setLineDash([4 / scale, 3 / scale]);
  stroke(p, context, sensor, 1.5);
  context.setLineDash([]);
}

function drawRobot(p, context) {
  const { robot, halo } = p.header.colours;
  const [x, y, theta] = poseOf(p.scene, currentReading(p));
  const radius = ROBOT_RADIUS / p.scale;
  context.beginPath();
  context.arc(x, y, radius, 0, TWO_PI);
  context.fillStyle = robot;
  context.fill();
  context.moveTo(x, y);
  context.lineTo(x + radius * Math.cos(theta), y + radius * Math.sin(theta));
  stroke(p, context, halo, 1.5);
}

function drawPin(p, grid, context) {
  const { halo, crosshair } = p.header.colours;
  const { x, y, width, height } = boxOf(grid, cellHolding(grid, ...p.pin));
  const room = 2.5 / p.scale;
  context.beginPath();
  context.rect(x - room, y - room, width + 2 * room, height + 2 * room);
  stroke(p, context, halo, 4);
  stroke(p, context, crosshair, 2);
}

function drawCrosshair(p, grid, context) {
  const { crosshair } = p.header.colours;
  const { widthPx, heightPx } = grid;
  const cell = cellHolding(grid, ...p.hover);
  const { x, y, width, height } = boxOf(grid, cell);
  const [midX, midY] = centreOf(grid, cell);
  context.beginPath();
  context.moveTo(0, midY);
  context.lineTo(x, midY);
  context.moveTo(x + width, midY);
  context.lineTo(widthPx, midY);
  context.moveTo(midX, 0);
  context.lineTo(midX, y);
  context.moveTo(midX, y + height);
  context.lineTo(midX, heightPx);
  stroke(p, context, crosshair, 1, 0.55);
  context.beginPath();
  context.rect(x, y, width, height);
  stroke(p, context, crosshair, 1.5);
}
