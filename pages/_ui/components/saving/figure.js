// A figure: pictures and lines of text on white paper, for slides and reports, whatever
// the theme of the page. Painted on a canvas, or written as PNG or as SVG.
//
// figure = {width, height, font, colours: {paper, ink, line}, pictures, texts}, in px;
// picture = {canvas, x, y, width, height}; text = {x, y, words, size, isBold, mark}, with
// y its baseline and mark the colour of a square before it.

const MARK_PX = 10;
const MARK_ROOM = 15;
const LEADING = 1.35;

const fontOf = ({ font }, { size, isBold }) => `${isBold ? 600 : 400} ${size}px ${font}`;

const wordsAt = ({ x, mark }) => x + (mark ? MARK_ROOM : 0);

const markBox = ({ x, y }) => ({ x, y: y - MARK_PX + 1, width: MARK_PX, height: MARK_PX });

// A canvas may be given; its size follows the figure.
function paintFigure(figure, ratio, canvas = offscreen(1, 1)) {
  const { width, height, colours, pictures, texts } = figure;
  const size = [width, height].map((side) => Math.round(side * ratio));
  if (canvas.width !== size[0]) canvas.width = size[0];
  if (canvas.height !== size[1]) canvas.height = size[1];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = colours.paper;
  context.fillRect(0, 0, width, height);
  context.imageSmoothingEnabled = false;
  for (const { canvas: picture, ...box } of pictures) {
    context.drawImage(picture, box.x, box.y, box.width, box.height);
    context.strokeStyle = colours.line;
    context.lineWidth = 1;
    context.strokeRect(box.x - 0.5, box.y - 0.5, box.width + 1, box.height + 1);
  }
  for (const text of texts) paintText(figure, text, context);
  return canvas;
}

function paintText(figure, text, context) {
  const box = markBox(text);
  context.fillStyle = text.mark;
  if (text.mark) context.fillRect(box.x, box.y, box.width, box.height);
  context.font = fontOf(figure, text);
  context.fillStyle = figure.colours.ink;
  context.fillText(text.words, wordsAt(text), text.y);
}

// ---- files -------------------------------------------------------------------------------

// facts = {title, software, link, settings}: what the figure shows, and where.
async function figurePng(figure, ratio, facts) {
  const canvas = paintFigure(figure, ratio);
  const blob = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  return pngWithText(new Uint8Array(await blob.arrayBuffer()), {
    Title: facts.title,
    Software: facts.software,
    Source: facts.link,
    Description: ascii(JSON.stringify(facts.settings)),
  });
}

// What is hidden on the page is not told by a file of it: values without those whose control
// is hidden, which has their own name or the one given for it.
function toldValues(values, hidden, controls) {
  const isTold = ([name]) => !hidden.includes(controls[name] ?? name);
  return Object.fromEntries(Object.entries(values).filter(isTold));
}

const ascii = (text) =>
  text.replace(/[^\0-~]/g, (letter) => `\\u${letter.charCodeAt(0).toString(16).padStart(4, "0")}`);

// Words stay words, which a reader can search and edit; maps are pixels.
function figureSvg({ width, height, ...figure }, facts) {
  const svg = svgPart("svg", { width, height, viewBox: `0 0 ${width} ${height}` });
  svg.append(svgPart("title", {}, facts.title), svgPart("metadata", {}, JSON.stringify(facts)));
  svg.append(svgPart("rect", { width, height, fill: figure.colours.paper }));
  for (const { canvas, ...box } of figure.pictures) {
    svg.append(svgPart("image", { ...box, href: canvas.toDataURL(), style: "image-rendering:pixelated" }));
    svg.append(svgPart("rect", { ...box, fill: "none", stroke: figure.colours.line }));
  }
  for (const text of figure.texts) {
    if (text.mark) svg.append(svgPart("rect", { ...markBox(text), fill: text.mark }));
    const { size, isBold } = text;
    const looks = { "font-family": figure.font, "font-size": size, "font-weight": isBold ? 600 : 400 };
    const place = { x: wordsAt(text), y: text.y, fill: figure.colours.ink };
    svg.append(svgPart("text", { ...place, ...looks }, text.words));
  }
  return new Blob([new XMLSerializer().serializeToString(svg)], { type: "image/svg+xml" });
}

function svgPart(tag, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// ---- lines of text -----------------------------------------------------------------------

// Items {words, size, isBold, mark} one below the other, broken at the width; the height.
function textBlock(figure, items, { x, y, width }) {
  const pen = offscreen(1, 1).getContext("2d");
  for (const item of items) {
    pen.font = fontOf(figure, item);
    const room = width - (item.mark ? MARK_ROOM : 0);
    brokenWords(pen, item.words, room).forEach((words, i) => {
      y += item.size * LEADING;
      figure.texts.push({ ...item, words, x, y, mark: i === 0 ? item.mark : undefined });
    });
  }
  return y;
}

function brokenWords(pen, text, width) {
  const lines = [];
  for (const word of text.split(" ")) {
    const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
    if (lines.length && pen.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}
