// Numbers and small pieces of the page. Text from outside enters as text, never as HTML.

const COMMIT_DELAY = 350; // ms; keys held down are one commit
const DASH = "\u2013";
const MINUS = "\u2212";

function fixed(value, digits) {
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? MINUS + text : text;
}

function signed(value, digits) {
  return value >= 0 ? `+${fixed(value, digits)}` : fixed(value, digits);
}

const percent = (value) =>
  Number.isNaN(value) ? DASH : `${(100 * value).toFixed(1)} %`;

// Three decimals, more where a probability would else read as 0 or 1.
function probability(p) {
  const edge = Math.min(p, 1 - p);
  if (edge >= 0.0005 || edge === 0) return p.toFixed(3);
  return p < 0.5
    ? p.toExponential(1).replace("-", MINUS)
    : `1 ${MINUS} ${(1 - p).toExponential(1).replace("-", MINUS)}`;
}

function rows(pairs) {
  return pairs.flatMap(([name, value]) => [
    element("dt", {}, name),
    element("dd", {}, value),
  ]);
}

function radio(group, { value, label, about }, onChoose) {
  const input = element("input", { type: "radio", name: group, value });
  input.addEventListener("change", () => onChoose(value));
  const words = element("span", {}, label);
  if (about) words.append(element("small", {}, about));
  return element("label", {}, input, words);
}
