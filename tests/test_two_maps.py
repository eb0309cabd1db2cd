"""The page of two maps: its opening, and what it takes from the player and a link."""

import pytest

from occsim import UpdateRule
from occsim.io.replay import unpack_log, unpack_walls
from pages._ui import compute, replays, state
from pages._ui.choices import Flaw, PriorDrawing
from pages._ui.columns import FLAWS, OPENING_COLUMNS, Column
from pages._ui.components.player import PlayerDocument, encode_document
from pages._ui.examples import examples
from pages._ui.settings import Settings
from tests.test_pages import BUILD, said
from tests.test_session import opened

TWO_MAPS = "pages/3_Two_maps.py"


def played(app, key=state.TWO_MAPS_KEY):
    return app.session_state["played"][key]


def commit(app, **changes):
    """What the browser sends: the current document with changes."""
    document = encode_document(played(app))
    app.session_state[state.TWO_MAPS_KEY] = {"committed": document | changes}
    return app.run()


def columns_json(*columns):
    return encode_document(PlayerDocument(columns=columns))["columns"]


# --- Opening --------------------------------------------------------------------------


def test_it_opens_on_c_at_the_first_reading_with_both_rules():
    app = opened(TWO_MAPS)
    assert app.session_state["choice"] == "c"
    assert played(app).step == 0
    assert played(app).columns == OPENING_COLUMNS
    assert [column.rule for column in OPENING_COLUMNS] == list(UpdateRule)


def test_an_untouched_session_shows_each_page_with_its_own_opening():
    app = opened(BUILD)
    assert app.session_state["choice"] == state.OPENING
    app.switch_page(TWO_MAPS).run()
    assert app.session_state["choice"] == "c"
    assert app.session_state["settings"].range_px == 20
    app.switch_page(BUILD).run()
    assert app.session_state["choice"] == state.OPENING
    assert played(app, state.PLAYER_KEY).step > 0


@pytest.mark.parametrize("query", [{"drawing": "a"}, {"p_wall": "0.3"}])
def test_what_a_student_chose_is_kept_on_the_way_to_this_page(query):
    app = opened(BUILD, **query)
    before = app.session_state["choice"]
    app.switch_page(TWO_MAPS).run()
    assert app.session_state["choice"] == before


def test_a_link_brings_back_the_maps_and_the_step():
    app = opened(TWO_MAPS, columns="--dmirrored-z5--u1", step="17")
    first, second, third = played(app).columns
    assert first == Column()
    assert second == Column(prior_drawing=PriorDrawing.MIRRORED, cell_px=5)
    assert third == Column(uninformative=True)
    assert played(app).step == 17


# --- Choices in the player ------------------------------------------------------------


def test_a_choice_in_a_header_is_kept_in_the_settings_and_in_the_link():
    app = opened(TWO_MAPS)
    thin = Column(flaw=Flaw.THIN_2, p_wall=0.35)
    commit(app, columns=columns_json(Column(), thin), step=33)
    assert not app.exception
    assert app.session_state["settings"].columns == (Column(), thin)
    assert played(app).step == 33
    app.switch_page(BUILD).run()
    app.switch_page(TWO_MAPS).run()
    assert played(app).columns == (Column(), thin)
    assert played(app).step == 33
    # The page of one map has its own rule and prior.
    assert app.session_state["settings"].p_wall == Settings().p_wall


def test_a_drawing_that_does_not_fit_another_building_becomes_its_own():
    app = opened(TWO_MAPS, columns="--dd")
    assert played(app).columns[1].prior_drawing is PriorDrawing.D
    select = next(one for one in app.selectbox if one.label == "Drawing")
    select.set_value("a").run()
    assert played(app).columns == (Column(), Column())
    assert app.session_state["settings"].columns == (Column(), Column())


def test_reset_brings_back_the_opening():
    app = opened(TWO_MAPS)
    commit(app, columns=columns_json(Column(), Column(cell_px=5)), step=33)
    next(one for one in app.button if one.label == "Reset all").click().run()
    assert app.session_state["settings"].columns == OPENING_COLUMNS
    assert played(app).step == 0


def test_maps_that_ask_for_too_much_are_refused_and_the_opening_is_shown():
    query = {"range_px": "300", "fov_deg": "360", "columns": "--z1"}
    app = opened(TWO_MAPS, **query)
    assert "choose larger cells" in said(app.error)[0]
    assert app.session_state["settings"].columns == OPENING_COLUMNS


# --- Parts of a replay ----------------------------------------------------------------


def parts_of(settings, columns, name="c"):
    replay = replays.replay_of(compute.sample(name), settings, columns)
    return {(part.kind, part.name): part for part in replay.parts}


def test_maps_share_the_readings_and_the_walls_that_they_have_in_common():
    settings = Settings(range_px=20)
    columns = (Column(), Column(rule=UpdateRule.SUBTRACT_PRIOR), Column(cell_px=5))
    parts = parts_of(settings, columns)
    assert set(parts) == {
        ("scene", ""),
        ("log", "occupied 3"),
        ("walls", "own found 3"),
        ("log", "occupied 5"),
        ("walls", "own found 5"),
    }


@pytest.mark.parametrize("flaw", Flaw)
def test_each_map_gets_the_walls_of_its_drawing_with_its_errors(flaw):
    building = compute.sample("c")
    column = Column(prior_drawing=PriorDrawing.D, flaw=flaw)
    parts = parts_of(Settings(range_px=20), [column])
    mask = compute.drawn_mask(building, (PriorDrawing.D, FLAWS[flaw]))
    run = compute.mapped(building, Settings(range_px=20).mapping_of(column))
    expected = run.with_prior_mask(mask).wall_cells
    walls, _ = unpack_walls(parts["walls", f"d {flaw.value} 3"].data)
    assert (walls == expected).all()
    log, truth = unpack_log(parts["log", "occupied 3"].data)
    assert log.cell.size == run.evidence.cell.size
    assert (truth == run.truth_cells).all()


def test_a_drawing_of_another_size_is_replaced_by_the_buildings_own():
    own, other = (
        parts_of(Settings(), [Column(prior_drawing=one)], "a")
        for one in (PriorDrawing.OWN, PriorDrawing.D)
    )
    assert other["walls", "d found 3"].data == own["walls", "own found 3"].data


# --- Examples -------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["a", "c", "e"])
def test_every_example_can_be_shown_on_every_drawing(name):
    building = compute.sample(name)
    drawings = tuple(compute.prior_drawings(building))
    for _, columns in examples(drawings):
        assert 2 <= len(columns) <= 3
        assert len(set(columns)) == len(columns)
        assert {column.prior_drawing for column in columns} <= set(drawings)


def test_the_wrong_drawing_is_the_mirror_image_where_no_other_has_the_size():
    few = (PriorDrawing.OWN, PriorDrawing.MIRRORED, PriorDrawing.EMPTY)
    [wrong] = [two[1] for label, two in examples(few) if label.startswith("Right")]
    assert wrong.prior_drawing is PriorDrawing.MIRRORED
