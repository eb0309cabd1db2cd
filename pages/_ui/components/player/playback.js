// Transport: the replay in time, its buttons, the scrubber and the speed.

const LOOP_PAUSE = 1.6; // s at the end of a compact replay

class Playback {
  constructor(player) {
    this.player = player;
    this.root = player.root;
    this.playing = false;
    this.position = 0; // readings, with a fraction while playing
    this.listen();
  }

  listen() {
    const { player } = this;
    const scrub = player.part("scrub");
    scrub.addEventListener("input", () => {
      this.pause(false);
      player.goTo(Number(scrub.value));
    });
    scrub.addEventListener("change", () => player.commit(COMMIT_DELAY));
    player.part("speed").addEventListener("change", (event) => {
      player.state.speed = Number(event.target.value);
      player.commit();
    });
  }

  offerSpeeds(speeds) {
    this.speeds = speeds;
    const options = speeds.map((v) =>
      element("option", { value: v }, `${v} readings/s`),
    );
    this.player.part("speed").replaceChildren(...options);
  }

  restore() {
    const { state, model } = this.player;
    // Unless told otherwise, a replay lasts about ten seconds.
    const wanted = model.nReadings / 10;
    state.speed ??= this.speeds.reduce((best, v) =>
      Math.abs(v - wanted) < Math.abs(best - wanted) ? v : best,
    );
    this.position = state.step;
    this.player.part("scrub").max = model.nReadings;
    this.player.part("speed").value = state.speed;
  }

  play() {
    const { player } = this;
    if (this.playing || !player.model) return;
    if (player.state.step >= player.model.nReadings) player.goTo(0);
    this.position = player.state.step;
    this.playing = true;
    this.showPlaying();
    let then = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      // A page that slept goes on where it was, not where it would have been.
      this.advance(Math.max(0, Math.min(0.1, (now - then) / 1000)));
      then = now;
      this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  advance(seconds) {
    const { state, model } = this.player;
    const last = model.nReadings;
    this.position += seconds * state.speed;
    this.player.goTo(Math.min(last, Math.floor(this.position)), this.position);
    if (this.position < last) return;
    if (!state.compact) this.pause();
    else if (this.position > last + LOOP_PAUSE * state.speed) this.player.goTo(0);
  }

  pause(tell = true) {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.frame);
    this.showPlaying();
    if (tell) this.player.commit();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  showPlaying() {
    const button = this.root.querySelector("[data-do=play]");
    button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    this.root.dataset.playing = this.playing ? "1" : "0";
  }

  show() {
    const { state, model } = this.player;
    const words = `reading ${state.step} of ${model.nReadings}`;
    const scrub = this.player.part("scrub");
    scrub.value = state.step;
    scrub.style.setProperty("--done", `${(100 * state.step) / model.nReadings}%`);
    scrub.setAttribute("aria-valuetext", words);
    this.player.part("counter").textContent = words;
  }
}
