// Small helpers for the page. Outside text is inserted as text, never as HTML.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// The names of the model's quantities as mathematics: letter and subscript.
function maths(text) {
  const parts = text.split(/\b([pl])_(wall|space|free|occupied|0)\b/);
  const nodes = [];
  for (let i = 0; i < parts.length; i += 3) {
    nodes.push(parts[i]);
    if (i + 2 < parts.length) nodes.push(element("i", {}, parts[i + 1]), element("sub", {}, parts[i + 2]));
  }
  return nodes;
}

const partOf = (root, name) => root.querySelector(`[data-part=${name}]`);

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

// What an exercise or a teacher hides and locks: Python holds the values, the controls
// obey. Each names itself; what is hidden cannot be moved by a key either.
function obeyLimits(root, { hidden, locked }) {
  for (const box of root.querySelectorAll("[data-control]")) {
    const name = box.dataset.control;
    box.hidden = hidden.includes(name);
    const isLocked = box.hidden || locked.includes(name);
    const inputs = box.matches("button") ? [box] : box.querySelectorAll("button, input, select");
    for (const input of inputs) input.disabled = isLocked;
  }
}

// Canvas pixels to one CSS pixel.
const pixelRatio = () => Math.min(3, window.devicePixelRatio || 1);

// A canvas that is not on the page may have a ratio of its own.
const ratioOf = (canvas) => canvas.ratio ?? pixelRatio();

function offscreen(width, height) {
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(1, width);
  canvas.height = Math.max(1, height);
  return canvas;
}

// Gives a canvas the pixels of its box on the page; returns its context in CSS px.
function fitted(canvas) {
  const ratio = pixelRatio();
  const { clientWidth: width, clientHeight: height } = canvas;
  const size = [Math.round(width * ratio), Math.round(height * ratio)];
  // Setting a size clears a canvas and is slow, even if the size stays the same.
  if (canvas.width !== size[0]) canvas.width = size[0];
  if (canvas.height !== size[1]) canvas.height = size[1];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
