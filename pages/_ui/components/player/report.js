// For tests: the state of the player, and the numbers behind it.

function report({ root, header, state, scene, columns }) {
  const { step } = state;
  const [{ curves, log }] = columns;
  root.dataset.step = step;
  if (header.hasTruth) {
    const [tp, fp, fn, tn] = curves.looked.counts.map((curve) => curve[step]);
    Object.assign(root.dataset, { tp, fp, fn, tn, explored: curves.explored[step] });
  }
  const { nReadings } = scene;
  Object.assign(root.dataset, { rev: header.document.rev, nReadings, cellPx: log.cellPx });
  const [{ p_wall, p_space }] = state.columns;
  Object.assign(root.dataset, { pWall: p_wall, pSpace: p_space });
}

function inspection(p) {
  const { pin, hover, scale, columns } = p;
  const cellOf = (point) => point && cellHolding(columns[0].log, ...point);
  const [first, ...others] = columns.map((column) => columnReport(p, column));
  const ladder = p.views.find(({ ladder: one }) => one)?.ladder;
  const bars = pin === null ? null : ladder?.bars.map((_, i) => barX(ladder.slot, i));
  return { ...first, hover: cellOf(hover), pin: cellOf(pin), scale, bars, maps: [first, ...others] };
}

function columnReport({ pin, state, header }, column) {
  const { log, curves, series } = column;
  const { step } = state;
  const regionOf = (name) => ({
    counts: curves[name].counts.map((curve) => curve[step]),
    bits: series[name].bits[step],
  });
  const map = {
    logOdds: Array.from(log.counts, (_, c) => logOddsAt(column, c)),
    history: pin && historyOf(column, cellHolding(log, ...pin)),
    prior: column.pFreePrior,
  };
  if (!header.hasTruth) return map;
  return {
    ...map,
    looked: regionOf("looked"),
    unseen: regionOf("unseen"),
    bits: series.all.bits[step],
  };
}
