from dataclasses import fields, replace
from enum import Enum

import pytest
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from occsim import BehindHit, Region, UpdateRule
from occsim.priors import Elitism
from pages._ui.choices import (
    CHOICES,
    CellModel,
    Drawings,
    Exploring,
    Fineness,
    Flaw,
    FrontAxes,
    Handover,
    Laps,
    Objectives,
    Overlay,
    Picture,
    PriorDrawing,
    Surface,
)
from pages._ui.columns import Column
from pages._ui.settings import TABLE, Settings, decode, encode, with_changes


def bounded(name):
    """Any value that a numeric setting allows."""
    low, high = TABLE[name].low, TABLE[name].high
    if isinstance(getattr(Settings(), name), int):
        return st.integers(int(low), int(high))
    return st.floats(low, high)


ANY_COLUMN = st.builds(
    Column,
    prior_drawing=st.sampled_from(PriorDrawing),
    flaw=st.sampled_from(Flaw),
    **{name: bounded(name) for name in ("p_wall", "p_space", "cell_px")},
    calibrated=st.booleans(),
    uninformative=st.booleans(),
    rule=st.sampled_from(UpdateRule),
    behind_hit=st.sampled_from(BehindHit),
    model=st.sampled_from(CellModel),
    laps=st.sampled_from(Laps),
)
ANY_SETTINGS = st.builds(
    Settings,
    **{name: bounded(name) for name in ("cell_px", "range_px", "fov_deg")},
    **{name: bounded(name) for name in ("wall_share", "truth_share")},
    **{name: bounded(name) for name in ("p_wall", "p_space")},
    **{name: bounded(name) for name in ("thickness_px", "shift_x_px", "shift_y_px")},
    **{name: bounded(name) for name in ("rotation_deg", "drawing_scale")},
    **{name: bounded(name) for name in ("missing_share", "false_share", "flaw_seed")},
    prior_drawing=st.sampled_from(PriorDrawing),
    behind_hit=st.sampled_from(BehindHit),
    clear_no_hit=st.booleans(),
    uninformative=st.booleans(),
    rule=st.sampled_from(UpdateRule),
    study_rule=st.sampled_from(UpdateRule),
    region=st.sampled_from(Region),
    overlay=st.sampled_from(Overlay),
    columns=st.lists(ANY_COLUMN, min_size=2, max_size=3).map(tuple),
    surface=st.sampled_from(Surface),
    fineness=st.sampled_from(Fineness),
    drawings=st.sampled_from(Drawings),
    picture=st.sampled_from(Picture),
    exploring=st.sampled_from(Exploring),
    axes=st.sampled_from(FrontAxes),
    handover=st.sampled_from(Handover),
    objectives=st.sampled_from(Objectives),
    elitism=st.sampled_from(Elitism),
    **{name: bounded(name) for name in ("log_cell_m", "usable_range_m")},
    **{name: bounded(name) for name in ("beams", "noise_seed", "odometry_drift")},
    **{name: bounded(name) for name in ("sigma_0_m", "sigma_2_per_m", "sigma_from_m")},
    **{name: bounded(name) for name in ("dropout_share", "short_share")},
    **{name: bounded(name) for name in ("glass_share", "position_sigma_m")},
    heading_sigma_deg=bounded("heading_sigma_deg"),
    log_max_range_m=bounded("log_max_range_m"),
    log_behind_hit=st.sampled_from(BehindHit),
    log_clear_no_hit=st.booleans(),
    **{name: bounded(name) for name in ("min_recall", "tolerance")},
    **{name: bounded(name) for name in ("pop_size", "n_gen", "seed")},
)


# So many fields take long to draw on a busy machine.
@hypothesis_settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(ANY_SETTINGS)
def test_settings_survive_the_round_trip_through_a_link(settings):
    assert decode(encode(settings)) == (settings, [])


@given(st.dictionaries(st.sampled_from([*TABLE, "other"]), st.text()))
def test_a_damaged_link_gives_valid_settings(query):
    settings, _ = decode(query)
    assert decode(encode(settings)) == (settings, [])


def test_defaults_need_no_link():
    assert encode(Settings()) == {}


@pytest.mark.parametrize(
    ("name", "value"), [("cell_px", 0), ("fov_deg", 361), ("p_wall", 1.4)]
)
def test_a_value_out_of_bounds_is_refused_with_a_reason(name, value):
    with pytest.raises(ValueError, match=rf"{name} must lie in .*; got {value}"):
        with_changes(Settings(), {name: value})


def test_every_setting_is_declared_and_every_choice_has_words():
    assert set(TABLE) == {field.name for field in fields(Settings)}
    defaults = [getattr(Settings(), field.name) for field in fields(Settings)]
    for kind in {type(value) for value in defaults if isinstance(value, Enum)}:
        assert set(kind) <= set(CHOICES)


def test_the_wrong_values_of_a_link_are_named():
    query = {"cell_px": "abc", "p_wall": "9", "p_space": "0.5", "utm": "x"}
    assert decode(query) == (Settings(p_space=0.5), ["cell_px", "p_wall"])


def test_a_link_says_what_differs_from_the_drawing_and_nothing_else():
    """A range of 40 px differs where the doors are 20 px long."""
    of_drawing = Settings(range_px=20)
    assert encode(Settings(range_px=40), of_drawing) == {"range_px": "40"}
    assert encode(Settings(range_px=20), of_drawing) == {}
    assert decode({}, of_drawing) == (of_drawing, [])


def test_the_opening_of_two_maps_needs_no_link_and_a_change_a_short_one():
    """Only what departs from a default map is said: here B's rule and cell size."""
    first, second = Settings().columns
    changed = with_changes(Settings(), {"columns": (first, replace(second, cell_px=1))})
    assert encode(changed) == {"columns": "--rsubtract_prior-z1"}


@pytest.mark.parametrize(
    "text", ["", "------", "w0.3", "--x1", "--w7", "--rnever", "--z0.5", "--c2"]
)
def test_a_link_with_wrong_columns_opens_with_the_default_ones(text):
    assert decode({"columns": text}) == (Settings(), ["columns"])
