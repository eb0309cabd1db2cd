"""State of a session: links, defaults, undo, late events, reloads, failures."""

import io
import re
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from urllib.parse import urlencode

import numpy as np
import pytest
from PIL import Image
from streamlit.testing.v1 import AppTest

from occsim import BehindHit, Corrections, UpdateRule, load_sample
from occsim.building import Building
from occsim.imaging import Drawing
from pages._ui import compute, state, words
from pages._ui.choices import Flaw, Overlay, PriorDrawing
from pages._ui.columns import Column
from pages._ui.compute import with_walls
from pages._ui.qr import qr_svg
from pages._ui.settings import Settings
from pages._ui.shared import Store, shared, size_of
from pages._ui.state import chosen, edits, replay, robots, works
from pages._ui.state.packed import Packed
from pages._ui.state.works import Work, Works
from tests.test_pages import BUILD, ROOT, control, launch, png, rooms, said, upload

YOURS = "pages/2_Your_building.py"


def opened(page=BUILD, **query):
    """A page as a link opens it, in a session of its own."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    for name, text in query.items():
        app.query_params[name] = text
    app.switch_page(page).run()
    assert not app.exception
    return app


@pytest.fixture
def session(monkeypatch):
    """The state of one student without pages: a plain mapping in Streamlit's place."""

    class Kept(dict):
        __getattr__ = dict.__getitem__
        __setattr__ = dict.__setitem__

    class Streamlit:
        session_state = Kept()
        query_params = type("Query", (), {"to_dict": lambda self: {}})()

    more = state.lens, state.replay, state.widgets, state.pairs
    more = *more, state.held, state.opening, state.classes, robots
    for module in (chosen, edits, *more):
        monkeypatch.setattr(module, "st", Streamlit)
    monkeypatch.setattr(
        chosen.compute,
        "sample",
        lambda name: SAMPLES.setdefault(name, with_walls(load_sample(name))),
    )
    state.prepare(BUILD)
    return Streamlit.session_state


def test_only_a_link_to_the_lens_speaks_of_it(session):
    state.prepare(state.LENS_PATH)
    session.lens_chosen = replace(session.lens_chosen, p_free=0.4)
    assert state.query()["lens_prior"] == "0.4"
    state.prepare(BUILD)
    assert "lens_prior" not in state.query()
    state.prepare(state.LENS_PATH)
    assert state.query()["lens_prior"] == "0.4"


def test_a_commit_of_the_lens_counts_before_its_page_is_drawn(session):
    state.prepare(state.LENS_PATH)
    rev = state.lens_document().rev
    session.lens = {"committed": {"rev": rev, "pose": "8.5_28.5_0"}}
    assert state.take_from_lens().y_px == 28.5
    session.lens = {"committed": {"rev": rev - 1, "pose": "8.5_4.5_0"}}
    assert state.take_from_lens().y_px == 10.5


SAMPLES = {}


def with_title(text):
    return lambda: state.edit_building(title=text)


# --- Undo -----------------------------------------------------------------------------


def test_edits_with_one_tag_that_follow_each_other_are_one_step(session):
    state.edit(with_title("one"), tag="board")
    state.edit(with_title("two"), tag="board")
    state.undo()
    assert (session.choice, session.own) == (state.OPENING, None)
    state.redo()
    assert state.building().title == "two"


def test_a_stroke_on_another_drawing_is_a_step_of_its_own(session):
    """Stroke on b, choose a, stroke, undo: the correction of b is still there."""
    state.edit(with_title("b corrected"), tag="board")
    state.choose("a")
    state.edit(with_title("a corrected"), tag="board")
    state.undo()
    assert session.choice == "a"
    assert session.own.title == "b corrected"
    state.undo()
    assert (session.choice, session.own) == (state.OPENING, None)


def test_what_follows_an_undo_is_not_merged_with_what_came_before(session):
    """Stroke, discard, undo, stroke, undo: the first stroke is still there."""
    state.edit(with_title("stroke"), tag="board")
    state.edit(with_title("discarded"))
    state.undo()
    state.edit(with_title("second stroke"), tag="board")
    state.undo()
    assert state.building().title == "stroke"


def test_undo_of_a_measured_door_takes_the_range_back_as_well(session):
    def measured():
        state.edit_building(door_px=77.0, metres_per_px=0.01)
        state.set_range_to_door()

    before = state.settings().range_px
    state.edit(measured, tag="door")
    assert state.settings().range_px == 77
    state.undo()
    assert state.settings().range_px == before
    state.redo()
    assert state.settings().range_px == 77


def test_undo_leaves_settings_that_the_edit_did_not_change(session):
    state.edit(with_title("one"))
    state.change(range_px=123, cell_px=7)
    state.undo()
    assert (state.settings().range_px, state.settings().cell_px) == (123, 7)


def test_more_undos_than_edits_do_nothing(session):
    state.edit(with_title("one"))
    for _ in range(3):
        state.undo()
    assert session.own is None
    for _ in range(3):
        state.redo()
    assert session.own.title == "one"


def test_a_failed_edit_changes_nothing_and_says_one_sentence(session):
    def fails():
        state.edit_building(title="half done")
        load_sample("z")

    state.edit(fails)
    assert session.own is None
    assert "got 'z'" in state.message()
    assert not state.can_undo()


@pytest.mark.provokes_errors
def test_an_edit_that_fails_by_a_fault_of_ours_changes_nothing(
    session, pages_log_no_error
):
    def fails():
        state.edit_building(title="half done")
        raise ZeroDivisionError

    state.edit(fails)
    assert session.own is None
    assert state.message() == edits.UNEXPECTED
    assert pages_log_no_error


def test_the_history_is_bounded_in_steps_and_in_bytes(session, monkeypatch):
    for i in range(edits.MAX_PAST + 5):
        state.edit(with_title(str(i)))
    assert len(session.past) == edits.MAX_PAST
    monkeypatch.setattr(edits, "MAX_PAST_BYTES", 1)
    state.edit(with_title("last"))
    assert len(session.past) == 1


def test_the_history_of_ten_drawings_takes_little_and_gives_each_back(session):
    """Unpacked, one drawing of 600 x 900 px with a mask takes 2.2 MB."""
    poses = load_sample("a").trajectory
    buildings = [
        Building(
            drawing=Drawing(rgb=np.stack([rooms(600, 900 + i)] * 3, axis=2)),
            found=rooms(600, 900 + i) == 0,
            trajectory=poses,
        )
        for i in range(10)
    ]
    for own in buildings:
        state.edit(partial(state.open_own, own))
    assert size_of(session.past) < 3_000_000
    for own in reversed(buildings[5:9]):
        state.undo()
        assert session.own.digest == own.digest
        assert session.own is not own
    for own in buildings[6:]:
        state.redo()
        assert session.own.digest == own.digest


def test_the_history_holds_nothing_that_was_computed(session):
    state.edit(with_title("one"))
    assert state.building().digest
    state.edit(with_title("two"))
    assert "digest" not in vars(session.past[-1].before.own)


def test_an_edit_that_was_cut_short_is_done_in_the_next_run(session):
    """Streamlit stops a script by an exception that is no `Exception`."""

    class Stopped(BaseException):
        pass

    times = []

    def action():
        state.edit_building(title="half")
        times.append(len(times))
        if len(times) == 1:
            raise Stopped
        state.edit_building(title="whole", about="told")

    with pytest.raises(Stopped):
        state.edit(action)
    state.finish()
    state.finish()
    assert (session.own.title, times) == ("whole", [0, 1])
    state.undo()
    assert (session.choice, session.own) == (state.OPENING, None)


def test_the_section_of_your_building_is_in_its_link_only(session):
    session.views = {"section": "3 Walls"}
    assert "section" not in state.query()
    session.path = state.YOUR_BUILDING
    assert state.query()["section"] == "3"
    session.views = {"section": "1 Drawing"}
    assert "section" not in state.query()


@pytest.mark.parametrize(("number", "shown"), [("6", "6 Trajectory"), ("9", None)])
def test_a_link_opens_its_section(number, shown):
    app = opened(YOURS, section=number)
    assert app.session_state["view_section"] == (shown or "1 Drawing")


# --- Defaults and links ---------------------------------------------------------------


def test_every_drawing_opens_with_the_length_of_its_doors_as_range(session):
    for name in ("a", "d"):
        state.choose(name)
        assert state.settings().range_px == round(load_sample(name).sensor.range_px)


def test_choosing_a_drawing_after_a_link_takes_the_drawings_own_range():
    app = opened(drawing="b", range_px="60")
    assert app.session_state["settings"].range_px == 60
    app.selectbox(key=control(app, "choice")).select("d").run()
    assert app.session_state["settings"].range_px == 20
    next(button for button in app.button if button.label == "Reset all").click().run()
    assert app.session_state["settings"].range_px == 20


def test_a_link_says_a_range_that_is_not_the_drawings_own(session):
    state.choose("d")
    assert "range_px" not in state.query()
    state.change(range_px=40)
    assert state.query()["range_px"] == "40"
    state.choose("b")
    assert "range_px" not in state.query()


def test_a_link_brings_back_settings_step_pin_and_speed():
    app = opened(drawing="c", p_wall="0.35", step="17", pin="30.5,40.5", speed="60")
    played = app.session_state["played"][state.PLAYER_KEY]
    assert (played.step, played.pin_px, played.speed) == (17, (30.5, 40.5), 60)
    assert app.session_state["settings"].p_wall == 0.35


def test_a_link_with_three_maps_is_short_enough_for_a_projector_s_code(session):
    """A code of under 300 characters has at most 69 modules a side with its border."""
    session.path = replay.TWO_MAPS_PATH
    state.choose("c")
    other = Column(
        prior_drawing=PriorDrawing.MIRRORED,
        flaw=Flaw.THICK_2,
        p_wall=0.35,
        p_space=0.85,
        rule=UpdateRule.SUBTRACT_PRIOR,
        behind_hit=BehindHit.UNSEEN,
        cell_px=5,
    )
    state.change(columns=(Column(), other, replace(other, calibrated=True)))
    state.change(range_px=75, fov_deg=360, overlay=Overlay.ERRORS)
    session.exercise = "smaller_cells_or_more_readings"
    key = replay.TWO_MAPS_KEY
    session.played[key] = replace(
        session.played[key], step=321, pin_px=(412.5, 388.5), speed=60
    )
    query = state.query()
    assert {"step", "pin", "columns", "exercise", "speed"} <= query.keys()
    link = f"http://192.168.100.100:8501/Two_maps?{urlencode(query)}"
    assert len(link) < 300
    assert int(re.search(r"0 0 (\d+)", qr_svg(link))[1]) <= 69


@pytest.mark.parametrize("place", [{"step": "x"}, {"pin": "1"}, {"speed": "7"}])
def test_a_damaged_place_in_a_link_opens_half_way(place):
    app = opened(drawing="c", **place)
    played = app.session_state["played"][state.PLAYER_KEY]
    assert played.step == len(load_sample("c").trajectory) // 2
    assert (played.pin_px, played.speed) == (None, None)


def test_reset_returns_to_what_the_drawing_opens_with(session):
    state.choose("d")
    state.change(range_px=99, p_wall=0.5)
    state.reset_all()
    assert state.settings() == Settings(range_px=20)


def test_a_late_event_of_a_widget_does_not_undo_a_reset(session):
    """The browser sends all of its old values with the first slider that is moved."""
    bound = state.bind("p_wall")
    state.reset_all()
    session[bound["key"]] = 0.77
    bound["on_change"](*bound["args"])
    assert state.settings().p_wall == 0.2
    fresh = state.bind("p_wall")
    session[fresh["key"]] = 0.77
    fresh["on_change"](*fresh["args"])
    assert state.settings().p_wall == 0.77


def test_the_choice_of_a_building_that_was_undone_is_ignored(session):
    state.edit(with_title("mine"))
    bound = state.bind_choice()
    state.undo()
    session[bound["key"]] = state.OWN
    bound["on_change"](*bound["args"])
    state.choose(state.OWN)
    assert session.choice == state.OPENING
    assert state.building() is not None


# --- Buildings of one's own over a reload ---------------------------------------------


def test_a_reload_finds_the_building_and_the_settings_again():
    app = upload(launch(YOURS), "Drawing", "mine.png", png(rooms()))
    assert app.session_state["choice"] == state.OWN
    key, _ = app.session_state["work"]
    again = opened(YOURS, work=key, cell_px="5")
    assert again.session_state["choice"] == state.OWN
    assert again.session_state["own"].digest == app.session_state["own"].digest
    assert again.session_state["settings"].cell_px == 5
    assert not again.warning


def test_a_reload_keeps_a_building_while_a_sample_is_shown():
    app = upload(launch(YOURS), "Drawing", "mine.png", png(rooms()))
    key, _ = app.session_state["work"]
    again = opened(YOURS, work=key, drawing="a")
    assert again.session_state["choice"] == "a"
    assert again.session_state["own"].digest == app.session_state["own"].digest
    # Nothing was changed, so nothing more is kept.
    assert again.session_state["work"][0] == key


def test_undo_of_opening_a_project_brings_the_settings_back(session):
    before = state.settings()
    project = with_walls(load_sample("d"))
    state.edit(lambda: state.open_project(project, {"cell_px": "7", "p_wall": "0.5"}))
    assert (state.settings().cell_px, state.settings().p_wall) == (7, 0.5)
    state.undo()
    assert state.settings() == before


def test_strokes_that_were_taken_back_on_the_board_leave_no_step(session):
    mine = with_walls(load_sample("d"))
    state.set_own(mine)
    nothing = mine.corrections
    dot = np.zeros(mine.drawing.shape, dtype=bool)
    dot[5, 5] = True
    stroke = Corrections.from_masks(dot, np.zeros_like(dot))
    for corrections in (stroke, nothing):
        state.edit(partial(state.edit_building, corrections=corrections), tag="board")
    assert not state.can_undo()


def test_a_link_to_a_building_that_is_gone_says_so_and_keeps_the_settings():
    app = opened(work="nobody-has-this-key", cell_px="7")
    assert said(app.warning) == [chosen.GONE]
    assert app.session_state["settings"].cell_px == 7
    assert app.session_state["choice"] == state.OPENING


def test_a_session_from_a_link_edits_a_copy(session):
    state.edit(with_title("hers"))
    key = state.work_key()
    assert works.WORKS.find(key).building.title == "hers"
    # Another session from the same link, then an edit there.
    session.own, session.work = works.WORKS.find(key).building, None
    state.edit(with_title("his"))
    other = state.work_key()
    assert other != key
    assert works.WORKS.find(key).building.title == "hers"


def test_a_building_that_is_too_large_is_not_kept():
    mine = replace(load_sample("d"))
    assert Works(max_bytes=1000).keep(Work(mine)) is None


def test_the_store_forgets_the_oldest_when_it_is_full():
    mine = replace(load_sample("d"))
    store = Works(max_bytes=int(2.5 * len(Packed.of(mine).data)))
    keys = [store.keep(Work(mine)) for _ in range(3)]
    assert store.find(keys[0]) is None
    assert store.find(keys[2]).building.digest == mine.digest


def test_a_kept_building_takes_a_small_part_of_its_size_and_comes_back_whole():
    mine = load_sample("d")
    store = Works()
    found = store.find(store.keep(Work(mine))).building
    assert found.digest == mine.digest
    assert found.title == mine.title
    assert store.n_bytes < size_of([mine]) / 10


def test_shared_parts_are_counted_once():
    assert size_of([b"abc", "de"]) == 5
    text = "x" * 1000
    assert size_of([text, [text], {"a": text}]) == 1000


# --- Results that all sessions share --------------------------------------------------


def test_a_result_is_made_once_for_all_who_ask_at_the_same_time():
    calls = []

    @shared()
    def slow(key, _unkeyed):
        calls.append(key)
        time.sleep(0.05)
        return b"result"

    with ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda i: slow("one", i), range(8)))
    assert results == [b"result"] * 8
    assert calls == ["one"]


def test_the_store_is_bounded_in_bytes_whatever_is_put_in():
    store = Store(max_bytes=1000)
    for i in range(50):
        assert len(store.get(i, lambda: bytes(300))) == 300
    assert store.n_bytes <= 1000
    assert len(store.get("large", lambda: bytes(5000))) == 5000
    assert store.n_bytes <= 1000


def test_results_that_share_an_array_count_it_once():
    store, array = Store(max_bytes=1000), bytes(600)
    for i in range(20):
        store.get(i, lambda: [array, bytes(10)])
    made = []
    for i in range(20):
        store.get(i, lambda: made.append(1))
    assert made == []


def test_what_grows_in_the_store_is_measured_anew():
    store = Store(max_bytes=1000)
    first = store.get(0, lambda: [bytes(100)])
    first.append(bytes(900))
    for i in range(1, 12):
        store.get(i, lambda: bytes(100))
    assert store.n_bytes <= 1000


def test_a_failure_is_not_kept_and_the_next_who_asks_tries_again():
    store = Store()

    def fails():
        raise ZeroDivisionError

    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            store.get("key", fails)
    assert store.get("key", lambda: 1) == 1


# --- Failures -------------------------------------------------------------------------


@pytest.mark.parametrize(
    "page", ["5_Sweep_the_priors", "6_Pareto_explorer", "7_Best_prior", "8_Study"]
)
def test_what_cannot_be_simulated_is_one_sentence_on_every_page(page):
    """A whole turn over 300 px at 1 px cells is more than a replay can hold."""
    app = opened(f"pages/{page}.py", cell_px="1", range_px="300", fov_deg="360")
    assert len(app.error) <= 1
    assert all("choose larger cells" in words for words in said(app.error))
    assert any(button.label == "Reset all" for button in app.button)


@pytest.mark.provokes_errors
def test_a_failure_of_ours_leaves_the_navigation_and_a_way_back(
    monkeypatch, pages_log_no_error
):
    def fails(*_):
        raise ZeroDivisionError

    app = launch(BUILD)
    monkeypatch.setattr("pages._ui.replays.replay", fails)
    app.run()
    assert not app.exception
    assert "an error in this program" in said(app.error)[0]
    assert any(button.label == "Reset all" for button in app.button)
    assert [text for text in pages_log_no_error if "1_Build_a_map" in text]


def test_words_of_a_user_are_plain_text():
    """Neither Markdown nor HTML of a file's name is rendered."""
    name = "![x](http://evil/x.png) <b>b</b> $x$ :red[r]"
    app = upload(launch(BUILD), "Drawing", f"{name}.png", b"no image")
    [error] = app.error
    assert not re.search(r"(?<!\\)[\[\]<>$:!]", error.value)


@pytest.mark.parametrize(
    "text", ["see https://evil.example", "www.evil.example", "a@b.c", ":material/home:"]
)
def test_addresses_and_icons_in_words_of_a_user_are_not_found(text):
    """Both are found in the text without its escapes: something must stand between."""
    shown = re.sub(r"\\(.)", r"\1", words.plain(text))
    assert text not in shown
    assert shown.replace("\u2060", "") == text


def test_a_title_of_one_student_is_not_in_what_all_share():
    app = upload(launch(BUILD), "Drawing", "secret name.png", png(rooms()))
    own = app.session_state["own"]
    assert "secret name" in own.title
    run = compute.mapped(own, app.session_state["settings"].mapping)
    assert "secret" not in run.building.title + run.building.drawing.name


# --- Uploads belong to the drawing they were made for ---------------------------------


def test_an_uploaded_trajectory_is_not_read_again_for_another_drawing():
    """Plan, trajectory, choose sample a, change the angle's unit: a stays a."""
    app = upload(launch(BUILD), "Drawing", "mine.png", png(rooms()))
    app = upload(app, "Trajectory", "way.csv", b"x,y,theta\n50,50,0\n60,50,1\n")
    app.selectbox(key=control(app, "choice")).select("a").run()
    app.radio(key="view_angle_unit").set_value("Degrees").run()
    assert app.session_state["choice"] == "a"
    assert not app.error


def test_the_page_of_a_pdf_is_asked_for_only_while_its_building_is_shown():
    pages = [Image.fromarray(rooms()).convert("RGB") for _ in range(3)]
    pdf = io.BytesIO()
    pages[0].save(pdf, "PDF", save_all=True, append_images=pages[1:])
    app = upload(
        launch(BUILD), "Drawing", "mine.pdf", pdf.getvalue(), "application/pdf"
    )
    assert app.number_input(key="view_pdf_page").max == 3
    app.selectbox(key=control(app, "choice")).select("a").run()
    assert not [box for box in app.number_input if box.key == "view_pdf_page"]
    app.selectbox(key=control(app, "choice")).select(state.OWN).run()
    app.number_input(key="view_pdf_page").set_value(2).run()
    assert app.session_state["choice"] == state.OWN
