import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./scripts.mjs";

const player = load("player");

const SETTING = {
  prior_drawing: "own",
  flaw: "found",
  p_wall: 0.2,
  p_space: 0.9,
  calibrated: false,
  uninformative: false,
  rule: "prior_once",
  behind_hit: "occupied",
  cell_px: 3,
  model: "log_odds",
  laps: "1",
};
const option = (value, label) => ({ value, label });
const WORDS = {
  drawing: [option("own", "this drawing"), option("none", "no drawing")],
  pair: [],
  rule: [option("prior_once", "once"), option("subtract_prior", "subtract")],
  flaw: [option("found", "as found")],
  behind_hit: [option("occupied", "occupied")],
  cell_px: [option("3", "3 px cells")],
  model: [option("log_odds", "log-odds"), option("hits_visits", "counts")],
  laps: [option("1", "1 lap"), option("3", "3 laps")],
};
const withChanges = (changes) => ({ ...SETTING, ...changes });

test("a word differs where two maps have other values of it", () => {
  const settings = [SETTING, withChanges({ rule: "subtract_prior", cell_px: 1 })];
  const differing = player.WORDS.filter((word) => player.differs(settings, word));
  assert.deepEqual(differing, ["rule", "cell_px"]);
});

test("laps are told where there are more than one, or where they differ", () => {
  const laps = (n) => withChanges({ laps: n });
  assert.ok(!player.agreement(WORDS, [laps("1"), laps("1")]).includes("lap"));
  assert.match(player.agreement(WORDS, [laps("3"), laps("3")]), /3 laps\.$/);
  assert.ok(player.differs([laps("1"), laps("3")], "laps"));
  // Counts of beams are the same after each lap, as a share.
  const counts = withChanges({ model: "hits_visits", laps: "3" });
  assert.ok(!player.differs([laps("1"), counts], "laps"));
});

test("a slider moves what moves together with it", () => {
  const moved = (together) => player.movedTo({ header: { together } }, "p_wall", 0.3);
  assert.deepEqual(moved([]), { p_wall: 0.3 });
  assert.deepEqual(moved(["p_wall", "p_space"]), { p_wall: 0.3, p_space: 0.3 });
  assert.deepEqual(moved(["p_space", "rule"]), { p_wall: 0.3 });
});

test("a map of counts has no drawing, pair or rule to differ in", () => {
  const settings = [SETTING, withChanges({ model: "hits_visits", rule: "subtract_prior", p_wall: 1 })];
  const differing = player.WORDS.filter((word) => player.differs(settings, word));
  assert.deepEqual(differing, ["model"]);
  assert.equal(player.wordLabel(WORDS, settings[1], "model"), "counts");
});

test("a map without a drawing has neither pair nor errors to differ in", () => {
  const settings = [withChanges({ flaw: "thin2" }), withChanges({ uninformative: true, p_wall: 1 })];
  const differing = player.WORDS.filter((word) => player.differs(settings, word));
  assert.deepEqual(differing, ["drawing"]);
});

test("what agrees is said once", () => {
  const other = withChanges({ rule: "subtract_prior" });
  assert.equal(
    player.agreement(WORDS, [SETTING, other]),
    "Same building and readings: this drawing, 0.2, 0.9, as found, occupied, 3 px cells.",
  );
  assert.equal(
    player.agreement(WORDS, [SETTING, withChanges({ cell_px: 1 })]),
    "Same building and tour: this drawing, 0.2, 0.9, once, as found, occupied.",
  );
  // The second starts from one half.
  assert.equal(
    player.agreement(WORDS, [SETTING, withChanges({ uninformative: true })]),
    "Same building and readings: once, as found, occupied, 3 px cells.",
  );
});

test("a size that is not in the list is named as the others", () => {
  assert.equal(player.wordLabel(WORDS, withChanges({ cell_px: 19 }), "cell_px"), "19 px cells");
});

test("choosing a word and reading it back gives the same word", () => {
  const choices = [
    ["drawing", "mirrored"],
    ["drawing", "none"],
    ["pair", "0.1,1"],
    ["pair", "calibrated"],
    ["rule", "subtract_prior"],
    ["flaw", "thin2"],
    ["behind_hit", "unseen"],
    ["cell_px", "5"],
  ];
  for (const [word, value] of choices) {
    const changed = withChanges(player.wordChanges(word, value));
    assert.equal(player.wordValue(changed, word), value);
  }
  assert.deepEqual(player.wordChanges("drawing", "own"), { uninformative: false, prior_drawing: "own" });
  assert.equal(player.wordChanges("cell_px", "5").cell_px, 5);
});
