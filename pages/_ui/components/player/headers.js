// Several maps: the header of each is its setting. A word of it is a list to choose from;
// what differs between the maps is bold, what agrees is said once above.

// The words of a header: those that always stand in it, then those that do so only where
// the maps differ or the header is open.
const MAIN_WORDS = ["drawing", "pair", "rule"];
const MORE_WORDS = ["flaw", "behind_hit", "cell_px", "model", "laps"];
const WORDS_OF_COUNTS = ["model", "cell_px"]; // counts of beams take no prior
const WORDS = [...MAIN_WORDS, ...MORE_WORDS];
const BY_HAND = "hand";

// ---- settings as words: independent of the page -----------------------------------------

const pairValue = ({ p_wall, p_space, calibrated }) => (calibrated ? "calibrated" : `${p_wall},${p_space}`);

// The value that stands for a word of a setting.
function wordValue(setting, word) {
  if (countsBeams(setting) && !WORDS_OF_COUNTS.includes(word)) return "none";
  if (word === "drawing") return setting.uninformative ? "none" : setting.prior_drawing;
  if (word === "pair") return setting.uninformative ? "half" : pairValue(setting);
  // Without a drawing its errors make no difference.
  if (word === "flaw" && setting.uninformative) return "none";
  return String(setting[word]);
}

// What a choice of a word changes in a setting.
function wordChanges(word, value) {
  if (word === "drawing") {
    return value === "none" ? { uninformative: true } : { uninformative: false, prior_drawing: value };
  }
  if (word === "pair") {
    if (value === "calibrated") return { calibrated: true };
    const [p_wall, p_space] = value.split(",").map(Number);
    return { calibrated: false, p_wall, p_space };
  }
  return { [word]: word === "cell_px" ? Number(value) : value };
}

const differs = (settings, word) => {
  const values = settings.map((setting) => wordValue(setting, word));
  // A map without a drawing has neither pair nor errors of one.
  const isKnown = (value, i) =>
    value !== "half" && (value !== "none" || (word === "drawing" && !countsBeams(settings[i])));
  const known = values.filter(isKnown);
  return known.some((value) => value !== known[0]);
};

function wordLabel(words, setting, word) {
  const value = wordValue(setting, word);
  if (value === "half") return "one half";
  if (word === "pair") return setting.calibrated ? "calibrated" : value.replace(",", ", ");
  // A link may give any size of a cell; the list has some.
  const own = word === "cell_px" ? `${value} px cells` : value;
  return words[word].find((option) => option.value === value)?.label ?? own;
}

// What all maps share, in words.
function agreement(words, settings, seen = WORDS) {
  const isBlank = (setting) => setting.uninformative || countsBeams(setting);
  // A map without a drawing shares no pair; of errors, only one with a drawing tells.
  const isShared = (word) => !differs(settings, word) && !(word === "pair" && settings.some(isBlank));
  const said = settings.every(countsBeams) ? WORDS_OF_COUNTS : WORDS.filter((word) => word !== "model");
  const same = seen.filter((word) => said.includes(word) && isShared(word));
  const first = settings.find((setting) => !isBlank(setting)) ?? settings.find((one) => !countsBeams(one)) ?? settings[0];
  // One lap is what everybody takes for granted.
  const isTold = (word) => !(word === "laps" ? ["none", "1"] : ["none"]).includes(wordValue(first, word));
  const told = same.filter((word) => word === "drawing" || isTold(word));
  const labels = told.map((word) => wordLabel(words, first, word));
  const readings = same.includes("behind_hit") && same.includes("cell_px") ? "readings" : "tour";
  return `Same building and ${readings}${labels.length ? `: ${labels.join(", ")}` : ""}.`;
}

// ---- the header of a map ------------------------------------------------------------------

function newHeader(p, i) {
  const header = element("div", { class: "header", "data-header": i });
  header.append(element("span", { class: `letter letter-${i}` }, LETTERS[i]));
  for (const word of WORDS) header.append(newWord(p, i, word));
  const more = element("button", { type: "button", class: "more", "aria-expanded": "false" }, "more");
  more.setAttribute("aria-label", `More settings of map ${LETTERS[i]}`);
  more.addEventListener("click", () => {
    p.open = p.open === i ? null : i;
    showHeaders(p);
  });
  const hand = element("div", { class: "hand", hidden: "" });
  for (const name of ["p_wall", "p_space"]) hand.append(handSlider(p, i, name));
  header.append(more, hand);
  return header;
}

// A list that lies unseen over its word: as wide as the word, with the browser's own keys.
function newWord(p, i, word) {
  const name = `${p.header.texts.wordNames[word]} of map ${LETTERS[i]}`;
  const select = element("select", { "aria-label": name, "data-word": word });
  const options = word === "pair" ? [] : p.header.texts.words[word];
  select.append(...options.map(({ value, label }) => element("option", { value }, label)));
  select.addEventListener("change", () => chooseWord(p, i, word, select.value));
  return element("span", { class: "word", "data-for": word }, element("span"), select);
}

function handSlider(p, i, name) {
  const label = `${name} of map ${LETTERS[i]}`;
  const input = element("input", { type: "range", "aria-label": label, "data-hand": name });
  Object.assign(input, p.header.limits[name]);
  input.addEventListener("input", () => {
    Object.assign(p.state.columns[i], movedTo(p, name, Number(input.value)), { calibrated: false });
    recolour(p);
  });
  input.addEventListener("change", () => commit(p, COMMIT_DELAY));
  return element("label", {}, element("span", {}, ...maths(name)), input);
}

function chooseWord(p, i, word, value) {
  if (word === "pair") p.byHand[i] = value === BY_HAND;
  if (value !== BY_HAND) Object.assign(p.state.columns[i], wordChanges(word, value));
  if (recolour(p)) commit(p, COMMIT_DELAY);
}

function showHeaders(p) {
  const { columns: settings } = p.state;
  const { words } = p.header.texts;
  const seen = WORDS.filter((word) => !isWordHidden(p, word));
  setText(partOf(p.root, "same"), agreement(words, settings, seen));
  settings.forEach((setting, i) => {
    const header = p.root.querySelector(`[data-header="${i}"]`);
    for (const box of header.querySelectorAll(".word")) {
      const word = box.dataset.for;
      const isBold = differs(settings, word);
      const isMain = MAIN_WORDS.includes(word) && !(word === "pair" && setting.uninformative);
      const fits = !countsBeams(setting) || WORDS_OF_COUNTS.includes(word);
      box.hidden = !fits || !seen.includes(word) || !(isMain || isBold || p.open === i);
      box.lastChild.disabled = isWordLocked(p, word);
      box.classList.toggle("differs", isBold);
      setText(box.firstChild, wordLabel(words, setting, word));
      if (word === "pair") fillPairs(p, box.lastChild, setting);
      else box.lastChild.value = wordValue(setting, word);
    }
    const more = header.querySelector(".more");
    more.hidden = !MORE_WORDS.some((word) => seen.includes(word));
    more.setAttribute("aria-expanded", String(p.open === i));
    showHand(p, header, setting, i);
  });
}

function fillPairs(p, select, setting) {
  const given = p.header.texts.words.pair;
  const value = pairValue(setting);
  const own = given.some((one) => one.value === value) ? [] : [{ value, label: value.replace(",", ", ") }];
  const options = [...given, ...own, { value: BY_HAND, label: "by hand\u2026" }];
  select.replaceChildren(...options.map((one) => element("option", { value: one.value }, one.label)));
  select.value = value;
}

function showHand(p, header, setting, i) {
  const hand = header.querySelector(".hand");
  hand.hidden = !p.byHand[i] || setting.uninformative || countsBeams(setting);
  for (const input of hand.querySelectorAll("input")) {
    input.value = setting[input.dataset.hand];
    input.disabled = isLocked(p, input.dataset.hand);
  }
}
