// Numbers as words.

const DASH = "\u2013";
const MINUS = "\u2212";

function fixed(value, digits) {
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

// A whole number, its thousands apart.
const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, ",");

const signed = (value, digits) => (value >= 0 ? "+" : "") + fixed(value, digits);

// A score; a dash if undefined.
const percent = (value) => (Number.isNaN(value) ? DASH : `${(100 * value).toFixed(1)} %`);

const inBits = (value) => (Number.isNaN(value) ? DASH : value.toFixed(3));

// Three decimals; more where the value would otherwise be rounded to 0 or 1.
function probability(p) {
  const edge = Math.min(p, 1 - p);
  if (edge >= 0.0005 || edge === 0) return p.toFixed(3);
  return p.toFixed(Math.min(15, 1 - Math.floor(Math.log10(edge))));
}

// Replaces a text only where it changed: each change costs a new layout of the page.
function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}
