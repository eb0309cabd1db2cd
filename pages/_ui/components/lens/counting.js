// A thousand cells that the drawing treats alike, counted: whole cells, no formula.

const ONE_READING = [
  { name: "read empty", empty: 1, object: 0 },
  { name: "read object", empty: 0, object: 1 },
];
const TWO_READINGS = [
  { name: "twice empty", empty: 2, object: 0 },
  { name: "one of each", empty: 1, object: 1 },
  { name: "twice object", empty: 0, object: 2 },
];
const RULES = [
  ["prior_once", "drawing counted once"],
  ["subtract_prior", "taken off each time"],
];

function showCounting(p) {
  const { cells, free, wall } = countedCells(p.state.prior, { empty: 0, object: 0 }, p.constants);
  const words = `Of ${grouped(cells)} cells with this prior ${grouped(free)} are free and ${grouped(wall)} wall.`;
  setText(partOf(p.root, "such"), `${words} The sensor is right 9 times of 10.`);
  partOf(p.root, "once-table").replaceChildren(...tableOf(p, ONE_READING, 3));
  partOf(p.root, "twice-table").replaceChildren(...tableOf(p, TWO_READINGS, 4));
  partOf(p.root, "twice-name").textContent = `Read twice, ${grouped(100 * cells)} cells`;
}

function tableOf({ state, constants }, outcomes, digits) {
  const counts = outcomes.map((outcome) => countedCells(state.prior, outcome, constants));
  const row = (name, values) => element("tr", {}, element("th", { scope: "row" }, name), ...values);
  const cells = (texts) => texts.map((text) => element("td", {}, text));
  const names = outcomes.map(({ name }) => element("th", { scope: "col" }, name));
  const says = RULES.map(([rule, name]) => {
    const told = outcomes.map((outcome) => ruleSays(state.prior, outcome, rule, constants).toFixed(digits));
    const made = row(name, cells(told));
    if (rule === state.rule) made.dataset.live = "1";
    return made;
  });
  const share = counts.map(({ free, wall, share: part }) =>
    element("td", {}, `${grouped(free)} / ${grouped(free + wall)} = `, element("b", {}, part.toFixed(digits))),
  );
  return [
    element("tr", {}, element("td", {}), ...names),
    row("free", cells(counts.map(({ free }) => grouped(free)))),
    row("wall", cells(counts.map(({ wall }) => grouped(wall)))),
    row("share free", share),
    ...says,
  ];
}
