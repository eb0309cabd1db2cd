// Probability and log-odds of a cell being free, as in occsim.logodds.

const LATTICE = 2 ** -36; // nats; that of occsim.logodds: sums and ties are exact

const logit = (p) => Math.round((Math.log(p) - Math.log1p(-p)) / LATTICE) * LATTICE;

function pFreeOf(logOdds) {
  const small = Math.exp(-Math.abs(logOdds));
  return (logOdds >= 0 ? 1 : small) / (1 + small);
}
