// Below each map: its scores, looked at and not looked at, beside the blank map's; or the
// ladder of the pinned cell. One map has these beside its charts.

const TABLE_REGIONS = ["looked", "unseen"];

function buildFeet(p) {
  const maps = p.views.filter(({ kind }) => kind === "map");
  partOf(p.root, "table").replaceChildren();
  partOf(p.root, "feet").replaceChildren();
  for (const view of maps) {
    view.table = newTable(p);
    if (!isSeveral(p)) {
      partOf(p.root, "table").append(view.table.root);
      view.ladderCanvas = partOf(p.root, "terms");
      listenToLadder(p, view);
    } else {
      partOf(p.root, "feet").append(newFoot(p, view));
    }
  }
  if (isSeveral(p)) partOf(p.root, "feet").append(p.referee.root);
}

function newFoot(p, view) {
  const name = LETTERS[view.column];
  const letter = element("span", { class: `letter letter-${view.column}` }, name);
  const naming = { class: "terms", role: "img", "aria-label": `Log-odds of the pinned cell, map ${name}` };
  view.ladderCanvas = element("canvas", naming);
  view.verdict = element("p", { class: "verdict" });
  listenToLadder(p, view);
  const scores = element("div", { "data-panel": "scores" }, view.table.root);
  const ladder = element("div", { "data-panel": "cell" }, view.ladderCanvas, view.verdict);
  return element("div", { class: "foot" }, letter, scores, ladder);
}

// ---- the table of scores -----------------------------------------------------------------

function newTable(p) {
  const cells = {};
  const heads = { looked: element("span"), unseen: element("span") };
  const head = element("tr", {}, element("td"));
  for (const region of TABLE_REGIONS) {
    head.append(element("th", { scope: "col" }, heads[region]));
    head.append(element("th", { scope: "col", class: "blank" }, "blank"));
  }
  const rows = p.header.texts.scores.map(({ name, label, meaning }) => {
    const row = element("tr", {}, element("th", { scope: "row", title: meaning }, label));
    for (const region of TABLE_REGIONS) {
      cells[`${region} ${name}`] = element("td", { "data-value": `${region} ${name}` });
      cells[`blank ${region} ${name}`] = element("td", { class: "blank" });
      row.append(cells[`${region} ${name}`], cells[`blank ${region} ${name}`]);
    }
    return row;
  });
  const worth = element("p", { class: "worth" });
  const table = element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows));
  return { root: element("div", { class: "table" }, table, worth), cells, heads, worth };
}

function showTables(p) {
  if (!p.header.hasTruth) return;
  for (const { table, column } of p.views) if (table) showTable(p, table, column);
}

function showTable(p, { cells, heads, worth }, column) {
  const { step, columns: settings } = p.state;
  const [{ series, blank, log }, setting] = [p.columns[column], settings[column]];
  const share = series.coverage[step];
  setText(heads.looked, `looked at (${percent(share).replace(" ", "\u00a0")})`);
  setText(heads.unseen, "not looked at");
  for (const { name, unit } of p.header.texts.scores) {
    for (const region of TABLE_REGIONS) {
      const { text } = UNITS[unit];
      setText(cells[`${region} ${name}`], text(series[region][name][step]));
      setText(cells[`blank ${region} ${name}`], log.coded ? DASH : text(blank[region][name][step]));
    }
  }
  setText(worth, setting.uninformative || log.coded ? "" : worthWords(series, blank, step));
}

// How many readings without a drawing are as good as the map is now.
function worthWords(series, blank, step) {
  const bits = worthInReadings(blank.all.bits, series.all.bits, step, -1);
  const knows = `Blank map: as few bits (all cells) ${whenWords(bits)}`;
  if (Number.isNaN(series.looked.f2[step])) return knows;
  const n = worthInReadings(blank.looked.f2, series.looked.f2, step, 1);
  return `${knows}; this F2 (looked at by then) ${whenWords(n)}`;
}

const whenWords = (n) => (n === null ? "never on this tour" : `after ${n} ${n === 1 ? "reading" : "readings"}`);

// ---- ladders -----------------------------------------------------------------------------

function listenToLadder(p, view) {
  const canvas = view.ladderCanvas;
  canvas.addEventListener("click", (event) => {
    const bar = barAt(view.ladder, event);
    if (bar) walkTo(p, bar.term ? bar.term.reading + 1 : 0);
  });
  canvas.addEventListener("pointermove", (event) => {
    const bar = barAt(view.ladder, event);
    if (bar) showCard(p, event, ...termCard(p.columns[view.column], bar));
    else hideCard(p);
  });
  canvas.addEventListener("pointerleave", () => hideCard(p));
}

// All ladders of a cell have one scale, so that equal readings are equally high.
function showLadders(p) {
  const maps = p.views.filter(({ kind }) => kind === "map");
  const bars = maps.map(({ column }) => {
    const map = p.columns[column];
    return ladderOf(historyOf(map, cellHolding(map.log, ...p.pin)), p.state.step);
  });
  const ends = bars.flat().flatMap(({ from, to }) => [from, to]);
  p.termRange = [Math.min(-1, ...ends), Math.max(1, ...ends)];
  maps.forEach((view, i) => {
    view.ladder = drawLadder(p, view.ladderCanvas, bars[i]);
    if (view.verdict) setText(view.verdict, verdictWords(p, p.columns[view.column]));
  });
}

// The last rung, in words.
function verdictWords({ header, pin }, column) {
  const c = cellHolding(column.log, ...pin);
  const logOdds = logOddsAt(column, c);
  const verdict = declaresWall(column, logOdds) ? "wall" : "no wall";
  if (column.log.coded) return countWords(header, column, c, verdict);
  const words = `Free with probability ${probability(pFreeOf(logOdds))}: declared ${verdict}`;
  return header.hasTruth ? `${words}; in truth ${column.log.truth[c] ? "wall" : "free"}` : words;
}

function countWords({ hasTruth }, { log }, c, verdict) {
  const { hits, visits } = beamsOf(log, c);
  const words = `${grouped(hits)} of ${grouped(visits)} beams end here: declared ${verdict}`;
  return hasTruth ? `${words}; in truth ${log.truth[c] ? "wall" : "free"}` : words;
}

function termCard(column, { term, to, isOff }) {
  if (!term)
    return [
      "Prior",
      [
        ["l_0", signed(to, 3)],
        ["p_free", probability(pFreeOf(to))],
      ],
    ];
  if (column.log.coded) return [`Scan ${term.reading + 1}`, [["visits / 4 less hits", signed(term.said, 2)]]];
  const { laps } = term;
  const facts = [
    ["p_free(reading)", probability(pFreeOf(term.said / laps))],
    ["its log-odds", signed(term.said / laps, 3)],
    [laps > 1 ? `${laps} laps add` : "adds", signed(term.added, 3)],
    ["then l", signed(term.total, 3)],
  ];
  if (!column.once) facts.splice(2, 0, ["less l_0", signed(term.off / laps, 3)]);
  return [`Reading ${term.reading + 1}${isOff ? ", its prior taken off" : ""}`, facts];
}
