// The stage as a figure: the maps as they are shown, with their settings and scores.

const FIGURE_WIDTH = 1200; // of all pictures together, px
const FIGURE_HEIGHT = 600;
const FIGURE_RATIO = 2; // pixels of a PNG to one px of the figure
const FIGURE_MARGIN = 16;
const SMALL = 13;

// A stage of its own, as large as a figure may be and drawn again for each step.
function newStill(p, most, ratio) {
  const { widthPx, heightPx } = p.scene;
  const gaps = (p.views.length - 1) * PANE_GAP + 2 * FIGURE_MARGIN;
  const scale = Math.min((most.width - gaps) / p.views.length / widthPx, most.height / heightPx);
  const size = { width: Math.round(widthPx * scale), height: Math.round(heightPx * scale) };
  const views = p.views.map((view) => {
    const canvas = offscreen(size.width * ratio, size.height * ratio);
    canvas.ratio = ratio;
    return { ...view, canvas };
  });
  const paper = isSeveral(p) ? null : scaledPreview({ ...p, views });
  return { size, scale, views, paper };
}

function figureOf(p, { size, scale, views, paper }) {
  const shown = { ...p, scale, views, paper, hover: null };
  for (const view of views) drawView(shown, view);
  const { paper: white, ink, line } = p.header.colours;
  const figure = { font: p.theme.font, colours: { paper: white, ink, line }, pictures: [], texts: [] };
  const places = views.map((_, i) => FIGURE_MARGIN + i * (size.width + PANE_GAP));
  const block = (i, items, y) => textBlock(figure, items, { x: places[i], y, width: size.width });
  const heads = views.map((view) => headItems(p, view));
  // Heads of one and of two lines end level.
  const top = Math.round(Math.max(...heads.map((items, i) => block(i, items, 8))) + 8);
  views.forEach(({ canvas }, i) => figure.pictures.push({ canvas, x: places[i], y: top, ...size }));
  const below = top + size.height + 4;
  const feet = Math.max(...views.map((view, i) => block(i, footItems(p, view), below)));
  const width = even(places.at(-1) + size.width + FIGURE_MARGIN);
  const all = { x: FIGURE_MARGIN, y: feet + 4, width: width - 2 * FIGURE_MARGIN };
  const height = even(textBlock(figure, lastItems(p), all) + FIGURE_MARGIN);
  return { ...figure, width, height };
}

// Films have an even number of pixels a side.
const even = (length) => 2 * Math.ceil(length / 2);

// ---- words -------------------------------------------------------------------------------

const textLine = (words, more = {}) => ({ words, size: SMALL, ...more });

function headItems(p, { kind, column }) {
  if (kind === "drawing") return [textLine(p.header.paper, { isBold: true })];
  if (kind === "difference") {
    return [textLine(p.header.hasTruth ? "Who is right" : "Where they differ", { isBold: true })];
  }
  if (p.state.compact) return [textLine(storyName(p, column), { isBold: true })];
  const name = textLine(isSeveral(p) ? `Map ${LETTERS[column]}` : "Map", { isBold: true });
  return [name, textLine(settingWords(p, column))];
}

const seenWords = (p) => (p.header.hasPrior ? WORDS.filter((word) => !isWordHidden(p, word)) : MORE_WORDS);

// The header of a map in full; what several maps share is said once below.
function settingWords(p, i) {
  const { columns: settings } = p.state;
  const isShown = (word) => !isSeveral(p) || MAIN_WORDS.includes(word) || differs(settings, word);
  return seenWords(p)
    .filter(isShown)
    .map((word) => fullLabel(p.header.texts.words, settings[i], word))
    .join("; ");
}

function fullLabel(words, setting, word) {
  const label = wordLabel(words, setting, word);
  if (word === "pair" && !setting.uninformative && !setting.calibrated) {
    return `p_wall ${setting.p_wall}, p_space ${setting.p_space}`;
  }
  if (word === "flaw" && setting.drawing_errors && !setting.uninformative) return setting.drawing_errors;
  return word === "rule" && setting.rule === "prior_once" ? `counted ${label}` : label;
}

function footItems(p, { kind, column }) {
  if (kind === "drawing") return [];
  if (kind === "difference") return differenceItems(p);
  if (p.state.compact) return [textLine(tallyWords(p, column))];
  return isScored(p) ? [textLine(scoreWords(p, column))] : [];
}

function differenceItems(p) {
  const { colours, hasTruth } = p.header;
  const words = (i) => (hasTruth ? `${LETTERS[i]} is right` : `wall in ${LETTERS[i]}`);
  const one = pairOfMaps(p).map((i) => textLine(words(i), { mark: colours.columns[i] }));
  return [...one, textLine("both: wall", { mark: colours.unseen })];
}

function lastItems(p) {
  const { state, header } = p;
  const rule = header.texts.story.rules[state.columns[0].rule];
  const words = [stepWords(p), ...(state.compact ? [`the drawing counted ${rule}`] : [])];
  const { note, keys } = overlayItems(header, state.overlay);
  const shared = isSeveral(p) && !state.compact ? agreement(header.texts.words, state.columns, seenWords(p)) : "";
  return [textLine(`${words.join("; ")}. ${note} ${shared}`), ...keys];
}

function overlayItems({ texts, colours }, overlay) {
  if (overlay === "errors") {
    const inks = { hit: colours.hit, false_wall: colours.falseWall, missed_wall: colours.missedWall };
    const keys = texts.errors.filter(({ mark }) => inks[mark]);
    return {
      note: "Hatched: not looked at.",
      keys: keys.map(({ mark, label }) => textLine(label, { mark: inks[mark] })),
    };
  }
  const tint = { truth: colours.groundTruth, wall_mask: colours.wallMask }[overlay];
  const label = texts.overlays.find(({ value }) => value === overlay)?.label;
  return {
    note: "White is free, black is occupied; hatched: not looked at.",
    keys: tint ? [textLine(label, { mark: tint })] : [],
  };
}

// ---- files -------------------------------------------------------------------------------

const CONTROLS_OF_FACTS = { flaw: "thickness_px", drawing_errors: "thickness_px", fov_rad: "fov_deg" };

// What a file says of itself. The address may be a step behind while the maps play.
function factsOf(p) {
  const { columns, overlay, step, pin_px } = p.state;
  const { nReadings, rangePx, fovRad } = p.scene;
  const link = new URL(window.location.href);
  link.searchParams.set("step", step);
  const told = (values) => toldValues(values, p.header.hidden, CONTROLS_OF_FACTS);
  const shared = { overlay, step, pin_px, n_readings: nReadings, range_px: rangePx, fov_rad: fovRad };
  const own = columns.map(({ flaw, ...one }) => told(one.drawing_errors ? one : { ...one, flaw }));
  const settings = { columns: own, ...told(shared) };
  return { title: pageTitle(), software: p.header.software, link: link.href, settings };
}

const fileName = (p, ending) => `${fileStem()}_reading_${p.state.step}.${ending}`;

const stillOf = (p) =>
  figureOf(p, newStill(p, { width: FIGURE_WIDTH, height: FIGURE_HEIGHT }, FIGURE_RATIO));

async function savedPng(p) {
  return { blob: await figurePng(stillOf(p), FIGURE_RATIO, factsOf(p)), name: fileName(p, "png") };
}

const savedSvg = (p) => ({ blob: figureSvg(stillOf(p), factsOf(p)), name: fileName(p, "svg") });

function buildSaving(p) {
  const film = filmType();
  const items = [
    { label: "Figure of this view, PNG", save: () => savedPng(p) },
    { label: "Figure of this view, SVG", save: () => savedSvg(p) },
    { label: "Replay, GIF", save: (tell) => savedGif(p, tell) },
    film && {
      label: `Replay, ${film.label}`,
      about: "recorded as it plays; closing this menu stops it",
      save: (tell) => savedFilm(p, film, tell),
    },
  ];
  const menu = saveMenu(items.filter(Boolean));
  menu.addEventListener("toggle", () => {
    if (!menu.open) p.film = null; // a closed menu stops what is being saved
  });
  p.root.querySelector(".transport").append(menu);
}
