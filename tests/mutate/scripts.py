"""Mutations of the scripts: most are noticed in Node, painting in a browser."""

from tests.mutate.mutation import Mutation

COMPONENTS = "pages/_ui/components/"
MODEL = "tests/node/model.test.mjs"
CELLS = "tests/node/cells.test.mjs"
REPLAY = "tests/node/replay.test.mjs"
PLAYER = "tests/node/player.test.mjs"
WORDS = "tests/node/words.test.mjs"
SCORES = "tests/node/scores.test.mjs"
VERDICTS = "tests/node/verdicts.test.mjs"
HEADERS = "tests/node/headers.test.mjs"
STORY = "tests/node/story.test.mjs"
LENS = "tests/node/lens.test.mjs"
RAYS = "tests/test_lens.py::test_browser_and_library_agree_on_500_poses"
SUMS = "tests/test_lens.py::test_readings_add_up_as_in_a_map"
IN_BROWSER = "tests/browser/test_player.py::test_"
PIXELS = "tests/browser/test_painted_pixels.py::test_"
GREY = f"{PIXELS}each_cell_has_the_grey_of_its_belief"
OUTCOMES = f"{PIXELS}each_cell_has_the_colour_of_its_outcome"
CONE = f"{PIXELS}the_cone_has_the_angle_and_the_reach_of_the_sensor"

_ROWS = (
    # file, old, new, the tests that must fail, why
    (
        "player/model.js",
        "logOdds < -column.decisionEps",
        "logOdds <= column.decisionEps",
        MODEL,
        "ties counted as wall",
    ),
    (
        "player/model.js",
        "logOdds < -column.decisionEps",
        "logOdds < column.decisionEps",
        f"{PIXELS}an_exact_tie_is_not_painted_as_wall",
        "ties painted as wall",
    ),
    (
        "shared/logodds.js",
        "Math.round((Math.log(p) - Math.log1p(-p)) / LATTICE) * LATTICE",
        "Math.log(p) - Math.log1p(-p)",
        MODEL,
        "a prior off the lattice",
    ),
    (
        "player/model.js",
        "(column.once ? 1 : 1 - laps * k)",
        "(column.once ? 1 : -laps * k)",
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
        "[column.priorScale * p_space, column.priorScale * p_wall]",
        "[column.priorScale * p_wall, column.priorScale * p_space]",
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
        "player/scores.js",
        "tallyCell(k > 0 ? looked : unseen,",
        "tallyCell(looked,",
        SCORES,
        "cells seen for the first time counted as unseen too",
    ),
    (
        "player/scores.js",
        "const x = isWall ? logOdds : -logOdds;",
        "const x = isWall ? -logOdds : logOdds;",
        SCORES,
        "bits of the wrong class",
    ),
    (
        "player/scores.js",
        "return n ? sum / n : NaN;",
        "return sum / n;",
        SCORES,
        "bits of a region without cells",
    ),
    (
        "player/scores.js",
        "sign * values[step] - SAME_SCORE",
        "sign * values[step] + SAME_SCORE",
        SCORES,
        "a map worth more than its equal",
    ),
    (
        "player/model.js",
        "if (!truth[c]) free[drawn[c]]++;",
        "if (truth[c]) free[drawn[c]]++;",
        MODEL,
        "a calibrated pair of walls, not of free cells",
    ),
    (
        "player/verdicts.js",
        "(isWallA === isWall ? 1 : 2)",
        "(isWallA === isWall ? 2 : 1)",
        VERDICTS,
        "the wrong map called right",
    ),
    (
        "player/verdicts.js",
        "a.log.counts[ca] > 0 && b.log.counts[cb] > 0",
        "a.log.counts[ca] > 0",
        VERDICTS,
        "a cell that one map has not looked at",
    ),
    (
        "player/verdicts.js",
        "const u = (after + i) % nCells;",
        "const u = (after + i - 1) % nCells;",
        VERDICTS,
        "the same cell pinned again and again",
    ),
    (
        "player/headers.js",
        'if (word === "flaw" && setting.uninformative) return "none";',
        "",
        HEADERS,
        "errors of a drawing that is not there",
    ),
    (
        "player/model.js",
        "return isTrue ? 2 : 3;",
        "return isTrue ? 3 : 2;",
        MODEL,
        "missed walls taken for free cells",
    ),
    (
        "player/scores.js",
        "4 * fn + fp",
        "fn + 4 * fp",
        SCORES,
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
        'overlay === "truth" ? colours.groundTruth : colours.wallMask',
        'overlay === "truth" ? colours.wallMask : colours.groundTruth',
        GREY,
        "colours of the overlays swapped",
    ),
    (
        "player/cells.js",
        "growBox(layer.changed, c % nCols, Math.floor(c / nCols));",
        "",
        CELLS,
        "a step that is not shown",
    ),
    (
        "player/cells.js",
        "counts[c] ? 0 : OPAQUE",
        "counts[c] ? OPAQUE : 0",
        OUTCOMES,
        "seen cells hatched",
    ),
    (
        "player/cells.js",
        "  drawHatch(picture, grid, context);\n",
        "",
        OUTCOMES,
        "unseen cells not hatched",
    ),
    (
        "player/draw.js",
        "const half = scene.fovRad / 2;",
        "const half = scene.fovRad;",
        CONE,
        "a cone twice as wide",
    ),
    (
        "player/draw.js",
        "context.arc(x, y, scene.rangePx,",
        "context.arc(x, y, 1.2 * scene.rangePx,",
        CONE,
        "a cone that reaches too far",
    ),
    (
        "player/draw.js",
        "Math.max(0, state.step - 1)",
        "Math.min(419, state.step)",
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
        "if (position < stop) return;",
        "if (position <= stop) return;",
        PLAYER,
        "a replay that does not stop at its end",
    ),
    (
        "player/playback.js",
        "p.state.compact && p.state.predicted === null && isBefore",
        "p.state.compact && isBefore",
        STORY,
        "a question that is asked again",
    ),
    (
        "player/playback.js",
        "Math.min(stop, p.position + seconds * speedOf(p))",
        "p.position + seconds * speedOf(p)",
        STORY,
        "a long frame that jumps over the question",
    ),
    (
        "player/story.js",
        "for (const setting of p.state.columns) setting.rule = rule;",
        "p.state.columns[0].rule = rule;",
        STORY,
        "a switch for one map only",
    ),
    (
        "player/story.js",
        "setPrior(column, { ...p.state.columns[i], rule });",
        "setPrior(column, p.state.columns[i]);",
        STORY,
        "F2 before and after under the same rule",
    ),
    (
        "player/story.js",
        "map(({ prior_once }) => prior_once)",
        "map(({ subtract_prior }) => subtract_prior)",
        STORY,
        "the best map named by the rule that is switched on",
    ),
    (
        "player/feet.js",
        'n === 1 ? "reading" : "readings"',
        '"readings"',
        SCORES,
        "one readings",
    ),
    (
        "player/playback.js",
        "const target = clamp(step, 0, p.scene.nReadings);",
        "const target = step;",
        PLAYER,
        "a step beyond the readings",
    ),
    (
        "player/player.js",
        "state.step = clamp(state.step, 0, scene.nReadings);",
        "",
        PLAYER,
        "a restored step beyond the readings",
    ),
    (
        "player/player.js",
        "state.pin_px = p.pin;",
        "",
        PLAYER,
        "a pin outside the drawing that is sent to Python",
    ),
    (
        "player/player.js",
        'if (p.pin !== null || !p.header.hasTruth) p.tab = "cell";',
        'if (p.pin !== null || !p.header.hasTruth) openTab(p, "cell");',
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
        "  showStep(p);\n  if (p.columns) say(p, stateWords(p));\n",
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
        "isDone: term.reading < step",
        "isDone: term.reading <= step",
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
        'declaresWall(column, logOdds) ? "wall" : "no wall"',
        'declaresWall(column, logOdds) ? "no wall" : "wall"',
        f"{IN_BROWSER}hovering_shows_a_cells_numbers_on_both_pictures",
        "a cell whose class is shown the wrong way round",
    ),
    (
        "lens/optics.js",
        "firstHit(world, ray, edgeEps)",
        "firstHit(world, ray, 0)",
        RAYS,
        "a ray that slips past the corner it grazes",
    ),
    (
        "lens/optics.js",
        "leaves < 1e-6",
        "leaves < -1",
        RAYS,
        "a robot that touches a wall taken to stand in it",
    ),
    (
        "lens/optics.js",
        "surfaceDepth + edgeEps",
        "surfaceDepth - edgeEps",
        RAYS,
        "a wall pixel exactly at the depth of the surface left out",
    ),
    (
        "lens/adding.js",
        'add("less", -l0, i + 1)',
        'add("less", l0, i + 1)',
        SUMS,
        "a prior added again at every reading of the lens",
    ),
    (
        "lens/adding.js",
        "n === 2 && empty === 1 ? 2 : 1",
        "1",
        LENS,
        "one order of two readings counted for both",
    ),
    (
        "lens/document.js",
        "((i + 0.5) * state.size) / size",
        "(i * state.size) / size",
        LENS,
        "another place selected when the cells change size",
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
