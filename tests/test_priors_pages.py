"""The pages on sweeps and fronts: every control once, and cases without a result."""

import math
from dataclasses import replace

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from occsim import (
    BehindHit,
    Objective,
    Prior,
    Region,
    Reliability,
    Scores,
    Trajectory,
    UpdateRule,
    estimated_prior,
    sample_names,
)
from occsim import reliability as measured
from occsim.building import Building
from occsim.imaging import load_drawing
from occsim.prior import PRIOR_SCALE
from occsim.priors import Elitism, near_front, recommend
from occsim.study.published import SOURCE_CELLS_PX, published_maximum
from occsim.world import wall_cells
from pages._ui import compute, state
from pages._ui.choices import (
    CHOICES,
    Drawings,
    Exploring,
    Fineness,
    FrontAxes,
    Handover,
    Objectives,
    Picture,
    PriorDrawing,
    Surface,
)
from pages._ui.priors import (
    front_figures,
    front_marks,
    fronts,
    guiding,
    maps,
    marks,
    reliability,
    search_figures,
    solving,
    surface_figures,
    surfaces,
)
from pages._ui.settings import Settings, encode, with_changes
from pages._ui.words import percent
from tests.test_pages import ROOT, control, png, said

SWEEP = "pages/5_Sweep_the_priors.py"
EXPLORER = "pages/6_Pareto_explorer.py"
BEST = "pages/7_Best_prior.py"
STUDY = "pages/8_Study.py"
PAGES = (SWEEP, EXPLORER, BEST, STUDY)


def open_with(page, **changes):
    """A page opened by a link that holds some settings; it must not raise."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    for name, text in encode(with_changes(Settings(), changes)).items():
        app.query_params[name] = text
    app.switch_page(page).run()
    assert not app.exception
    return app


def setting(app, name):
    return getattr(app.session_state["settings"], name)


def texts(app):
    """All words of a page."""
    kinds = (app.markdown, app.caption, app.warning, app.info, app.error)
    return "\n".join(text for kind in kinds for text in said(kind))


def press(app, label):
    next(button for button in app.button if button.label.startswith(label)).click()
    app.run()
    assert not app.exception
    return app


# --- Every control ------------------------------------------------------------------


@pytest.mark.parametrize("surface", Surface)
@pytest.mark.parametrize("drawings", Drawings)
def test_each_surface_is_drawn_for_one_drawing_and_for_all(surface, drawings):
    app = open_with(SWEEP, surface=surface, drawings=drawings, cell_px=10)
    # Precision, recall and bits, in a row for each rule.
    assert len(app.get("plotly_chart")) == (6 if drawings is Drawings.THIS else 1)


def test_each_fineness_is_drawn():
    app = open_with(SWEEP, surface=Surface.EXACT, cell_px=10)
    for fineness in Fineness:
        app.selectbox(key=control(app, "fineness")).select(fineness).run()
        assert not app.exception


def test_a_pair_set_by_hand_is_kept_for_every_page():
    app = open_with(SWEEP, uninformative=True)
    app.slider(key=control(app, "p_wall")).set_value(0.35).run()
    assert setting(app, "p_wall") == 0.35
    assert "(p_wall, p_space) = (0.35, 0.9)" in texts(app)


def test_all_five_have_their_maxima_in_one_table():
    app = open_with(SWEEP, drawings=Drawings.ALL, cell_px=10)
    for name in sample_names():
        assert f"| {name} | precision |" in texts(app)


@pytest.mark.parametrize("axes", FrontAxes)
@pytest.mark.parametrize("picture", Picture)
def test_one_front_is_explored(axes, picture):
    app = open_with(EXPLORER, axes=axes, picture=picture, cell_px=10)
    assert "No drawing (blank map)" in texts(app)


@pytest.mark.parametrize("rule", UpdateRule)
@pytest.mark.parametrize("behind_hit", BehindHit)
def test_all_readings_of_the_source_can_be_explored(rule, behind_hit):
    region = Region.ALL if rule is UpdateRule.PRIOR_ONCE else Region.EXPLORED
    open_with(EXPLORER, cell_px=10, rule=rule, behind_hit=behind_hit, region=region)


@pytest.mark.parametrize("label", ["Best F2", "Best precision", "Best recall"])
def test_a_button_chooses_a_point_of_the_front(label):
    app = press(open_with(EXPLORER), label)
    assert "The chosen pair is on the front." in texts(app)


def longest_front(cell_px):
    """The reference drawing with most points on its front, and that front."""
    settings = Settings(cell_px=cell_px)
    runs = {name: compute.reference_run(name, settings) for name in sample_names()}
    name = max(runs, key=lambda name: len(runs[name].front))
    return name, runs[name].front


def test_the_slider_walks_along_the_front():
    name, front = longest_front(5)
    app = open_with(EXPLORER, cell_px=5)
    app.selectbox(key=control(app, "choice")).select(name).run()
    slider = app.select_slider(key="front_point_prior_once")
    assert slider.value == 0  # the chosen pair is not on the front
    for index in (1, len(front)):
        slider.set_value(index).run()
        pair = setting(app, "p_wall"), setting(app, "p_space")
        assert pair == (front.p_wall[index - 1], front.p_space[index - 1])
        slider = app.select_slider(key="front_point_prior_once")
        assert slider.value == index


def test_the_slider_of_a_front_stands_on_no_point_that_was_not_chosen():
    name, front = longest_front(5)
    app = open_with(EXPLORER, cell_px=5)
    app.selectbox(key=control(app, "choice")).select(name).run()
    app.select_slider(key="front_point_prior_once").set_value(len(front)).run()
    app.slider(key=control(app, "p_space")).set_value(0.05).run()
    assert app.select_slider(key="front_point_prior_once").value == 0
    assert "The chosen pair is off the front" in texts(app)


def test_a_front_of_one_point_is_reported():
    """Prior and truth are the same wall: where it is seen, one pair is best."""
    app = of_one_sheet(
        EXPLORER, Settings(range_px=20, cell_px=4), prior_wall=True, true_wall=True
    )
    assert "attains the highest precision and the highest recall of all" in texts(app)


@pytest.mark.parametrize("page", [SWEEP, EXPLORER])
def test_walls_are_thinned_and_restored_by_one_button(page):
    app = press(open_with(page, cell_px=10), "Thin walls by 2 px")
    assert setting(app, "thickness_px") == -2
    has_fronts = page == EXPLORER
    assert ("With the drawing as it is, this front has" in texts(app)) == has_fronts
    app = press(app, "Drawing as it is")
    assert setting(app, "thickness_px") == 0
    assert "With the drawing as it is" not in texts(app)


def test_an_empty_set_c_is_reported():
    """Only the sides of walls that face the robot are seen: recall stays below 0.95."""
    app = open_with(EXPLORER, min_recall=0.95, behind_hit=BehindHit.UNSEEN)
    assert "Set C is empty" in texts(app)


@pytest.mark.parametrize("objectives", Objectives)
@pytest.mark.parametrize("elitism", Elitism)
def test_a_search_runs_and_its_generations_are_kept(objectives, elitism):
    changes = {"objectives": objectives, "elitism": elitism, "n_gen": 5}
    changes |= {"pop_size": 20, "cell_px": 10}
    app = open_with(EXPLORER, exploring=Exploring.SEARCH, **changes)
    app = press(app, "Run the search")
    assert "5 generations of 20 pairs, seed 1" in texts(app)
    app.number_input(key=control(app, "seed")).set_value(2).run()
    assert "generations of" not in texts(app)


@pytest.mark.parametrize("axes", FrontAxes)
def test_all_drawings_are_compared(axes):
    app = open_with(EXPLORER, exploring=Exploring.ALL, axes=axes, cell_px=10)
    assert "of every drawing's front" in texts(app)
    app = press(app, "Choose")
    assert setting(app, "p_wall") in surfaces.axis(0.02)
    assert setting(app, "p_space") in surfaces.axis(0.02)


HELPFUL = [one for one in Handover if one is not Handover.SUBTRACT]
FILES = ["PNG", "NPY", "CSV", "JSON"]


def downloads(app):
    return [button.label for button in app.get("download_button")]


@pytest.mark.parametrize("handover", HELPFUL)
def test_the_path_ends_in_four_files(handover):
    app = open_with(BEST, handover=handover)
    assert downloads(app) == FILES
    assert "this prior" in texts(app)


def test_the_negative_of_a_drawing_is_handed_over_only_after_a_warning():
    app = open_with(BEST, handover=Handover.SUBTRACT)
    assert "negative of the drawing" in "\n".join(said(app.warning))
    assert downloads(app) == []
    app.checkbox[0].check().run()
    assert downloads(app) == FILES


def test_the_warning_says_what_a_negative_prior_is_for_under_its_rule():
    """Shifted off its walls, the drawing misleads: the calibrated prior, counted once,
    gives drawn walls more than the space between them, and both more than one half."""
    app = open_with(BEST, shift_x_px=20, shift_y_px=-20)
    wall, space = best_prior_run(app).mapped.calibrated
    assert wall > space > 0.5
    warning = "\n".join(said(app.warning))
    assert "believes the opposite of what is drawn" in warning
    assert "takes the drawing off" not in warning
    app = open_with(BEST, handover=Handover.SUBTRACT)
    assert "takes the drawing off at every reading" in "\n".join(said(app.warning))


@pytest.mark.parametrize("handover", [Handover.CALIBRATED, Handover.SUBTRACT])
def test_the_front_of_the_last_page_is_that_of_the_answers_rule(handover):
    app = open_with(BEST, handover=handover)
    subtract = handover is Handover.SUBTRACT
    rule = UpdateRule.SUBTRACT_PRIOR if subtract else UpdateRule.PRIOR_ONCE
    shown = texts(app)
    assert f"{len(best_prior_run(app).under(rule).front)} points, exact" in shown
    assert f"the answer to hand over: {CHOICES[rule].lower()}" in shown


def test_what_repeats_the_sources_rule_is_called_a_reconstruction():
    app = open_with(BEST)
    assert "taken off at every reading (the source, as we reconstruct it)" in texts(app)


def test_no_answer_is_said_to_be_certain():
    """In d all cells of each class agree: the fewest bits lie at the end of a range."""
    building = compute.sample("d")
    run = compute.run(building, Settings(range_px=20))
    wall, space, _ = run.mapped.best_in_bits(UpdateRule.PRIOR_ONCE, Region.ALL)
    said = guiding.prior_text(Prior(p_wall=wall, p_space=space, scale=1.0))
    assert said == "p_free is below 0.001 on wall cells and above 0.999 elsewhere."


def best_prior_run(app):
    return compute.run(compute.sample(state.OPENING), app.session_state["settings"])


def test_the_answer_goes_to_every_page():
    app = press(open_with(BEST, handover=Handover.ONCE), "Use this pair")
    run = best_prior_run(app)
    index = recommend(run.front, app.session_state["settings"].min_recall)
    best = float(run.front.p_wall[index]), float(run.front.p_space[index])
    assert (setting(app, "p_wall"), setting(app, "p_space")) == best


def test_a_prior_beyond_the_sliders_goes_to_their_end():
    app = open_with(BEST)
    run = best_prior_run(app)
    p_free_wall, p_free_space = run.mapped.calibrated
    assert p_free_space > PRIOR_SCALE
    app = press(app, "Use this pair")
    assert setting(app, "p_wall") == pytest.approx(p_free_wall / PRIOR_SCALE, abs=1e-4)
    assert setting(app, "p_space") == 1.0


def test_each_answer_is_scored_under_its_own_rule_beside_the_blank_map():
    app = open_with(BEST, rule=UpdateRule.SUBTRACT_PRIOR)
    run = best_prior_run(app)
    rows = {
        cells[1]: cells[2:-1]
        for table in said(app.markdown)
        if table.startswith("| Map |")
        for cells in (
            [cell.strip() for cell in line.replace("\xa0", " ").split("|")]
            for line in table.splitlines()
        )
    }
    p_free_wall, p_free_space = run.mapped.calibrated
    calibrated = Prior(p_wall=p_free_wall, p_space=p_free_space, scale=1.0)
    once = UpdateRule.PRIOR_ONCE
    expected = run.mapped.scores(calibrated, once).recall
    assert rows["Calibrated"][1] == percent(expected)
    blank = run.mapped.scores(Prior.uninformative())
    assert rows["No drawing (blank map)"][0] == percent(blank.precision)


def test_the_reliability_of_the_map_is_drawn_without_empty_bins():
    """Two cells say 0.8, one of them is free; one says 0.1 and is wall."""
    nan = float("nan")
    half = Reliability(
        edges=np.array([0.0, 0.5, 0.75, 1.0]),
        mean_p_free=np.array([0.1, nan, 0.8]),
        share_free=np.array([0.0, nan, 0.5]),
        count=np.array([1, 0, 2]),
    )
    marks = reliability.figure({"one": half, "two": half}).data[1]
    assert (list(marks.x), list(marks.y)) == ([0.1, 0.8], [0.0, 0.5])
    assert marks.marker.size[1] == reliability.LARGEST_PX > marks.marker.size[0]


def test_the_calibration_error_of_the_map_handed_over_is_said():
    app = open_with(BEST, handover=Handover.BITS)
    run = best_prior_run(app)
    prior = solving.best_in_bits(run, UpdateRule.PRIOR_ONCE)
    final = run.mapped.map(prior, UpdateRule.PRIOR_ONCE)
    error = measured(final, run.mapped.truth_cells).expected_calibration_error
    assert f"Fewest bits {percent(error)}" in texts(app)


def test_a_drawing_without_ground_truth_gets_the_estimate_of_the_others():
    building = replace(compute.sample("d"), truth=None)
    of = compute.run(building, Settings())
    others = [
        compute.reference_run(name, Settings()).mapped for name in ("a", "b", "c", "e")
    ]
    expected = estimated_prior([(one.wall_cells, one.truth_cells) for one in others])
    prior = solving.calibrated(of)
    assert (prior.p_free_wall, prior.p_free_space) == expected


def test_answers_are_tried_on_other_drawings_and_other_tours():
    of = compute.run(compute.sample("d"), Settings(range_px=20))
    places = solving.transfer_runs(of)
    others = {run.building.title for run in places["other drawings"]}
    assert others == {compute.sample(name).title for name in "abce"}
    tours = [run.building.trajectory for run in places["other tours"]]
    assert all(len(tour) <= len(of.building.trajectory) for tour in tours)
    assert all(run.mapped.truth_cells.any() for run in places["other tours"])


@pytest.mark.parametrize("source", [PriorDrawing.D, PriorDrawing.MIRRORED])
def test_other_drawings_have_their_own_walls_and_the_same_errors(source):
    """c, d and e have one size: the drawing of d is right for d and wrong for e."""
    of = compute.run(compute.sample("c"), Settings(prior_drawing=source, range_px=20))
    for run in solving.other_drawings(of):
        own = run.building.wall_mask
        mirrored = own[:, ::-1] if source is PriorDrawing.MIRRORED else own
        assert (run.mapped.wall_cells == wall_cells(mirrored, run.mapped.grid)).all()


def test_errors_of_the_other_drawings_are_told():
    words = "with the same errors of the drawing", "were given to those drawings too"
    for changes in ({}, {"prior_drawing": PriorDrawing.MIRRORED}):
        shown = texts(open_with(BEST, **changes))
        assert [one in shown for one in words] == [bool(changes)] * 2


def test_a_drawing_that_lost_its_walls_to_errors_is_not_said_to_have_none():
    sheet, gone = compute.sample("d"), Settings(missing_share=1.0, range_px=20)
    # Without a ground truth the walls found serve as the world, and stay.
    for building in (sheet, replace(sheet, truth=None)):
        notice = compute.run(building, gone).notice
        assert notice.startswith("With its errors the drawing has no wall")


def test_the_study_says_what_the_sources_tables_show():
    """ "recall peaks with p_space = 1 in 12 of 15 cases, precision with p_space from
    0.3 to 0.6, and no pair has both"."""
    n_at_one = 0
    for cell_px in SOURCE_CELLS_PX:
        for name in "abcde":
            recall, precision = (
                _printed_spans(published_maximum(objective, cell_px, name).pairs)
                for objective in (Objective.RECALL, Objective.PRECISION)
            )
            n_at_one += recall[1] == [1.0, 1.0]
            assert 0.3 <= precision[1][0] <= precision[1][1] <= 0.6
            ends = zip(recall, precision, strict=True)
            assert any(a[1] < b[0] or b[1] < a[0] for a, b in ends)
    assert n_at_one == 12
    assert "in 12 of 15 cases, precision" in texts(open_with(STUDY))


def _printed_spans(pairs):
    """Ends of p_wall and of p_space, as "(0.7:1, 1)" prints them."""
    values = [[float(end) for end in v.split(":")] for v in pairs[1:-1].split(", ")]
    return [[value[0], value[-1]] for value in values]


def test_the_study_prints_both_tables_and_the_pattern():
    app = open_with(STUDY)
    assert len(app.table) == 2
    first = app.table[0].value
    assert len(first) == 15
    # Table 4.1 of the source, drawing a at 3 px.
    assert first["published, %"].tolist()[0] == "98.49"
    assert "of 15 cases" in texts(app)


# --- What must not kill a page --------------------------------------------------------


def plan(wall=False):
    """A sheet of 60 x 40 px, empty or with one wall across."""
    image = np.full((40, 60), 255, np.uint8)
    if wall:
        image[18:22] = 0
    return load_drawing(png(image), name="sheet.png")


def building(*, prior_wall, true_wall, pose=(30.0, 8.0, math.pi / 2)):
    """A building of one sheet, with or without a wall in the prior and in truth."""
    sheet = plan()
    wall = plan(wall=True).gray < 128
    return Building(
        drawing=sheet,
        found=wall & prior_wall,
        truth=wall & true_wall,
        trajectory=Trajectory(poses=np.array([pose] * 3)),
    )


SAD = {
    "no wall anywhere": (
        {"prior_wall": False, "true_wall": False},
        "no wall among the scored cells",
    ),
    "no wall in the drawing": (
        {"prior_wall": False, "true_wall": True},
        "No wall was found in the drawing",
    ),
    "nothing seen": (
        {"prior_wall": True, "true_wall": True, "pose": (-500.0, -500.0, 0.0)},
        "No reading saw any cell",
    ),
    "no wall in view": (
        {"prior_wall": True, "true_wall": True, "pose": (30.0, 8.0, -math.pi / 2)},
        "no wall among the scored cells",
    ),
}


def of_one_sheet(page, settings, **parts):
    """A page about a building of one sheet."""
    app = open_with(page)
    app.session_state["own"] = building(**parts)
    app.session_state["choice"] = "own"
    app.session_state["settings"] = settings
    app.run()
    assert not app.exception
    return app


def test_every_page_with_scores_says_that_a_drawing_without_truth_judges_itself():
    told = "without errors the drawing is right everywhere"
    app = open_with(SWEEP, cell_px=10)
    assert told not in texts(app)
    app.session_state["own"] = replace(
        building(prior_wall=True, true_wall=True), truth=None
    )
    app.session_state["choice"] = "own"
    app.session_state["settings"] = Settings(range_px=20, cell_px=4)
    for page in (
        "pages/1_Build_a_map.py",
        "pages/3_Two_maps.py",
        SWEEP,
        EXPLORER,
        STUDY,
    ):
        app.switch_page(page).run()
        assert not app.exception
        assert told in texts(app)


@pytest.mark.parametrize("case", SAD)
def test_a_case_without_a_result_is_explained_on_every_page(case):
    parts, words = SAD[case]
    app = of_one_sheet(SWEEP, Settings(range_px=20, cell_px=4), **parts)
    assert words in texts(app)
    for exploring in Exploring:
        app.session_state["settings"] = Settings(
            range_px=20, cell_px=4, exploring=exploring
        )
        app.switch_page(EXPLORER).run()
        assert not app.exception
        assert words in texts(app)
    app.switch_page(BEST).run()
    assert not app.exception
    assert words in texts(app)
    app.switch_page(STUDY).run()
    assert not app.exception


def test_a_drawing_that_cannot_be_studied_is_left_out_with_a_reason():
    parts, _ = SAD["nothing seen"]
    app = of_one_sheet(STUDY, Settings(), **parts)
    assert "Drawing yours is left out: all 3 poses are" in texts(app)
    assert len(app.table[0].value) == 15


def test_undefined_precision_is_hatched_and_reported():
    """The robot looks away from the wall, so that no cell is declared occupied."""
    away = {"prior_wall": True, "true_wall": True, "pose": (30.0, 8.0, -math.pi / 2)}
    app = of_one_sheet(SWEEP, Settings(range_px=7, cell_px=4), **away)
    assert f"Hatched: {surfaces.UNDEFINED}." in texts(app)


# --- What the pages compute -----------------------------------------------------------


@pytest.fixture(scope="module")
def run_b():
    return compute.reference_run("b", Settings(cell_px=10))


def test_an_axis_has_short_decimals_and_both_ends():
    assert surfaces.axis(0.1) == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    assert len(surfaces.axis(0.01)) == 91


@pytest.mark.parametrize("objective", Objective)
def test_the_interpolated_surface_is_exact_at_the_tenths(run_b, objective):
    settings = Settings(surface=Surface.DIFFERENCE, fineness=Fineness.TENTH)
    view = surfaces.surface_view(run_b, settings, objective)
    np.testing.assert_allclose(view.table, 0.0, atol=1e-9)
    assert view.unit == "points"


def test_what_is_pointed_at_is_what_is_drawn(run_b):
    settings = Settings(surface=Surface.EXACT, fineness=Fineness.TWENTIETH)
    view = surfaces.surface_view(run_b, settings, Objective.RECALL)
    words, values = view.target_texts(), surfaces.TARGETS
    at = values.index(0.3) * len(values) + values.index(0.85)
    recall = run_b.scores(Prior(p_wall=0.3, p_space=0.85)).recall
    assert words[at] == f"{100 * recall:.1f} %"


def test_an_undefined_part_of_a_surface_has_a_text():
    view = surfaces.SurfaceView(
        name="precision",
        unit="%",
        values=[0.1, 0.55, 1.0],
        table=np.array([[np.nan, 50.0, 60.0]] * 3),
        targets=np.array([[np.nan, 50.0]]),
        blank=50.0,
    )
    assert view.share_above_blank == pytest.approx(1 / 3)
    assert view.has_gaps
    assert view.range == (50.0, 60.0)
    assert view.target_texts() == [surfaces.UNDEFINED, "50.0 %"]
    assert surface_figures.colour_range([view]) == (50.0, 100.0)


def test_distance_is_the_tolerance_at_which_a_pair_is_near(run_b):
    """Checked against `near_front` at every tenth pair, just below and at it."""
    sweep = surfaces.source_sweep(run_b)
    for i, p_wall in enumerate(sweep.p_wall.tolist()):
        for j, p_space in enumerate(sweep.p_space.tolist()):
            scores = run_b.scores(Prior(p_wall=p_wall, p_space=p_space))
            gap = fronts.distance(run_b.front, scores)
            assert near_front(sweep, run_b.front, min(gap + 1e-9, 1.0))[i, j]
            if gap > 1e-6:
                assert not near_front(sweep, run_b.front, gap - 1e-6)[i, j]


def test_a_point_of_the_front_is_nearest_to_itself(run_b):
    for i in range(len(run_b.front)):
        pair = float(run_b.front.p_wall[i]), float(run_b.front.p_space[i])
        scores = run_b.scores(Prior(p_wall=pair[0], p_space=pair[1]))
        assert fronts.nearest(run_b.front, scores) == i
        assert fronts.distance(run_b.front, scores) == 0.0


@pytest.mark.parametrize("axes", FrontAxes)
def test_recall_is_to_the_right_and_nothing_lies_beyond_perfect_scores(run_b, axes):
    figure = front_figures.front_figure(run_b.front, axes, [], 0.4)
    x, y = (figure.layout[name] for name in ("xaxis", "yaxis"))
    assert "recall" in x.title.text
    assert "precision" in y.title.text
    for axis in (x, y):
        low, high = axis.range
        if axes is FrontAxes.SCORES:
            assert 0.0 <= low < high <= 100.0
        else:
            assert 1.0 <= low < high


def test_a_mark_that_does_not_set_the_axes_stands_at_the_border_with_its_scores(run_b):
    far = front_figures.Mark("calibrated", 0.02, 0.03, "diamond", sets_axes=False)
    figure = front_figures.front_figure(run_b.front, FrontAxes.SCORES, [far], 0.4)
    (trace,) = (one for one in figure.data if one.name == "calibrated")
    assert (trace.x[0], trace.y[0]) == (
        figure.layout.xaxis.range[0],
        figure.layout.yaxis.range[0],
    )
    assert trace.text[0].strip("\u00a0") == "recall 3 %, precision 2 %"


ENDS = [(80.0, 100.0), (90.0, 100.0)]
"""Axes of recall and precision in a chart."""


def beyond(name, precision, recall):
    return front_marks.Mark(name, precision, recall, "diamond", sets_axes=False)


def labelled(*shown):
    """The names of the marks that have a label, and what each says when pointed at."""
    traces = front_marks.mark_traces(list(shown), FrontAxes.SCORES, ENDS)
    labels = [one.name for one in traces if one.text[0]]
    assert labels == [one.name for one in traces if "text" in one.mode]
    return labels, {one.name: one.hovertemplate for one in traces}


def test_labels_at_the_border_of_a_chart_do_not_overlap():
    """By hand, in 240 x 280 px: a label is 14 px high, of 10 points 280 px high."""
    low = beyond("low", 0.95, 0.20)
    near = beyond("near", 0.954, 0.30)  # 11 px higher
    high = beyond("high", 0.956, 0.40)  # 17 px higher
    assert labelled(low, near, high)[0] == ["low", "high"]
    assert labelled(near, low, high)[0] == ["near"]
    # Inside the axes a mark has no label and takes no room.
    inside = beyond("inside", 0.95, 0.90)
    assert labelled(inside, low)[0] == ["low"]


def test_marks_that_cover_each_other_at_the_border_say_each_its_scores():
    one, other = beyond("one", 0.10, 0.20), beyond("other", 0.11, 0.30)
    apart = beyond("apart", 0.95, 0.20)
    labels, said = labelled(one, other, apart)
    assert labels == ["one", "apart"]
    for words in (said["one"], said["other"]):
        assert "precision 10.0 %, recall 20.0 %" in words
        assert "precision 11.0 %, recall 30.0 %" in words
    assert "recall 30.0 %" not in said["apart"]


@pytest.mark.parametrize("axes", FrontAxes)
def test_no_two_labels_of_any_drawings_overlap(axes):
    """All five drawings in one chart, under the rule that scores next to nothing."""
    settings = Settings(rule=UpdateRule.SUBTRACT_PRIOR, axes=axes)
    runs = [compute.reference_run(name, settings) for name in "abcde"]
    scored = [run.scores(one.prior) for run in runs for one in marks.marked(run)]
    drawn = [
        beyond(str(i), at.precision, at.recall)
        for i, at in enumerate(scored)
        if at.precision > 0.0 and at.recall > 0.0
    ]
    ends = ENDS
    if axes is FrontAxes.INVERSE:
        ends = [(1.0, 1.25), (1.0, 1.1)]
    traces = front_marks.mark_traces(drawn, axes, ends)
    boxes = [
        (front_marks.placed(mark, axes, ends).label_px(), trace.y[0])
        for mark, trace in zip(drawn, traces, strict=True)
        if trace.text[0]
    ]
    assert len(boxes) >= 2
    points = (ends[1][1] - ends[1][0]) * 14 / 280
    for i, ((left, right), y) in enumerate(boxes):
        for (start, end), at in boxes[:i]:
            assert right <= start or end <= left or abs(y - at) >= points


def test_before_a_search_only_the_front_is_drawn(run_b):
    figure = search_figures.still_figure([], run_b.front, FrontAxes.SCORES)
    assert not list(figure.select_xaxes(row=2))
    assert figure.layout.title.text


def test_an_undefined_map_is_at_no_distance(run_b):
    nothing = Scores(tp=0, fp=0, fn=3, tn=5)
    assert math.isnan(fronts.distance(run_b.front, nothing))
    assert fronts.nearest(run_b.front, nothing) == 0
    assert maps.percent(nothing.precision) == maps.DASH


@pytest.mark.parametrize("objectives", Objectives)
def test_a_search_never_exceeds_the_exact_front(run_b, objectives):
    settings = Settings(objectives=objectives, n_gen=30, pop_size=60, seed=3)
    steps = list(solving.search(run_b, settings))
    assert [step.number for step in steps] == list(range(1, 31))
    assert max(step.share for step in steps) <= 1.0 + 1e-12
    assert (steps[0].seen is None) == (objectives is Objectives.EXACT)
    if objectives is Objectives.EXACT:
        assert steps[-1].share > 0.99
