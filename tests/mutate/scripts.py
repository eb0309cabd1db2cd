"""Mutations of the scripts: most are noticed in Node, painting in a browser."""

from tests.mutate.mutation import Mutation

COMPONENTS = "pages/_ui/components/"
MODEL = "tests/node/model.test.mjs"
CELLS = "tests/node/cells.test.mjs"
REPLAY = "tests/node/replay.test.mjs"
PLAYER = "tests/node/player.test.mjs"
WORDS = "tests/node/words.test.mjs"
IN_BROWSER = "tests/browser/test_player.py::test_"
PIXELS = "tests/browser/test_painted_pixels.py::test_"
GREY = f"{PIXELS}each_cell_has_the_grey_of_its_belief"
OUTCOMES = f"{PIXELS}each_cell_has_the_colour_of_its_outcome"
CONE = f"{PIXELS}the_cone_has_the_angle_and_the_reach_of_the_sensor"

_ROWS = (
    # file, old, new, the tests that must fail, why
    (
        "player/model.js",
        "logOdds < -model.decisionEps",
        "logOdds <= model.decisionEps",
        MODEL,
        "ties counted as wall",
    ),
    (
        "player/model.js",
        "logOdds < -model.decisionEps",
        "logOdds < model.decisionEps",
        f"{PIXELS}an_exact_tie_is_not_painted_as_wall",
        "ties painted as wall",
    ),
    (
        "player/model.js",
        "Math.round((Math.log(p) - Math.log1p(-p)) / LATTICE) * LATTICE",
        "Math.log(p) - Math.log1p(-p)",
        MODEL,
        "a prior off the lattice",
    ),
    (
        "player/model.js",
        "(model.once ? 1 : 1 - k)",
        "(model.once ? 1 : -k)",
        MODEL,
        "prior subtracted once too often",
    ),
    (
        "player/model.js",
        'rule === "prior_once"',
        'rule === "subtract_prior"',
        MODEL,
        "update rules swapped",
    ),
    (
        "player/model.js",
        "[model.priorScale * p_space, model.priorScale * p_wall]",
        "[model.priorScale * p_wall, model.priorScale * p_space]",
        MODEL,
        "priors of wall and space cells swapped",
    ),
    (
        "player/model.js",
        "for (let e = from - 1; e >= to; e--) {",
        "for (let e = from - 1; e > to; e--) {",
        MODEL,
        "a step back leaves an entry behind",
    ),
    (
        "player/model.js",
        'if (region !== (k > 0 ? "unexplored" : "explored")) counts[was]--',
        "if (k > 0) counts[was]--",
        MODEL,
        "unseen cells counted twice",
    ),
    (
        "player/model.js",
        "return isTrue ? 2 : 3;",
        "return isTrue ? 3 : 2;",
        MODEL,
        "missed walls taken for free cells",
    ),
    (
        "player/model.js",
        "4 * fn + fp",
        "fn + 4 * fp",
        MODEL,
        "F2 that weighs precision twice",
    ),
    (
        "player/model.js",
        "if (indptr[middle] <= entry) low",
        "if (indptr[middle] < entry) low",
        MODEL,
        "an entry ascribed to the reading before",
    ),
    (
        "player/cells.js",
        "[rgbOf(colours.beliefOccupied), rgbOf(colours.beliefFree)]",
        "[rgbOf(colours.beliefFree), rgbOf(colours.beliefOccupied)]",
        CELLS,
        "inverted belief map",
    ),
    (
        "player/cells.js",
        "[rgbOf(colours.beliefOccupied), rgbOf(colours.beliefFree)]",
        "[rgbOf(colours.beliefFree), rgbOf(colours.beliefOccupied)]",
        GREY,
        "inverted belief map, in a browser",
    ),
    (
        "player/cells.js",
        "inks.region !== (model.counts[c] > 0 ?",
        "inks.region !== (model.counts[c] >= 0 ?",
        CELLS,
        "unseen cells painted as scored",
    ),
    (
        "player/cells.js",
        'overlay === "truth" ? colours.groundTruth : colours.wallMask',
        'overlay === "truth" ? colours.wallMask : colours.groundTruth',
        GREY,
        "colours of the overlays swapped",
    ),
    (
        "player/cells.js",
        "picture.stale ||= to > from;",
        "picture.stale ||= to < from;",
        CELLS,
        "a step that is not shown",
    ),
    (
        "player/cells.js",
        "counts[c] ? 0 : 255 << 24",
        "counts[c] ? 255 << 24 : 0",
        OUTCOMES,
        "seen cells hatched",
    ),
    (
        "player/cells.js",
        "if (inks.isErrors) drawHatch(",
        'if (inks.region === "all") drawHatch(',
        OUTCOMES,
        "unseen cells not hatched",
    ),
    (
        "player/draw.js",
        "const half = model.fovRad / 2;",
        "const half = model.fovRad;",
        CONE,
        "a cone twice as wide",
    ),
    (
        "player/draw.js",
        "context.arc(x, y, model.rangePx,",
        "context.arc(x, y, 1.2 * model.rangePx,",
        CONE,
        "a cone that reaches too far",
    ),
    (
        "player/draw.js",
        "Math.max(0, model.step - 1)",
        "Math.min(model.nReadings - 1, model.step)",
        CONE,
        "the robot drawn a reading ahead",
    ),
    (
        "player/draw.js",
        "drawSensor(p, context, true);",
        "drawSensor(p, context, false);",
        f"{PIXELS}the_drawing_is_tinted_inside_the_cone_and_nowhere_else",
        "a cone that is not filled",
    ),
    (
        "player/stage.js",
        "y >= 0 && x < widthPx && y < heightPx",
        "y >= 0 && x <= widthPx && y <= heightPx",
        PLAYER,
        "a pin beyond the edge that is kept",
    ),
    (
        "player/stage.js",
        "Math.floor(y / cellPx) * nCols + Math.floor(x / cellPx)",
        "Math.floor(x / cellPx) * nCols + Math.floor(y / cellPx)",
        PLAYER,
        "rows and columns of a pin swapped",
    ),
    (
        "player/playback.js",
        "if (p.position < last) return;",
        "if (p.position <= last) return;",
        PLAYER,
        "a replay that does not stop at its end",
    ),
    (
        "player/playback.js",
        "const target = clamp(step, 0, p.model.nReadings);",
        "const target = step;",
        PLAYER,
        "a step beyond the readings",
    ),
    (
        "player/player.js",
        "state.step = clamp(state.step, 0, model.nReadings);",
        "",
        PLAYER,
        "a restored step beyond the readings",
    ),
    (
        "player/player.js",
        "if (p.pin === null) state.pin_px = null;",
        "",
        PLAYER,
        "a pin outside the drawing that is sent to Python",
    ),
    (
        "player/player.js",
        'if (p.pin !== null) p.tab = "cell";',
        'if (p.pin !== null) openTab(p, "cell");',
        f"{IN_BROWSER}a_pinned_cell_outlives_a_change_of_each_setting",
        "a pinned cell drawn before the new map is painted",
    ),
    (
        "player/player.js",
        "known?.digest === digest &&",
        "known &&",
        PLAYER,
        "a step kept from another replay",
    ),
    (
        "player/player.js",
        "const wasPlaying = pause(p);",
        "const wasPlaying = p.playing;",
        f"{IN_BROWSER}another_cell_size_in_mid_play_stops_and_keeps_the_step",
        "a replay that plays on over new data",
    ),
    (
        "player/player.js",
        "  showStep(p);\n",
        "  showStep(p);\n  if (p.series) say(p, stateWords(p));\n",
        f"{IN_BROWSER}a_screen_reader_hears_the_scores_when_the_replay_pauses",
        "scores announced on every frame",
    ),
    (
        "player/replay.js",
        "next += gap[run];",
        "next = gap[run];",
        REPLAY,
        "gaps counted from the start of a reading",
    ),
    (
        "player/terms.js",
        "isDone: term.reading < step,",
        "isDone: term.reading <= step,",
        WORDS,
        "a reading shown as done one step early",
    ),
    (
        "player/controls.js",
        "{ p_space: 0, p_wall: 1 }",
        "{ p_space: 1, p_wall: 0 }",
        f"{IN_BROWSER}a_slider_shows_the_probability_that_it_sets",
        "sliders that show each other's probability",
    ),
    (
        "player/inspector.js",
        'declaresWall(model, logOdds) ? "wall" : "no wall"',
        'declaresWall(model, logOdds) ? "no wall" : "wall"',
        f"{IN_BROWSER}hovering_shows_a_cells_numbers_on_both_pictures",
        "a cell whose class is shown the wrong way round",
    ),
    (
        "shared/bytes.js",
        "(bytes[i >> 3] >> (7 - (i & 7))) & 1",
        "(bytes[i >> 3] >> (i & 7)) & 1",
        REPLAY,
        "bits read low bit first",
    ),
    (
        "shared/bytes.js",
        "new Uint8Array(data.buffer ?? data, data.byteOffset, data.byteLength)",
        "new Uint8Array(data.buffer ?? data)",
        REPLAY,
        "bytes read from the start of another buffer",
    ),
)

SCRIPTS = tuple(
    Mutation(COMPONENTS + file, old, new, (test,), why)
    for file, old, new, test, why in _ROWS
)
