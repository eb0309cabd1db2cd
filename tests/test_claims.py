"""The source's claims: judged by hand-made facts, counted, and written."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest

from occsim import (
    EvidenceLog,
    EvidenceTotals,
    Grid,
    MappingRun,
    MapSettings,
    Prior,
    Region,
    UpdateRule,
    flawed_mask,
    load_sample,
    logit,
)
from occsim.cli import main
from occsim.flaws import DrawingFlaws
from occsim.priors import SOURCE_AXIS, ParetoFront, PriorSweep
from occsim.study.claims import (
    CHOICES,
    CLAIMS,
    CONDITIONS,
    SOURCE_CONDITION,
    Condition,
    Facts,
    Reach,
    Readings,
    Walls,
    behind,
    case_rows,
    claims_document,
    claims_text,
    count_rows,
    departures,
    facts_of,
    judge_case,
    judged,
    matching,
    read_claims,
    tally,
)
from occsim.study.claims import judging as j
from occsim.study.claims.facts import Openings, every, find_openings
from tests.test_study import drawing_of, room

AXIS = np.array(SOURCE_AXIS)
ALL = np.ones((10, 10))


def facts(tp=ALL, fp=0 * ALL, fn=ALL, **cached):
    """Facts whose sweep has these counts; other cached values may be given too."""
    tp, fp, fn = (np.broadcast_to(x, (10, 10)).astype(np.int64) for x in (tp, fp, fn))
    sweep = PriorSweep(AXIS, AXIS, tp=tp, fp=fp, fn=fn, tn=np.zeros_like(tp))
    made = object.__new__(Facts)
    for name, value in {"sweep": sweep, **cached}.items():
        object.__setattr__(made, name, value)
    return made


def at(p_wall=None, p_space=None):
    """1 at some pairs of the sweep, 0 at the others."""
    marked = np.zeros((10, 10))
    rows = slice(None) if p_wall is None else [SOURCE_AXIS.index(p) for p in p_wall]
    cols = slice(None) if p_space is None else [SOURCE_AXIS.index(p) for p in p_space]
    marked[rows, :] += 1
    marked[:, cols] += 1
    return (marked == 2).astype(float)


# --- Conditions -----------------------------------------------------------------------


def test_all_products_of_the_choices_are_judged_the_sources_first():
    """2 x 2 x 2 x 5 x 4 x 2."""
    assert len(CONDITIONS) == 320 == len(set(CONDITIONS))
    assert CONDITIONS[0] == SOURCE_CONDITION == Condition()
    assert SOURCE_CONDITION.rule is UpdateRule.SUBTRACT_PRIOR


def test_departures_differ_from_the_source_in_one_choice():
    first, *others = departures()
    assert first == SOURCE_CONDITION
    for other in others:
        assert sum(a != b for a, b in zip(first.words, other.words, strict=True)) == 1
    assert len(others) == sum(len(values) - 1 for values in CHOICES.values())


# --- Facts ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def by_condition():
    """Sample d with cells of 10 px under every condition."""
    cases = {facts.condition: facts for facts in facts_of(load_sample("d"), 10)}
    assert tuple(cases) == CONDITIONS
    return cases


def conditions_of_a_run():
    """Some conditions, and what makes the same run of them by hand."""
    sample = load_sample("d")
    thin = flawed_mask(sample.wall_mask, DrawingFlaws(thickness_px=-2))
    far = replace(sample.sensor, range_px=2 * sample.sensor.range_px)
    few = replace(sample.trajectory, poses=sample.trajectory.poses[::4])
    laps = replace(sample.trajectory, poses=np.tile(sample.trajectory.poses, (3, 1)))
    unseen = replace(sample.sensor, behind_hit="unseen")
    return {
        "source": ({}, sample, sample.sensor),
        "once": ({"rule": UpdateRule.PRIOR_ONCE}, sample, sample.sensor),
        "all": ({"region": Region.ALL}, sample, sample.sensor),
        "unseen": ({"behind_hit": unseen.behind_hit}, sample, unseen),
        "thin": ({"walls": Walls.THINNED_2}, replace(sample, found=thin), None),
        "true": ({"walls": Walls.TRUE}, replace(sample, found=sample.truth), None),
        "few": ({"readings": Readings.FOURTH}, replace(sample, trajectory=few), None),
        "laps": ({"readings": Readings.LAPS}, replace(sample, trajectory=laps), None),
        "far": ({"reach": Reach.DOUBLED}, sample, far),
    }


@pytest.mark.parametrize("name", list(conditions_of_a_run()))
def test_a_condition_is_the_run_that_its_words_say(by_condition, name):
    """Against `MappingRun` on a building changed by hand: nothing is shared there."""
    change, building, sensor = conditions_of_a_run()[name]
    condition = Condition(**change)
    found = by_condition[condition]
    settings = MapSettings(cell_px=10, sensor=sensor or building.sensor)
    run = MappingRun(building, settings)
    rule, region = condition.rule, condition.region
    expected = run.sweep(rule=rule, region=region)
    for counts in ("tp", "fp", "fn", "tn"):
        np.testing.assert_array_equal(
            getattr(found.sweep, counts), getattr(expected, counts)
        )
    front = run.front(rule, region)
    np.testing.assert_array_equal(found.front.precision, front.precision)
    for scores, prior in (
        (found.source_scores(), Prior()),
        (found.blank_scores(), Prior.uninformative()),
    ):
        ours = run.scores(prior, rule, region)
        assert scores == pytest.approx(
            (ours.precision, ours.recall, ours.f2), nan_ok=True
        )
    declared = run.map(Prior(p_wall=0.3, p_space=0.7), rule).log_odds < -1e-9
    np.testing.assert_array_equal(found.declared(0.3, 0.7), declared)


def test_every_second_reading_is_the_first_the_third_and_so_on():
    """Three readings of cell 0: 0.9, 0.1, 0.9; the second is left out."""
    grid = Grid(height_px=1, width_px=2, cell_px=1)
    log = EvidenceLog(grid, [0, 1, 3, 4], [0, 0, 1, 0], logit([0.9, 0.1, 0.1, 0.9]))
    halved = every(log, 2)
    np.testing.assert_array_equal(halved.counts, [[2, 0]])
    np.testing.assert_array_equal(halved.sums, [[2 * logit(0.9), 0.0]])


def test_a_doorway_is_a_gap_no_wider_than_a_door():
    """A row of walls with gaps of 2 and 3 cells; a door is 2.5 cells long."""
    truth = np.zeros((5, 12), dtype=bool)
    truth[2] = True
    truth[2, [2, 3, 7, 8, 9]] = False
    found = find_openings(truth, 2.5)
    assert np.argwhere(found.doorways).tolist() == [[2, 2], [2, 3]]
    # Beside walls: the rows above and below, and the ends of the wider gap.
    beside = np.zeros_like(truth)
    beside[[1, 3]] = True
    beside[[1, 3], 8] = False
    beside[2, [7, 9]] = True
    np.testing.assert_array_equal(found.beside, beside)
    np.testing.assert_array_equal(
        find_openings(truth.T, 2.5).doorways, found.doorways.T
    )


# --- Claims ---------------------------------------------------------------------------


def test_c1_and_c2_look_at_all_tied_pairs():
    """Precision 1 where FP is 0; recall is TP / 2."""
    some = facts(fp=1 - at(p_space=[0.2, 0.3, 0.4]))
    assert j.precision_peaks_low(some) == (True, pytest.approx(2 / 3))
    assert not j.precision_peaks_low(facts(fp=1 - at(p_space=[0.2]))).holds
    only = facts(tp=1 + at(p_space=[1.0]), fn=1 - at(p_space=[1.0]))
    assert j.recall_peaks_at_one(only) == (True, 1.0)
    also = facts(tp=1 + at(p_space=[0.9, 1.0]), fn=1 - at(p_space=[0.9, 1.0]))
    assert j.recall_peaks_at_one(also) == (False, 0.5)


def test_c3_counts_the_pairs_that_have_both():
    apart = facts(tp=1 + at([1.0]), fp=at([1.0]), fn=1 - at([1.0]))
    assert j.no_pair_has_both(apart) == (True, 0.0)
    assert j.no_pair_has_both(facts()) == (False, 100.0)


def test_c4_is_the_sign_of_the_correlation():
    """Recall rises where precision falls, and the other way round."""
    steps = np.arange(10)[:, None] * ALL
    oppose = facts(tp=10 + steps, fp=steps**2, fn=10 - steps)
    assert j.surfaces_oppose(oppose).holds
    together = facts(tp=10 + steps, fp=90 - 10 * steps, fn=10 - steps)
    assert j.surfaces_oppose(together) == (False, pytest.approx(0.9, abs=0.05))
    assert j.surfaces_oppose(facts()).holds is None


def test_c5_compares_neighbours_at_the_lowest_p_space_of_the_peak():
    """At p_space = 0.4: 1/2 at p_wall = 0.1, 1 at 0.2, 1/4 at 0.3."""
    fp = 9 * ALL
    fp[:3, 3] = [1, 0, 3]
    assert j.precision_is_best_at_two_tenths(facts(fp=fp)) == (True, 50.0)
    fp[0, 3] = 0
    assert j.precision_is_best_at_two_tenths(facts(fp=fp)) == (False, 0.0)


def test_c6_is_the_distance_to_the_nearest_point_of_the_front():
    """From (0.5, 0.5) to (0.52, 0.6) and (0.9, 0.51): 10 and 40 points."""
    front = ParetoFront(*np.array([[0.1, 0.2], [0.1, 0.2], [0.9, 0.52], [0.51, 0.6]]))
    sweep = {"front": front, "source_scores": lambda: (0.5, 0.5, 0.5)}
    far = facts(near=np.zeros((10, 10), bool), **sweep)
    assert j.source_pair_is_on_the_front(far) == (False, pytest.approx(10.0))
    near = facts(near=at([0.2], [0.9]).astype(bool), **sweep)
    assert j.source_pair_is_on_the_front(near).holds


def test_c8_sees_missed_walls_closed_doors_and_thick_walls():
    """Best precision with recall 1/4. A wall, a doorway, a wall: read as wall each."""
    missed = facts(tp=1 + at([0.5]), fp=9 * at([0.5]), fn=3 - at([0.5]))
    assert j.best_precision_misses_walls(missed) == (True, 0.75)
    grid = Grid(height_px=1, width_px=4, cell_px=1)
    truth = np.array([[True, False, True, False]])
    seen = EvidenceTotals(grid, np.full((1, 4), logit(0.1)), np.ones((1, 4), int))
    built = Facts(
        condition=Condition(rule=UpdateRule.PRIOR_ONCE),
        totals=seen,
        is_wall=truth,
        truth=truth,
        openings=Openings(
            np.array([[False, True, False, False]]),
            np.array([[False, False, False, True]]),
        ),
        cost_ratio=1.0,
    )
    assert built.recall.value == 1.0
    assert j.best_recall_closes_doors(built) == (True, 1.0)
    assert j.best_recall_thickens_walls(built) == (True, 1.0)


def test_c9_allows_a_fifth_for_what_a_clock_cannot_tell():
    assert j.a_step_costs_the_same(facts(cost_ratio=1.1)) == (True, 1.1)
    assert not j.a_step_costs_the_same(facts(cost_ratio=1.3)).holds


def test_c11_is_the_gain_in_f2():
    """From 0.5 to 0.55 and to 0.65: by 10 and by 30 %."""
    for f2, much in ((0.55, False), (0.65, True), (0.45, False)):
        some = facts(
            source_scores=lambda f2=f2: (1.0, 1.0, f2),
            blank_scores=lambda: (1.0, 1.0, 0.5),
        )
        assert j.source_pair_raises_f2(some).holds == (f2 > 0.5)
        assert j.source_pair_raises_f2_much(some) == (
            much,
            pytest.approx(100 * (f2 / 0.5 - 1)),
        )


def test_c7_needs_a_pair_on_all_fronts():
    one, other = (at(p_space=p).astype(bool) for p in ([0.1, 0.2], [0.2, 0.3]))
    assert j.pairs_in_common(np.stack([one, other])) == (True, 10.0)
    assert j.pairs_in_common(np.stack([one, at([0.1], [0.9]).astype(bool)])) == (
        False,
        0.0,
    )
    assert j.pairs_in_common(one[None]).holds is None


def test_c10_is_the_furthest_move_between_the_nearest_tied_pairs():
    """Precision stays; recall moves from (0.5, 1) to (0.8, 1): by 0.3."""
    stays = at([0.1, 0.2], [0.3])
    peaks = np.array(
        [[stays, at([0.4, 0.5], [1.0])], [at([0.2], [0.3]), at([0.8], [1.0])]]
    ).astype(bool)
    assert j.peaks_move_little(peaks) == (False, 0.3)
    assert j.peaks_move_little(peaks[[0, 0]]) == (True, 0.0)
    assert j.peaks_move_little(peaks[:1]).holds is None


@pytest.mark.parametrize("claim", list(j.ON_A_CASE))
def test_a_case_without_a_wall_decides_no_claim_but_the_cost(claim):
    empty = drawing_of(np.zeros((40, 40), dtype=bool), poses=((20, 20, 0.0),))
    found = judge_case(empty, 10).findings[claim]
    if claim == "C9":
        assert None not in found.holds
    else:
        assert set(found.holds) == {None}
        assert np.isnan(found.values).all()


def test_every_claim_has_a_sentence_and_a_judge():
    assert [name for name in CLAIMS if name not in j.ON_A_CASE] == ["C7", "C10"]
    docs = {name: judge.__doc__.split(",")[0] for name, judge in j.ON_A_CASE.items()}
    assert docs == {name: name for name in j.ON_A_CASE}


# --- Counting and writing -------------------------------------------------------------


@pytest.fixture(scope="module")
def cases():
    drawings = drawing_of(room(), "one"), drawing_of(room((60, 90)), "two")
    return [judge_case(drawing, px) for drawing in drawings for px in (5, 10)]


def test_a_case_comes_back_from_its_document(cases):
    document = json.loads(
        json.dumps(claims_document(drawing_of(room(), "one"), 5, None))
    )
    again = read_claims(document | {"cell_px": 5})
    assert (again.name, again.cell_px) == ("one", 5)
    for claim, found in cases[0].findings.items():
        if claim != "C9":  # timed
            assert again.findings[claim].holds == found.holds
            np.testing.assert_allclose(
                again.findings[claim].values, found.values, rtol=1e-5
            )
    np.testing.assert_array_equal(again.near, cases[0].near)
    np.testing.assert_array_equal(again.peaks, cases[0].peaks)


def test_counts_are_of_cases_drawings_and_cell_sizes(cases):
    counts = tally(judged(cases))
    assert list(counts) == list(CLAIMS)
    assert counts["C9"].applies.tolist() == [4] * 320
    assert counts["C10"].applies.max() == counts["C7"].applies.max() == 2
    for claim in ("C2", "C7", "C10"):
        for i in (0, 100, 319):
            found = behind(judged(cases), claim, [CONDITIONS[i]])
            assert counts[claim].holds[i] == sum(one.holds is True for one in found)
            values = [one.value for one in found if one.holds is not None]
            if values:
                assert counts[claim].mean_value[i] == pytest.approx(np.mean(values))
    labels = [one.label for one in behind(judged(cases), "C3", [SOURCE_CONDITION])]
    assert labels == ["one, 5 px", "one, 10 px", "two, 5 px", "two, 10 px"]
    assert [one.label for one in judged(cases) if "C7" in one.findings] == [
        "5 px",
        "10 px",
    ]


def test_counts_of_several_conditions_are_added(cases):
    count = tally(judged(cases))["C2"]
    some = matching({"walls": Walls.TRUE, "readings": Readings.LAPS, "region": None})
    assert len(some) == 320 / 5 / 4
    at = [CONDITIONS.index(condition) for condition in some]
    holds, applies, mean = count.over(some)
    assert (holds, applies) == (count.holds[at].sum(), count.applies[at].sum())
    found = behind(judged(cases), "C2", some)
    assert len(found) == 4 * len(some)
    assert mean == pytest.approx(np.nanmean([one.value for one in found]))


def test_pairs_in_common_are_those_of_all_drawings(cases):
    """Counted case by case, not carried from drawing to drawing."""
    (at_5, _) = (one for one in judged(cases) if "C7" in one.findings)
    near = np.stack([case.near for case in cases if case.cell_px == 5], axis=1)
    expected = [j.pairs_in_common(those) for those in near]
    assert at_5.findings["C7"].holds == tuple(one.holds for one in expected)


def test_rows_have_every_condition(cases):
    rows = list(count_rows(tally(judged(cases))))
    assert len(rows) == len(CLAIMS) * 320
    behind_them = list(case_rows(judged(cases)))
    assert len(behind_them) == (4 + 2 + 2) * 320
    assert len(set(map(len, behind_them))) == 1


def test_the_command_writes_counts_cases_and_versions(tmp_path, capsys):
    command = ["claims", "d", "--cell", "10", "25", "--out", str(tmp_path)]
    assert main(command) == 0
    text = capsys.readouterr().out
    assert "C11b: (0.2, 0.9) raises F2 by more than 20 % (Article)" in text
    document = json.loads((tmp_path / "claims.json").read_text(encoding="utf-8"))
    assert set(document["software"]) == {"occsim", "numpy", "opencv"}
    assert len(document["conditions"]) == len(document["claims"]["C1"]["holds"]) == 320
    with (tmp_path / "claims.csv").open(encoding="utf-8") as file:
        counts = list(csv.DictReader(file))
    with (tmp_path / "cases.csv").open(encoding="utf-8") as file:
        behind_them = list(csv.DictReader(file))
    for row in counts[:3]:
        same = [
            one
            for one in behind_them
            if all(one[name] == row[name] for name in CHOICES) and one["C1"]
        ]
        assert int(row["of"]) == len(same)
        assert int(row["holds"]) == sum(one["C1"] == "yes" for one in same)
    assert main(command) == 0
    assert capsys.readouterr().err.count("kept") == 2


def test_the_text_shows_the_source_and_each_departure(cases):
    text = claims_text(tally(judged(cases)))
    assert "as we reconstruct them; its update rule" in text
    first = text.splitlines()[0].split("  ")
    titles = [word.strip() for word in first if word.strip()]
    assert titles == [
        "source",
        "once",
        "unseen",
        "all cells",
        "thin 1",
        "thin 2",
        "thin 3",
        "true",
        "1 of 2",
        "1 of 4",
        "3 laps",
        "range x2",
        "all 320",
    ]
