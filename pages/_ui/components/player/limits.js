// What is hidden and locked in the player: see obeyLimits. An output vanishes only where it
// is itself hidden.

const isHidden = ({ header }, name) => header.hidden.includes(name);

// Hidden controls keep their value as well.
const isLocked = (p, name) => isHidden(p, name) || p.header.locked.includes(name);

function showLimits(p) {
  const { root } = p;
  obeyLimits(root, p.header);
  for (const section of root.querySelectorAll(".side section")) {
    section.hidden = [...section.querySelectorAll("[data-control]")].every((box) => box.hidden);
  }
  for (const tab of root.querySelectorAll("[data-tab]")) {
    tab.hidden = tab.dataset.tab === "scores" && isHidden(p, "scores");
  }
  root.classList.toggle("no-ladder", isHidden(p, "ladder"));
  root.classList.toggle("no-scores", isHidden(p, "scores"));
}

// What moving a slider sets: values that are the same move together.
function movedTo({ header: { together } }, name, value) {
  const names = together.includes(name) ? together : [name];
  return Object.fromEntries(names.map((one) => [one, value]));
}

// The tab that is open: with hidden scores there is but one.
const openTabOf = (p) => (isHidden(p, "scores") ? "cell" : p.tab);

// ---- words of a header: independent of the page -----------------------------------------

const WORD_CONTROLS = { drawing: ["prior_drawing"], pair: ["p_wall", "p_space"], flaw: ["thickness_px"] };

const controlsOf = (word) => WORD_CONTROLS[word] ?? [word];
const isWordHidden = (p, word) => controlsOf(word).every((name) => isHidden(p, name));
const isWordLocked = (p, word) => controlsOf(word).every((name) => isLocked(p, name));
