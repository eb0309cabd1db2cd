// What is drawn on the two canvases, in px of the drawing.

const TWO_PI = 2 * Math.PI;
const ROBOT_RADIUS = 5; // on the screen, px

function drawStage(p) {
  if (p.scale === 0) return;
  drawOn(p, p.canvases.drawing, (context) => {
    drawUnscaled(context, p.paper);
    drawPath(p, context);
    drawSensor(p, context, true);
  });
  drawOn(p, p.canvases.map, (context) => {
    drawPicture(p.picture, p.model, context);
    drawSensor(p, context, false);
  });
}

function drawOn(p, canvas, drawBelow) {
  const context = canvas.getContext("2d");
  const scale = p.scale * pixelRatio();
  context.setTransform(scale, 0, 0, scale, 0, 0);
  drawBelow(context);
  drawRobot(p, context);
  if (p.pin !== null) drawPin(p, context);
  if (p.hover !== null) drawCrosshair(p, context);
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
  context.lineWidth = width / p.scale;
  context.stroke();
  context.globalAlpha = 1;
}

const poseOf = ({ poses }, index) => poses.subarray(3 * index, 3 * index + 3);

// The reading just taken; before the first one, the next reading.
const currentReading = (model) => Math.max(0, model.step - 1);

function tracePath(model, context, from, to) {
  context.beginPath();
  for (let i = from; i < to; i++) {
    const [x, y] = poseOf(model, i);
    if (i === from) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
}

function drawPath(p, context) {
  const { path } = p.header.colours;
  const here = currentReading(p.model);
  context.lineJoin = "round";
  tracePath(p.model, context, here, p.model.nReadings);
  stroke(p, context, path, 1.2, 0.28);
  tracePath(p.model, context, 0, here + 1);
  stroke(p, context, path, 1.5, 0.8);
}

function drawSensor(p, context, isFilled) {
  const { model, scale } = p;
  const { sensor, halo } = p.header.colours;
  const [x, y, theta] = poseOf(model, currentReading(model));
  const half = model.fovRad / 2;
  const isCone = model.fovRad < TWO_PI - 1e-6;
  context.beginPath();
  if (isCone) context.moveTo(x, y);
  context.arc(x, y, model.rangePx, theta - half, theta + half);
  if (isCone) context.closePath();
  context.fillStyle = sensor;
  context.globalAlpha = model.step === 0 ? 0.08 : 0.18;
  if (isFilled) context.fill();
  stroke(p, context, halo, 3, 0.75);
  context.setLineDash([4 / scale, 3 / scale]);
  stroke(p, context, sensor, 1.5);
  context.setLineDash([]);
}

function drawRobot(p, context) {
  const { robot, halo } = p.header.colours;
  const [x, y, theta] = poseOf(p.model, currentReading(p.model));
  const radius = ROBOT_RADIUS / p.scale;
  context.beginPath();
  context.arc(x, y, radius, 0, TWO_PI);
  context.fillStyle = robot;
  context.fill();
  context.moveTo(x, y);
  context.lineTo(x + radius * Math.cos(theta), y + radius * Math.sin(theta));
  stroke(p, context, halo, 1.5);
}

function drawPin(p, context) {
  const { halo, crosshair } = p.header.colours;
  const { x, y, width, height } = boxOf(p.model, p.pin);
  const room = 2.5 / p.scale;
  context.beginPath();
  context.rect(x - room, y - room, width + 2 * room, height + 2 * room);
  stroke(p, context, halo, 4);
  stroke(p, context, crosshair, 2);
}

function drawCrosshair(p, context) {
  const { crosshair } = p.header.colours;
  const { widthPx, heightPx } = p.model;
  const { x, y, width, height } = boxOf(p.model, p.hover);
  const [midX, midY] = centreOf(p.model, p.hover);
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
