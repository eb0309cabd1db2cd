"""Logs, registrations and traced walls last: reload, undo and redo, project file."""

from dataclasses import replace

from occsim import Corrections
from occsim.io.project import Project, dump_project, load_project
from pages._ui import compute, logs
from pages._ui.logs import LogFile
from pages._ui.robot_data import registered, registering, work
from pages._ui.robot_data.played import play_log
from pages._ui.robot_data.work import RobotWork, Traced, of_project, to_project
from pages._ui.settings import Settings
from pages._ui.state.works import Work, Works
from tests.test_pages import launch, said, upload
from tests.test_registering import (
    agreement_of,
    button,
    points_commit,
    run,
    section,
    step,
    trace,
)
from tests.test_robot_data import LABEL, PAGE, caption, log_of
from tests.test_session import opened

YOURS = "pages/2_Your_building.py"
POINTS = (
    (registering.DRAWING_KEY, [(100, 100), (200, 100)]),
    (registering.MAP_KEY, [(10, 10), (10, 30)]),
)


def with_log():
    return upload(launch(PAGE), LABEL, "own.log", log_of(), "text/plain")


def registered_by_points(app):
    app = section(app)
    for key, points in POINTS:
        app.session_state[key] = points_commit(app, key, points)
        app = run(run(app))
    return app


def reloaded(app):
    """The page as its address opens it in a new session."""
    key, _ = app.session_state.work
    assert key
    return opened(PAGE, work=key)


def test_a_reload_finds_log_registration_and_traced_walls():
    app = trace(registered_by_points(with_log()))
    before = app.session_state.robot
    again = reloaded(app)
    assert caption(again).startswith("own.log: 12 scans of 9 beams")
    assert agreement_of(section(again)) == agreement_of(step(app, registering.STEPS[0]))
    assert again.session_state.robot.traced.strokes == before.traced.strokes
    again = step(again, "Map with it")
    assert any("on scans held out" in text for text in said(again.markdown))
    # A drawing was not made: the sample is still one.
    assert again.session_state.own is None


def test_nothing_is_kept_of_a_page_that_was_only_looked_at():
    app = section(launch(PAGE))
    assert app.session_state.robot.is_empty
    assert app.session_state.work is None


def test_an_upload_and_each_step_of_a_registration_are_undone_and_redone():
    app = registered_by_points(with_log())
    first = app.session_state.robot.registrations
    assert len(first.steps) == 1
    app = run(button(app, "Refine").click())
    assert len(app.session_state.robot.registrations.steps) == 2
    app = run(button(app, "Undo").click())
    assert app.session_state.robot.registrations is first
    app = run(button(app, "Undo").click())
    assert app.session_state.robot.registrations.now is None
    board = app.session_state["boards"][registering.MAP_KEY].imposed
    assert board.points == ()  # what was drawn is gone from the board too
    app = run(button(app, "Redo").click())
    assert app.session_state.robot.registrations is first
    board = app.session_state["boards"][registering.MAP_KEY].imposed
    assert board.points == first.map_points
    for _ in range(3):
        app = run(button(app, "Undo").click())
    assert app.session_state.robot.log is None


def test_traced_walls_are_undone_on_the_board():
    app = trace(section(with_log()))
    assert not app.session_state.robot.traced.strokes.is_empty
    app = run(button(app, "Undo").click())
    assert app.session_state.robot.traced is None
    board = app.session_state["boards"][registering.TRACE_KEY].imposed
    assert board.corrections.is_empty


def test_going_back_to_the_simulated_log_can_be_undone():
    app = run(button(with_log(), "Back to the simulated").click())
    assert "Simulated" in caption(app)
    app = run(button(section(app), "Undo").click())
    assert app.session_state.robot.log.name == "own.log"


def project_of(app):
    session = app.session_state
    building = session.own or compute.sample(session.choice)
    robot = to_project(session.robot, building, session.settings)
    return dump_project(Project(building=building, robot=robot))


def test_a_project_file_carries_log_registration_and_traced_walls():
    app = trace(registered_by_points(with_log()))
    before = app.session_state.robot
    content = project_of(app)
    again = upload(opened(YOURS, section="7"), "Project file", "p.zip", content)
    after = again.session_state.robot
    assert (after.log.data, after.log.name) == (before.log.data, "own.log")
    assert after.registrations.now == before.registrations.now
    assert after.registrations.about == before.registrations.about
    assert after.traced.about == before.traced.about
    assert after.traced.strokes == before.traced.strokes
    again.switch_page(PAGE).run()
    assert agreement_of(section(again)) == agreement_of(step(app, registering.STEPS[0]))


def test_the_registration_of_a_simulated_log_is_in_the_project_without_the_log():
    building, settings = compute.sample("d"), Settings()
    log = logs.simulated(building)
    made = play_log(log.data, logs.options(settings))
    about = registered.about(logs.map_id(log, settings), building)
    so_far = registered.opening(about, building, made)
    data = to_project(RobotWork(registrations=so_far), building, settings)
    assert data.log is None
    opened_ = load_project(dump_project(Project(building=building, robot=data)))
    found = of_project(opened_.robot, opened_.building).registrations
    assert found.about == about
    assert found.now == so_far.now


def test_a_registration_on_another_map_is_not_in_the_project():
    building = compute.sample("d")
    log = LogFile("own.log", log_of())
    about = registered.about(logs.map_id(log, Settings(log_cell_m=0.2)), building)
    so_far = registered.Registrations(about, steps=(registered.Registration(),))
    other = RobotWork(log=log, registrations=so_far)
    assert to_project(other, building, Settings()).registration is None
    assert to_project(other, building, Settings(log_cell_m=0.2)).registration


def test_traced_walls_of_another_size_are_not_drawn():
    """A project file may say that they belong to the map when they do not fit it."""
    app = trace(section(with_log()))
    robot = app.session_state.robot
    wrong = Traced(robot.traced.about, Corrections.none((7, 9)))
    app.session_state.robot = replace(robot, traced=wrong)
    app = step(app, "Map with it")
    assert any("Register a drawing on the map first" in text for text in said(app.info))


def test_a_log_that_is_too_large_is_not_kept_and_the_page_says_so(monkeypatch):
    monkeypatch.setattr(work, "MAX_LOG_BYTES", 10)
    app = registered_by_points(with_log())
    made = app.session_state.robot
    store = Works()
    found = store.find(store.keep(Work(robot=made)))
    assert found.robot.log is None
    assert found.robot.registrations is made.registrations
    app = run(
        app.segmented_control(key="view_robot_section").set_value("A log of scans")
    )
    assert "after a reload, upload it again" in caption(app)


def test_logs_count_towards_the_limit_of_what_is_kept():
    log = LogFile("own.log", bytes(1000))
    store = Works(max_bytes=2500)
    keys = [store.keep(Work(robot=RobotWork(log=log))) for _ in range(3)]
    assert store.find(keys[0]) is None
    assert store.find(keys[2]).robot.log is log
    assert store.keep(Work(robot=RobotWork(log=LogFile("a", bytes(3000))))) is None
    assert Works().keep(Work()) is not None
