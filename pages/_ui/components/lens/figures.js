// The stage as a figure, with the numbers of the selected cell.

const FIGURE_MARGIN = 16;

function lensFigure(p) {
  const { canvas, theme, colours } = p;
  const { clientWidth: width, clientHeight: height } = canvas;
  const box = { x: FIGURE_MARGIN, y: FIGURE_MARGIN, width, height };
  const { paper, ink, unsaid: line } = colours;
  const figure = { font: theme.font, colours: { paper, ink, line }, texts: [] };
  const items = [...cellItems(p), ...keyItems(p)].map((item) => ({ size: 13, ...item }));
  const end = textBlock(figure, items, { ...box, y: box.y + height + 4 });
  figure.pictures = [{ canvas: withRobot(p), ...box }];
  return { ...figure, width: width + 2 * FIGURE_MARGIN, height: Math.ceil(end) + FIGURE_MARGIN };
}

// On the page robot and handle are buttons above the canvas.
function withRobot({ canvas, state, scale, colours }) {
  const copy = offscreen(canvas.width, canvas.height);
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  context.scale(canvas.width / canvas.clientWidth, canvas.height / canvas.clientHeight);
  const { x, y, theta } = poseOf(state);
  context.beginPath();
  context.arc(x * scale, y * scale, 8, 0, 2 * Math.PI);
  context.fillStyle = colours.robot;
  context.fill();
  context.moveTo(x * scale, y * scale);
  context.lineTo(x * scale + 8 * Math.cos(theta), y * scale + 8 * Math.sin(theta));
  strokeAs(context, colours.halo, 2);
  return copy;
}

function cellItems(p) {
  const { q, pFree, which } = selectedOf(p);
  const { range, fov, size } = toldTexts(p);
  const parts = [range && `range ${range} px`, fov && `field of view ${fov} degrees`, size && `cells of ${size} px`];
  const sensor = parts.filter(Boolean).join(", ");
  const says = which === null ? "" : `; q = ${inHundredths(q)}, p_free(reading) = ${inHundredths(pFree)}`;
  return [{ words: `The ${cellWords(p)}${says}.`, isBold: true }, { words: sensor && `Sensor: ${sensor}.` }];
}

const CONTROLS_OF_TEXTS = {
  range: "range_px",
  fov: "fov_deg",
  size: "lens_cell_px",
  behind: "behind_hit",
  clear: "clear_no_hit",
  prior: "p_wall",
};

const toldTexts = (p) => toldValues(textsOf(p.state), p.header.hidden, CONTROLS_OF_TEXTS);

const keyItems = ({ colours }) => [
  { words: "empty", mark: colours.empty },
  { words: "object, wall", mark: colours.object },
  { words: "object, but only hidden", mark: colours.hidden },
  { words: "wall, not read", mark: colours.wall },
];

function lensFacts(p) {
  const link = new URL(window.location.href);
  return { title: pageTitle(), software: p.header.software, link: link.href, settings: toldTexts(p) };
}

function buildSaving(p) {
  const ratio = () => p.canvas.width / p.canvas.clientWidth;
  const named = (blob, ending) => ({ blob, name: `${fileStem()}.${ending}` });
  const png = async () => named(await figurePng(lensFigure(p), ratio(), lensFacts(p)), "png");
  const svg = () => named(figureSvg(lensFigure(p), lensFacts(p)), "svg");
  const menu = saveMenu([
    { label: "Figure of this reading, PNG", save: png },
    { label: "Figure of this reading, SVG", save: svg },
  ]);
  p.root.querySelector(".under").append(menu);
}
