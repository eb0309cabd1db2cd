// The home page's replay: maps that differ in what they start from. It stops half-way with
// a question, drives on once that is answered, and at its end offers the other update rule.

const halfOf = ({ scene }) => Math.floor(scene.nReadings / 2);

const isOver = ({ state, scene }) => state.step === scene.nReadings;

const isAsking = (p) => p.state.predicted === null && p.state.step === halfOf(p);

const isStill = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

// What a map starts from.
function startOf({ uninformative, prior_drawing }) {
  if (uninformative) return "none";
  return prior_drawing === "own" ? "own" : "other";
}

// Space plays and pauses wherever on the page nothing else has the focus: on the home page
// and on a projector.
function listenToPage(p) {
  p.pageKey = (event) => {
    const isHeard = p.state?.compact || (event.key === " " && isProjected());
    if (isHeard && event.target === document.body) keyDown(p, event);
  };
  document.addEventListener("keydown", p.pageKey);
}

const isProjected = () => document.documentElement.dataset.occsimProjector === "1";

function buildStory(p, { document: { compact, columns }, texts: { story } }) {
  if (!compact) return;
  const votes = columns.map((setting, i) => {
    const names = { type: "button", class: "preset", "data-vote": i };
    const button = element("button", names, story.answers[startOf(setting)]);
    button.addEventListener("click", () => vote(p, i));
    return button;
  });
  partOf(p.root, "votes").append(...votes);
  const options = Object.entries(story.rules).map(([rule, label]) => {
    const input = element("input", { type: "radio", name: "story-rule", value: rule });
    input.addEventListener("change", () => countBy(p, rule));
    return element("label", { class: "preset" }, input, label);
  });
  partOf(p.root, "switch").append(...options);
  partOf(p.root, "switch").firstElementChild.textContent = story.switch;
}

// Who wants no motion is shown the end at once.
function vote(p, i) {
  p.state.predicted = i;
  p.root.focus({ preventScroll: true }); // the button that had the focus goes
  if (isStill()) goTo(p, p.scene.nReadings);
  else play(p);
  refresh(p);
  commit(p);
}

// All maps at once count the drawing by a rule.
function countBy(p, rule) {
  for (const setting of p.state.columns) setting.rule = rule;
  recolour(p);
  commit(p);
}

function showStory(p) {
  setText(partOf(p.root, "telling"), tellingWords(p));
  partOf(p.root, "votes").hidden = !isAsking(p);
  partOf(p.root, "switch").hidden = !isOver(p);
  const [{ rule }] = p.state.columns;
  for (const input of p.root.querySelectorAll("[name=story-rule]")) input.checked = input.value === rule;
  for (const view of p.views) showTally(p, view);
}

// ---- words -------------------------------------------------------------------------------

const storyName = ({ state, header }, i) => header.texts.story.maps[startOf(state.columns[i])];

function answerOf({ state, header }, i) {
  const answer = header.texts.story.answers[startOf(state.columns[i])];
  return answer[0].toLowerCase() + answer.slice(1);
}

function tellingWords(p) {
  const { predicted } = p.state;
  const { watch, question } = p.header.texts.story;
  const said = p.columns[predicted] ? `You said: ${answerOf(p, predicted)}.` : "";
  if (isOver(p)) return `${said} Best where the robot looked: ${answerOf(p, bestOf(p))}.`.trim();
  if (isAsking(p)) return question;
  return said || watch;
}

// The map that is best by F2 of the cells looked at, the drawing counted once.
function bestOf(p) {
  const once = finalF2(p).map(({ prior_once }) => prior_once);
  return once.indexOf(Math.max(...once));
}

function storyWords(p) {
  const maps = p.columns.map((_, i) => `${storyName(p, i)}: ${tallyWords(p, i)}`);
  return [tellingWords(p), ...maps].join(" ");
}

function tallyWords({ columns, state }, i) {
  const [found, falses, missed] = columns[i].curves.looked.counts.map((count) => count[state.step]);
  return `${grouped(found)} of ${grouped(found + missed)} walls looked at found, ${grouped(falses)} false`;
}

// ---- the count below each map ------------------------------------------------------------

function buildTallies(p) {
  const { meanings } = p.header.texts.story;
  for (const view of p.views) {
    const part = (name) => element("b", { "data-tally": name });
    const about = (name, text = name) => element("abbr", { title: meanings[name] }, text);
    const row = (...parts) => element("div", {}, ...parts);
    const counted = (region, where) =>
      row(
        element("span", { class: "where" }, about(where)),
        element("span", {}, part(`${region} found`), " of ", part(`${region} walls`), " ", about("walls found")),
        element("span", {}, part(`${region} false`), " ", about("false walls", "false")),
      );
    const f2 = row(element("span", { class: "where" }, about("F2"), ", looked at"), part("f2"));
    const tally = element("div", { class: "tally" });
    tally.append(counted("looked", "looked at"), counted("unseen", "not looked at"), f2);
    view.tally = Object.fromEntries(
      [...tally.querySelectorAll("[data-tally]")].map((node) => [node.dataset.tally, node]),
    );
    view.f2 = f2;
    view.pane.append(tally);
  }
}

function showTally(p, { tally, f2, column: i }) {
  const { curves } = p.columns[i];
  for (const region of TABLE_REGIONS) {
    const [found, falses, missed] = curves[region].counts.map((count) => count[p.state.step]);
    setText(tally[`${region} found`], grouped(found));
    setText(tally[`${region} walls`], grouped(found + missed));
    setText(tally[`${region} false`], grouped(falses));
  }
  f2.classList.toggle("unseen", !isOver(p));
  if (isOver(p)) setText(tally.f2, f2Change(p, i));
}

// Of one map, once; then, where it is counted again, before and after.
function f2Change(p, i) {
  const { prior_once, subtract_prior } = finalF2(p)[i];
  const isOnce = p.columns[i].once;
  return isOnce ? percent(prior_once) : `${percent(prior_once)} \u2192 ${percent(subtract_prior)}`;
}

// By map and rule, F2 of the cells looked at after all readings; worked out at the end.
function finalF2(p) {
  p.finalF2 ??= p.columns.map(({ log, drawn }, i) => {
    const under = (rule) => {
      const column = newColumn(log, drawn, p.header.constants);
      setPrior(column, { ...p.state.columns[i], rule });
      return FORMULAS.f2(scoreCurves(column).looked.counts.map((count) => count.at(-1)));
    };
    return { prior_once: under("prior_once"), subtract_prior: under("subtract_prior") };
  });
  return p.finalF2;
}
