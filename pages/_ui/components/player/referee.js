// The difference of two maps: its picture, and the referee's count beside it.

function newReferee(p, { hasTruth }) {
  const counts = {};
  const button = (name) => {
    const about = "Pin the next such cell";
    counts[name] = element("button", { type: "button", class: "count", "data-count": name, title: about });
    counts[name].addEventListener("click", () => pinNext(p, name));
    return counts[name];
  };
  const names = [element("b"), element("b")];
  const units = [element("span"), element("span")];
  const line = (where, from, to) => {
    const more = [names[0].cloneNode(), names[1].cloneNode()];
    const text = element("p", {}, from, button(`${where} 2`), units[where === "looked" ? 0 : 1], to);
    const verb = hasTruth ? " is right " : " declares a wall ";
    const last = element("span", { class: "unbroken" }, more[1], " ", button(`${where} 1`), ".");
    text.append(more[0], verb, button(`${where} 0`), " times, ", last);
    return { text, more };
  };
  const looked = line("looked", "They judge ", " differently. ");
  const unseen = line("unseen", "They judge ", " differently. ");
  const pairing = element("select", { "data-part": "pairing", "aria-label": "Maps compared" });
  pairing.addEventListener("change", () => {
    p.pairing = pairing.value;
    recompare(p);
    refresh(p);
  });
  const note = element("p", { class: "note" });
  const root = element("div", { class: "foot referee" }, pairing, looked.text, unseen.text, note);
  return { root, counts, units, pairing, note, names: [looked.more, unseen.more] };
}

const pairOfMaps = ({ pairing }) => (pairing ?? "01").split("").map(Number);

// Compares the chosen pair again; after a change of either map.
function recompare(p) {
  if (!isSeveral(p)) return;
  if (pairOfMaps(p)[1] >= p.columns.length) p.pairing = "01";
  const [a, b] = pairOfMaps(p);
  const { colours, hasTruth } = p.header;
  p.comparison = newComparison(p.columns[a], p.columns[b], p.scene.pixels, hasTruth);
  const inks = [colours.free, colours.columns[a], colours.columns[b], colours.unseen];
  p.comparison.picture = newPicture(p.comparison, colours);
  p.comparison.inks = inks.map((hex) => pixelOf(rgbOf(hex)));
  for (let u = 0; u < p.comparison.nCells; u++) paintUnit(p.comparison, u);
}

// Where both maps agree, their walls are grey.
function paintUnit(comparison, u) {
  const { picture, inks, codes, nCols } = comparison;
  const code = codes[u];
  const ink = code & 3 || (verdictsAt(comparison, u)[0] ? 3 : 0);
  setPixel(picture.cells, nCols, u, inks[ink]);
  setPixel(picture.unseen, nCols, u, code & LOOKED ? 0 : OPAQUE);
}

// Judges again what a step changed: entries by log.
function rejudge(comparison, changed) {
  const logs = new Set(comparison.pair.map(({ log }) => log));
  for (const log of logs) {
    const [from, to] = changed.get(log);
    for (let e = from; e < to; e++) {
      eachUnit(comparison, log, log.cell[e], (u) => {
        judge(comparison, u);
        paintUnit(comparison, u);
      });
    }
  }
}

// ---- the count in words ------------------------------------------------------------------

function showReferee(p) {
  const { counts, units, pairing, note, names } = p.referee;
  const pair = pairOfMaps(p);
  const unit = p.comparison.isByCell ? "cells" : "pixels";
  setText(units[0], ` looked-at ${unit}`);
  setText(units[1], ` ${otherUnits(p.comparison, unit)}`);
  for (const pairNames of names) pair.forEach((i, at) => setText(pairNames[at], LETTERS[i]));
  for (const where of ["looked", "unseen"]) {
    const { differ, right } = countsOf(p.comparison, where === "looked");
    [...right, differ].forEach((n, i) => {
      setText(counts[`${where} ${i}`], grouped(n));
      counts[`${where} ${i}`].disabled = n === 0;
    });
  }
  pairing.hidden = p.columns.length < 3;
  pairing.value = pair.join("");
  p.differenceKeys.replaceChildren(
    ...pair.map((i) => legendKey(`column${i}`, p.header.hasTruth ? `${LETTERS[i]} is` : `wall in ${LETTERS[i]}`)),
    legendKey("unseen", "both: wall"),
  );
  setText(note, p.comparison.isByCell ? "" : SIZES_DIFFER);
}

// Where both maps have the same readings, none of the others was looked at; else one of the
// maps may have a reading of it.
function otherUnits({ pair: [a, b] }, unit) {
  return a.log === b.log ? `${unit} not looked at` : `other ${unit}`;
}

const SIZES_DIFFER =
  "The cell sizes differ, so the maps are compared pixel by pixel, against the world's pixels.";

function buildPairing(p) {
  const pairs = ["01", "02", "12"].filter((pair) => Number(pair[1]) < p.columns.length);
  const option = (value) => element("option", { value }, value.replace(/./g, (i) => ` ${LETTERS[i]}`));
  p.referee.pairing.replaceChildren(...pairs.map(option));
}

// The next cell of a count after the pinned one: index 2 counts both maps.
function pinNext(p, name) {
  const [where, who] = name.split(" ");
  const after = p.pin ? cellHolding(p.comparison, ...p.pin) : -1;
  const whos = who === "2" ? [0, 1] : [Number(who)];
  const unit = nextDifference(p.comparison, whos, where === "looked", after);
  if (unit === null) return;
  pause(p);
  setPin(p, centreOf(p.comparison, unit));
}

function differenceFacts(p, u) {
  const verdicts = verdictsAt(p.comparison, u).map((isWall) => (isWall ? "wall" : "no wall"));
  const maps = pairOfMaps(p).map((i, at) => [`${LETTERS[i]} declares`, verdicts[at]]);
  if (!p.header.hasTruth) return maps;
  return [...maps, ["truth", p.comparison.truth[u] ? "wall" : "free"]];
}
