// The replay in time: play and pause, steps by hand, the scrubber and the speed.

const LOOP_PAUSE = 1.6; // s at the end of a compact replay
const FRAME_MAX = 0.1; // s; limits the jump after a page was in the background
const REPLAY_SECONDS = 10; // duration of a replay unless a speed was chosen

function listenToTransport(p) {
  const scrub = partOf(p.root, "scrub");
  scrub.addEventListener("input", () => {
    pause(p);
    goTo(p, Number(scrub.value));
  });
  scrub.addEventListener("change", () => commit(p, COMMIT_DELAY));
  partOf(p.root, "speed").addEventListener("change", (event) => {
    p.state.speed = Number(event.target.value);
    commit(p);
  });
}

function buildSpeeds(p, speeds) {
  const option = (value) => element("option", { value }, `${value} readings/s`);
  partOf(p.root, "speed").replaceChildren(...speeds.map(option));
}

// The speed that makes a replay last closest to REPLAY_SECONDS.
function usualSpeed(speeds, nReadings) {
  const away = (speed) => Math.abs(speed - nReadings / REPLAY_SECONDS);
  return speeds.reduce((best, speed) => (away(speed) < away(best) ? speed : best));
}

// The state holds a speed only where one was chosen: only that belongs in a link.
function speedOf(p) {
  return p.state.speed ?? usualSpeed(p.header.speeds, p.model.nReadings);
}

function play(p) {
  if (p.playing || !p.model) return;
  if (p.state.step >= p.model.nReadings) goTo(p, 0);
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

// The position counts readings, with a fraction; past the end it counts the pause.
function advance(p, seconds) {
  const { compact } = p.state;
  const speed = speedOf(p);
  const last = p.model.nReadings;
  p.position += seconds * speed;
  goTo(p, Math.floor(p.position), p.position);
  if (p.position < last) return;
  if (compact) {
    if (p.position > last + LOOP_PAUSE * speed) goTo(p, 0);
  } else {
    pause(p);
    commit(p);
  }
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
  pause(p);
  goTo(p, step);
  commit(p, COMMIT_DELAY);
}

function goTo(p, step, position = step) {
  const target = clamp(step, 0, p.model.nReadings);
  p.position = position;
  if (target === p.model.step) return;
  p.state.step = target;
  paintEntries(p.picture, p.model, seek(p.model, target));
  refresh(p);
}

function showPlaying({ root, playing }) {
  const button = root.querySelector("[data-do=play]");
  button.setAttribute("aria-label", playing ? "Pause" : "Play");
  root.dataset.playing = playing ? "1" : "0";
}

const stepWords = ({ state, model }) => `reading ${state.step} of ${model.nReadings}`;

function showStep(p) {
  const { step } = p.state;
  const scrub = partOf(p.root, "scrub");
  scrub.value = step;
  scrub.style.setProperty("--done", `${(100 * step) / p.model.nReadings}%`);
  scrub.setAttribute("aria-valuetext", stepWords(p));
  partOf(p.root, "counter").textContent = stepWords(p);
}
