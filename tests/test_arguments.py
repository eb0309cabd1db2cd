"""How the library's functions and parameters treat arguments of other types."""

import inspect
import traceback
from pathlib import Path

import numpy as np
import pytest

import occsim
from occsim import (
    Drawing,
    Elitism,
    Grid,
    OccsimError,
    ParameterError,
    Prior,
    Region,
    Sensor,
    Trajectory,
    UpdateRule,
    World,
    build_prior,
    exact_front,
    fuse,
    score,
    scores_by_reading,
    sweep_priors,
)
from occsim.io.map_pictures import OutcomeColours, outcome_picture
from occsim.logodds import is_occupied, logit
from occsim.study import StudySettings
from occsim.study.published import published_maximum
from tests.test_metrics import log_of

GRID = Grid(height_px=1, width_px=2, cell_px=1)
WALL = np.array([[True, False]])
NO_WALL = ~WALL
LOG = log_of(GRID, [{0: 0.1, 1: 0.9}, {0: 0.1}])
PRIOR_MAP = build_prior(WALL, GRID, Prior())
PAIR = [0.2], [0.9]

WITH_RULE = {
    "fuse": lambda rule: fuse(LOG, PRIOR_MAP, rule),
    "curves": lambda rule: scores_by_reading(LOG, PRIOR_MAP, WALL, rule),
    "sweep": lambda rule: sweep_priors(LOG, WALL, WALL, *PAIR, rule),
    "front": lambda rule: exact_front(LOG, WALL, WALL, rule),
}
WITH_REGION = {
    "score": lambda region: score(fuse(LOG, PRIOR_MAP), WALL, region),
    "curves": lambda region: scores_by_reading(LOG, PRIOR_MAP, WALL, region=region),
    "sweep": lambda region: sweep_priors(LOG, WALL, WALL, *PAIR, region=region),
    "front": lambda region: exact_front(LOG, WALL, WALL, region=region),
}


def counts_of(result):
    """The counts in which two results must agree."""
    names = ("log_odds", "tp", "fp", "fn", "precision", "recall")
    return [np.asarray(getattr(result, n)) for n in names if hasattr(result, n)]


@pytest.mark.parametrize(
    ("call", "kind"),
    [(call, UpdateRule) for call in WITH_RULE.values()]
    + [(call, Region) for call in WITH_REGION.values()],
    ids=[*WITH_RULE, *(f"{name}, region" for name in WITH_REGION)],
)
def test_a_choice_may_be_named_by_its_value_and_by_nothing_else(call, kind):
    name = "rule" if kind is UpdateRule else "region"
    by_name = [counts_of(call(member)) for member in kind]
    by_value = [counts_of(call(member.value)) for member in kind]
    for ours, theirs in zip(by_name, by_value, strict=True):
        for a, b in zip(ours, theirs, strict=True):
            np.testing.assert_array_equal(a, b)
    members = "UpdateRule.PRIOR_ONCE" if kind is UpdateRule else "Region.EXPLORED"
    for wrong in (None, "", kind.__name__, 0, [*kind][:1], Elitism.FULL):
        with pytest.raises(ParameterError, match=f"{name} must be one of {members} "):
            call(wrong)


def test_lists_serve_as_arrays():
    cells = WALL.tolist()
    assert score(fuse(LOG, PRIOR_MAP), cells) == score(fuse(LOG, PRIOR_MAP), WALL)
    listed, given = (sweep_priors(LOG, c, c, *PAIR) for c in (cells, WALL))
    np.testing.assert_array_equal(listed.tp, given.tp)


def test_world_and_trajectory_may_be_given_by_place():
    assert World(WALL).shape == (1, 2)
    assert Trajectory([[0.5, 0.5, 0.0]]).poses.shape == (1, 3)


def test_numbers_of_single_precision_keep_exact_ties():
    """A prior of 0.9 and one reading of 0.1 cancel; in float32 they miss by 2e-7."""
    prior = Prior(p_wall=np.float32(1), p_space=np.float32(1))
    prior_map = build_prior(WALL, GRID, prior)
    assert prior_map.p_free.dtype == np.float64
    assert not is_occupied(prior_map.log_odds + logit(0.1)).any()
    sensor = Sensor(range_px=np.float32(20), fov_rad=np.int64(1))
    assert sensor == Sensor(range_px=20.0, fov_rad=1.0)
    assert isinstance(sensor.range_px, float)


@pytest.mark.parametrize("value", ["0.5", None, np.array([0.1, 0.2]), 1j])
def test_what_is_no_number_is_refused_in_a_sentence(value):
    with pytest.raises(ParameterError, match="p_wall must be a number; got"):
        Prior(p_wall=value)
    with pytest.raises(ParameterError, match="range_px must be a number; got"):
        Sensor(range_px=value)


def test_clearing_without_a_hit_is_true_or_false():
    assert Sensor(clear_no_hit=np.bool_(False)) == Sensor(clear_no_hit=False)
    with pytest.raises(ParameterError, match="clear_no_hit must be True or False"):
        Sensor(clear_no_hit="no")


def test_log_odds_beyond_probability_are_undefined_without_a_warning():
    np.testing.assert_array_equal(logit([-0.1, 1.1]), [np.nan, np.nan])


def test_a_drawing_leaves_its_callers_array_alone():
    pixels = np.zeros((4, 5, 3), dtype=np.uint8)
    drawing = Drawing(pixels)
    pixels[:] = 255
    assert not drawing.rgb.any()
    assert not drawing.rgb.flags.writeable


def test_every_other_place_takes_a_choices_value_too():
    """Sensor, resample, dump_trajectory, maxima, the search, the study, pictures."""
    assert Sensor(behind_hit="unseen").behind_hit is occsim.BehindHit.UNSEEN
    path = [(0, 0), (3, 0)]
    for mode in occsim.HeadingMode:
        by_value = occsim.resample(path, 1, heading_mode=mode.value)
        by_name = occsim.resample(path, 1, heading_mode=mode)
        np.testing.assert_array_equal(by_value.poses, by_name.poses)
    assert occsim.dump_trajectory(by_name, "csv").startswith(b"x_px")
    sweep = sweep_priors(LOG, WALL, WALL, [0.1, 1.0], [0.1, 1.0])
    assert sweep.values("precision") is sweep.precision
    assert sweep.values("recall") is sweep.recall
    occsim.nsga2_front(sweep, pop_size=4, n_gen=1, seed=0, elitism="controlled")
    assert StudySettings(rule="prior_once", region="all") == StudySettings(
        rule=UpdateRule.PRIOR_ONCE, region=Region.ALL
    )
    assert published_maximum("precision", 3, "a").percent == 98.49
    colours = OutcomeColours(
        free="#ffffff",
        hit="#000000",
        false_wall="#ff0000",
        missed_wall="#0000ff",
        unseen="#cccccc",
        hatch="#999999",
    )
    before = fuse(LOG, PRIOR_MAP, n_readings=0)
    unseen = outcome_picture(before, WALL, colours, "explored")
    everywhere = outcome_picture(before, WALL, colours, "all")
    assert not np.array_equal(unseen, everywhere)


# A good call of every public function.
WORLD = World(np.array([[True, False, False, False]] * 4))
SWEEP = sweep_priors(LOG, WALL, WALL, [0.1, 1.0], [0.1, 1.0])
SURFACE = occsim.prior_surface(LOG, WALL, WALL)
FRONT = exact_front(LOG, WALL, WALL)
MAP = fuse(LOG, PRIOR_MAP)
CURVES = scores_by_reading(LOG, PRIOR_MAP, WALL, bits=True)
ASKED = {
    "world": WORLD,
    "trajectory": Trajectory([[2.5, 2.5, 0.0]]),
    "sensor": Sensor(),
    "grid": WORLD.grid(2),
}
HERE = occsim.Registration()
SCANS = occsim.simulate_scans(WORLD, ASKED["trajectory"], Sensor(), 3)
CELLS = {"evidence": LOG, "is_wall": WALL, "truth": WALL}
CHOICES = {"rule": UpdateRule.PRIOR_ONCE, "region": Region.ALL}
BOX = {"low": 0.1, "high": 1.0}
SEARCH = {"objective": SURFACE, "pop_size": 4, "n_gen": 1, "seed": 0, **BOX}
SEARCH |= {"elitism": Elitism.FULL, "pareto_fraction": 0.35}
GOOD = {
    "best_log_loss_pair": {**CELLS, **CHOICES},
    "loss_surface": {**CELLS, **CHOICES, "is_unknown": NO_WALL},
    "log_loss": {"occupancy_map": MAP, "truth": WALL, "region": Region.ALL},
    "brier": {"occupancy_map": MAP, "truth": WALL, "region": Region.ALL},
    "reliability": {
        "occupancy_map": MAP,
        "truth": WALL,
        "region": Region.ALL,
        "n_bins": 5,
    },
    "calibrated_prior": {"is_wall": WALL, "truth": WALL},
    "estimated_prior": {"others": [(WALL, WALL)]},
    "agreement": {
        "walls": WALL,
        "evidence": LOG,
        "registration": HERE,
        "prior": Prior(),
    },
    "held_out_bits": {
        "evidence": LOG,
        "prior_map": PRIOR_MAP,
        "rule": CHOICES["rule"],
        "n_folds": 2,
    },
    "refine_registration": {
        "walls": WALL,
        "evidence": LOG,
        "start": HERE,
        "prior": Prior(),
        "reach_px": 2.0,
    },
    "register_by_points": {
        "drawing_points": [[0, 0], [1, 0]],
        "log_points": [[0, 0], [1, 0]],
    },
    "registered_walls": {"walls": WALL, "registration": HERE, "grid": GRID},
    "build_prior": {
        "wall_mask": WALL,
        "grid": GRID,
        "prior": Prior(),
        "wall_share": 0.0,
        "unknown": NO_WALL,
    },
    "collect_evidence": ASKED,
    "collect_totals": ASKED,
    "beam_distances": {**ASKED, "n_beams": [2, 3]},
    "stream_evidence": ASKED,
    "coverage": {"occupancy_map": MAP},
    "dominates": {"better": [0.5, 0.5], "worse": [0.5, 0.4]},
    "evidence_from_scans": {
        "scan_log": SCANS,
        "sensor": Sensor(),
        "grid": WORLD.grid(2),
    },
    "exact_front": {**CELLS, **CHOICES, **BOX, "scale": 0.9},
    "exact_objective": {**CELLS, **CHOICES, "scale": 0.9},
    "flawed_mask": {"mask": WALL, "flaws": occsim.DrawingFlaws(thickness_px=1)},
    "fuse": {
        "evidence": LOG,
        "prior_map": PRIOR_MAP,
        "rule": CHOICES["rule"],
        "n_readings": 1,
    },
    "good_region": {"sweeps": [SWEEP], "fronts": [FRONT], "tolerance": 0.1},
    "hits_visits": {"scan_log": SCANS, "sensor": Sensor(), "grid": WORLD.grid(2)},
    "hypervolume": {"precision": [0.5], "recall": [0.5], "ref": (5.0, 5.0)},
    "interpolate": {
        "sweep": SWEEP,
        "p_wall": 0.5,
        "p_space": [0.5],
        "objective": occsim.Objective.RECALL,
    },
    "interpolated_objective": {"sweep": SWEEP},
    "logit": {"p_free": 0.5},
    "maxima": {"sweep": SWEEP, "objective": occsim.Objective.RECALL},
    "mean_entropy_bits": {"occupancy_map": MAP},
    "near_front": {"sweep": SWEEP, "front": FRONT, "tolerance": 0.1},
    "non_dominated": {"precision": [0.5], "recall": [0.5]},
    "nsga2_front": SEARCH,
    "nsga2_generations": {**SEARCH, "ref": (5.0, 5.0)},
    "one_reading": {
        **{name: ASKED[name] for name in ("world", "sensor", "grid")},
        "pose": (0.5, 0.5, 0.0),
    },
    "p_free_from_log_odds": {"log_odds": [0.5]},
    "prior_drawing": {"building": occsim.load_sample("c"), "which": "d"},
    "prior_surface": {**CELLS, **CHOICES, "scale": 0.9, "is_unknown": NO_WALL},
    "recommend": {"front": FRONT, "min_recall": 0.4},
    "rectangles_at": {"surface": SURFACE, "p_wall": 0.5, "p_space": 0.5, **BOX},
    "reference_point": {"front": FRONT, "margin": 0.1},
    "score": {"occupancy_map": MAP, "truth": WALL, "region": Region.ALL},
    "scores_by_reading": {
        "evidence": LOG,
        "prior_map": PRIOR_MAP,
        "truth": WALL,
        **CHOICES,
        "bits": True,
    },
    "worth_in_readings": {
        "drawing": CURVES,
        "blank": CURVES,
        "n_readings": 1,
        "measure": occsim.Measure.F2,
    },
    "simulate_scans": {
        **{name: ASKED[name] for name in ("world", "trajectory", "sensor")},
        "n_beams": 3,
        "noise": occsim.ScanNoise(metres_per_px=0.05),
        "rng": np.random.default_rng(0),
    },
    "set_c": {"front": FRONT, "min_recall": 0.4},
    "surface_front": {"surface": SURFACE, **BOX},
    "sweep_priors": {
        **CELLS,
        "p_wall": [0.5],
        "p_space": [0.5],
        **CHOICES,
        "scale": 0.9,
    },
    "truth_cells": {"world": WORLD, "grid": WORLD.grid(2), "wall_share": 0.0},
    "unknown_cells": {"unknown": NO_WALL, "is_wall": WALL, "grid": GRID},
    "default_tour": {"world": WORLD, "sensor": Sensor(), "max_readings": 4},
    "detect_walls": {
        "drawing": Drawing(np.zeros((9, 9, 3), np.uint8)),
        "params": occsim.WallParams(),
    },
    "dump_trajectory": {
        "trajectory": ASKED["trajectory"],
        "file_format": "csv",
        "degrees": False,
    },
    "lens_world": {},
    "load_drawing": {
        "source": b"",
        "name": "plan",
        "max_side_px": 100,
        "keep_dark": False,
        "allow_robot_map": False,
    },
    "load_trajectory": {
        "source": b"0 0 0",
        "name": "tour.txt",
        "degrees": True,
        "frame": None,
    },
    "load_sample": {"name": "a"},
    "resample": {
        "waypoints_px": [(0, 0), (1, 1)],
        "step_px": 1.0,
        "heading_mode": "along",
        "turn_at_waypoints": False,
    },
    "sample_names": {},
}

# Arguments of a fixed type: any other type is a TypeError, whatever its value.
WHOLE = {"world", "trajectory", "sensor", "grid", "prior", "prior_map", "evidence"}
WHOLE |= {"occupancy_map", "sweep", "surface", "front", "sweeps", "fronts"}
WHOLE |= {"is_wall", "truth", "wall_mask", "mask", "flaws", "building"}
WHOLE |= {"blank", "scan_log", "walls", "registration", "start"}
STRANGE = {
    "nothing": None,
    "a number": 3,
    "a share": 0.5,
    "NaN": float("nan"),
    "a huge number": 10**400,
    "text": "text",
    "bytes": b"\x00",
    "a list": [1, 2],
    "an uneven list": [[1], [2, 3]],
    "a dictionary": {},
    "an object": object(),
    "a type": Grid,
    "a grey image": np.full((1, 2), 255, np.uint8),
    "a complex number": 1j,
}
PUBLIC = [(name, getattr(occsim, name)) for name in occsim.__all__]
FUNCTIONS = {n: f for n, f in PUBLIC if callable(f) and not inspect.isclass(f)}
# Functions that do not keep the promise yet.
NOT_YET = {
    "default_tour",
    "detect_walls",
    "dump_trajectory",
    "load_drawing",
    "load_sample",
    "load_trajectory",
    "resample",
}
HOME = str(Path(occsim.__file__).parent)


def test_the_table_names_every_public_function_and_every_argument():
    assert set(GOOD) == set(FUNCTIONS)
    for name, function in FUNCTIONS.items():
        known = set(inspect.signature(function).parameters)
        assert known - set(GOOD[name]) <= {"on_progress"}, name


@pytest.mark.parametrize("name", sorted(set(FUNCTIONS) - {"load_drawing"}))
def test_the_call_of_the_table_is_good(name):
    FUNCTIONS[name](**GOOD[name])


@pytest.mark.parametrize(
    ("name", "argument"),
    [(name, arg) for name in FUNCTIONS if name not in NOT_YET for arg in GOOD[name]],
)
def test_what_is_wrong_gets_one_sentence_of_the_library(name, argument):
    for what, value in STRANGE.items():
        try:
            FUNCTIONS[name](**{**GOOD[name], argument: value})
        except (OccsimError, TypeError) as raised:
            error = raised
        else:
            # Some of these values are valid: a number for a share, text for a choice,
            # no parts.
            assert argument not in WHOLE or value == {}, what
            continue
        # Not an error raised inside numpy.
        assert traceback.extract_tb(error.__traceback__)[-1].filename.startswith(HOME)
        assert "\n" not in str(error)
        assert 10 < len(str(error)) < 250
        assert argument not in WHOLE or isinstance(error, TypeError), what
