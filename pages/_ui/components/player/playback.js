// The replay in time: play and pause, steps by hand, the scrubber and the speed.

const FRAME_MAX = 0.1; // s; limits the jump after a page was in the background
const REPLAY_SECONDS = 10; // duration of a replay unless a speed was chosen
const COMPACT_SECONDS = 24; // of a compact one: what it shows is new to who watches
const WHOLE = "whole"; // the choice of that duration

function listenToTransport(p) {
  const scrub = partOf(p.root, "scrub");
  scrub.addEventListener("input", () => {
    pause(p);
    goTo(p, Number(scrub.value));
  });
  scrub.addEventListener("change", () => commit(p, COMMIT_DELAY));
  partOf(p.root, "speed").addEventListener("change", (event) => {
    const { value } = event.target;
    p.state.speed = value === WHOLE ? null : Number(value);
    commit(p);
  });
}

function buildSpeeds(p, speeds) {
  const option = (value, label) => element("option", { value }, label);
  const whole = option(WHOLE, `all in ${REPLAY_SECONDS} s`);
  const given = speeds.map((value) => option(value, `${value} readings/s`));
  partOf(p.root, "speed").replaceChildren(whole, ...given);
}

// Readings per second.
const speedOf = ({ state, scene }) =>
  state.speed ?? scene.nReadings / (state.compact ? COMPACT_SECONDS : REPLAY_SECONDS);

// Where a replay stops; a compact one half-way as well, unless its question was answered.
function stopOf(p) {
  const isBefore = p.state.step < halfOf(p);
  return p.state.compact && p.state.predicted === null && isBefore ? halfOf(p) : p.scene.nReadings;
}

function play(p) {
  if (p.playing || !p.columns || isLocked(p, "transport")) return;
  if (p.state.step >= p.scene.nReadings) goTo(p, 0);
  p.position = p.state.step;
  p.playing = true;
  showPlaying(p);
  let then = performance.now();
  const tick = (now) => {
    if (!p.playing) return;
    advance(p, clamp((now - then) / 1000, 0, FRAME_MAX));
    then = now;
    p.frame = requestAnimationFrame(tick);
  };
  p.frame = requestAnimationFrame(tick);
}

// The position counts readings, with a fraction.
function advance(p, seconds) {
  const stop = stopOf(p);
  const position = Math.min(stop, p.position + seconds * speedOf(p));
  goTo(p, Math.floor(position), position);
  if (position < stop) return;
  pause(p);
  commit(p);
}

// Returns whether it was playing.
function pause(p) {
  if (!p.playing) return false;
  p.playing = false;
  cancelAnimationFrame(p.frame);
  showPlaying(p);
  return true;
}

function togglePlay(p) {
  if (pause(p)) commit(p);
  else play(p);
}

// A step by hand: stops the replay and is committed to Python.
function walkTo(p, step) {
  if (isLocked(p, "transport")) return;
  pause(p);
  goTo(p, step);
  commit(p, COMMIT_DELAY);
}

function goTo(p, step, position = step) {
  const target = clamp(step, 0, p.scene.nReadings);
  p.position = position;
  if (target === p.state.step) return;
  p.state.step = target;
  const changed = new Map([...p.logs.values()].map((log) => [log, seek(log, target)]));
  for (const column of p.columns) paintEntries(column.picture, column, changed.get(column.log));
  if (p.comparison) rejudge(p.comparison, changed);
  refresh(p);
}

function showPlaying({ root, playing }) {
  const button = root.querySelector("[data-do=play]");
  button.setAttribute("aria-label", playing ? "Pause" : "Play");
  root.dataset.playing = playing ? "1" : "0";
}

const stepWords = ({ state, scene }) => `reading ${state.step} of ${scene.nReadings}`;

function showStep(p) {
  const { step } = p.state;
  const scrub = partOf(p.root, "scrub");
  scrub.value = step;
  scrub.style.setProperty("--done", `${(100 * step) / p.scene.nReadings}%`);
  scrub.setAttribute("aria-valuetext", stepWords(p));
  setText(partOf(p.root, "counter"), stepWords(p));
}
