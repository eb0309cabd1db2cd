// The replay as a file: a GIF, drawn as fast as the browser can, or a film, recorded by
// the browser while it plays. Both show each step as the stage does, from the first
// reading to the last.

const GIF_FPS = 10;
const GIF_FRAMES = 200; // at most
const GIF_WIDTH = 960;
const GIF_HEIGHT = 480;
const LAST_SECONDS = 2; // the last frame stays
const FILM_FPS = 30;
const FILM_BITS = 4e6; // a second
const FILM_TYPES = [
  { type: "video/mp4;codecs=avc1.42E01F", label: "MP4", ending: "mp4" },
  { type: "video/webm;codecs=vp9", label: "WebM", ending: "webm" },
  { type: "video/webm", label: "WebM", ending: "webm" },
];

const filmType = () => FILM_TYPES.find(({ type }) => window.MediaRecorder?.isTypeSupported(type));

const filmSeconds = (p) => p.scene.nReadings / speedOf(p);

// The steps of the frames, from 0 to the last reading.
function stepsOfFrames(nReadings, seconds) {
  const n = clamp(Math.round(seconds * GIF_FPS), 1, Math.min(nReadings, GIF_FRAMES - 1));
  return Array.from({ length: n + 1 }, (_, i) => Math.round((i * nReadings) / Math.max(1, n)));
}

// Calls draw(step) for each step, given by the time or one after the other; afterwards
// the player is where it was. Returns whether it came to the end.
async function runThrough(p, run) {
  pause(p);
  const { step } = p.state;
  const mine = (p.film = { header: p.header });
  const isStopped = () => p.film !== mine || p.header !== mine.header || !p.columns;
  await run(isStopped);
  const isWhole = !isStopped();
  p.film = null;
  if (p.columns) goTo(p, step);
  return isWhole;
}

async function savedGif(p, tell) {
  const still = newStill(p, { width: GIF_WIDTH, height: GIF_HEIGHT }, 1);
  const steps = stepsOfFrames(p.scene.nReadings, filmSeconds(p));
  const canvas = offscreen(1, 1);
  let gif = null;
  const isWhole = await runThrough(p, async (isStopped) => {
    const size = frameSize(p, still);
    gif = newGif(size.width, size.height, commentOf(p));
    for (const [i, step] of steps.entries()) {
      if (isStopped()) return;
      goTo(p, step);
      paintFigure({ ...figureOf(p, still), ...size }, 1, canvas);
      const delay = i === steps.length - 1 ? LAST_SECONDS : 1 / GIF_FPS;
      addFrame(gif, pixelsOf(canvas), Math.round(100 * delay));
      tell(`Frame ${i + 1} of ${steps.length}`);
      await new Promise((resolve) => setTimeout(resolve)); // the page stays alive
    }
  });
  return isWhole ? { blob: finished(gif), name: `${fileStem()}.gif` } : null;
}

const pixelsOf = (canvas) => {
  const { width, height } = canvas;
  return new Uint32Array(canvas.getContext("2d").getImageData(0, 0, width, height).data.buffer);
};

// Of all frames: numbers grow, and with them the lines of text. Ends at the first step.
function frameSize(p, still) {
  const sizes = [p.scene.nReadings, 0].map((step) => {
    goTo(p, step);
    return figureOf(p, still);
  });
  return { width: sizes[0].width, height: Math.max(...sizes.map(({ height }) => height)) };
}

const commentOf = (p) => {
  const { software, link, settings } = factsOf(p);
  return ascii(JSON.stringify({ software, link, settings }));
};

async function savedFilm(p, { type, ending }, tell) {
  const still = newStill(p, { width: GIF_WIDTH, height: GIF_HEIGHT }, 1);
  const canvas = offscreen(1, 1);
  const parts = [];
  const isWhole = await runThrough(p, async (isStopped) => {
    const size = frameSize(p, still);
    const paint = () => paintFigure({ ...figureOf(p, still), ...size }, 1, canvas);
    paint();
    const recorder = new MediaRecorder(canvas.captureStream(FILM_FPS), {
      mimeType: type,
      videoBitsPerSecond: FILM_BITS,
    });
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    const isDone = new Promise((resolve) => recorder.addEventListener("stop", resolve));
    recorder.start();
    await playOn(p, paint, isStopped, tell);
    recorder.stop();
    await isDone;
  });
  return isWhole ? { blob: new Blob(parts, { type }), name: `${fileStem()}.${ending}` } : null;
}

// Each frame of the browser shows the step that the time has come to.
async function playOn(p, paint, isStopped, tell) {
  const began = performance.now();
  const { nReadings } = p.scene;
  const [speed, seconds] = [speedOf(p), filmSeconds(p) + LAST_SECONDS];
  for (let at = 0; at < seconds && !isStopped(); ) {
    at = Math.max(0, (await new Promise(requestAnimationFrame)) - began) / 1000;
    goTo(p, Math.min(nReadings, Math.floor(at * speed)));
    paint();
    tell(`${Math.floor(at)} of ${Math.round(seconds)} s`);
  }
}
