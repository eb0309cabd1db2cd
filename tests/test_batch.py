"""Many drawings: found, read, spread over processes, kept and taken up again."""

import json
import math
import os
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from occsim import ParameterError, Sensor
from occsim.cli import main
from occsim.cli.progress import bar, shown
from occsim.errors import OccsimError
from occsim.io.images import mask_png, png
from occsim.study import (
    STUDY,
    Batch,
    Failure,
    Kept,
    Machines,
    SensorChoice,
    Step,
    StudySettings,
    find_drawings,
    plain,
    read_content,
    result_path,
    run_batch,
    spread,
)
from tests.test_study import room

POSES = "x_px,y_px,theta_rad\n30,30,0\n60,40,1.5\n"


def sheet(walls):
    """A drawing of these walls, as the bytes of a PNG."""
    return png(np.where(walls, 0, 255).astype(np.uint8))


@pytest.fixture
def folder(tmp_path):
    """Two plans with their own truth and poses, one alone, and files of other kinds."""
    plans = tmp_path / "plans"
    (plans / "old").mkdir(parents=True)
    for name in ("hall", "old/barn_drawing", "shed"):
        (plans / f"{name}.png").write_bytes(sheet(room((80, 100))))
    (plans / "hall_truth.png").write_bytes(mask_png(room((80, 100))))
    (plans / "hall.poses").write_text("30 30 0\n60 40 1.5\n")
    (plans / "old" / "barn_walls.png").write_bytes(mask_png(room((80, 100))))
    (plans / "old" / "barn_trajectory.csv").write_text(POSES)
    (plans / "shed_walls224.png").write_bytes(mask_png(room((60, 60))))
    (plans / "shed.txt").write_text("a note")
    return plans


def batch_of(sources, tmp_path, **changes):
    """A study of cells of 10 and 20 px that keeps its results in `tmp_path`."""
    settings = StudySettings()
    given = {
        "kind": STUDY,
        "sources": sources,
        "cells": (10, 20),
        "settings": settings,
        "described": plain(settings),
        "folder": tmp_path,
        "sensor": SensorChoice(range_px=30.0),
    }
    return Batch(**given | changes)


# --- Finding and reading --------------------------------------------------------------


def test_a_folder_gives_its_drawings_with_what_lies_beside_them(folder):
    hall, barn, shed = find_drawings([folder])
    assert (hall.name, barn.name, shed.name) == ("hall", "old/barn_drawing", "shed")
    assert hall.truth == folder / "hall_truth.png"
    assert hall.trajectory == folder / "hall.poses"
    assert barn.truth == folder / "old" / "barn_walls.png"
    assert barn.trajectory == folder / "old" / "barn_trajectory.csv"
    # A picture of walls is no drawing, and one of another size no truth; a note is no
    # trajectory.
    assert shed.truth is None
    assert shed.trajectory is None


def test_truths_and_trajectories_may_lie_in_folders_of_their_own(folder, tmp_path):
    truths = tmp_path / "truths"
    truths.mkdir()
    (truths / "shed_truth.png").write_bytes(mask_png(room((80, 100))))
    hall, _, shed = find_drawings([folder], truth=truths)
    assert (hall.truth, shed.truth) == (None, truths / "shed_truth.png")
    assert hall.trajectory == folder / "hall.poses"
    one = folder / "hall_truth.png"
    (alone,) = find_drawings([folder / "shed.png"], truth=one)
    assert alone.truth == one
    with pytest.raises(ParameterError, match="one truth file belongs to one drawing"):
        find_drawings([folder], truth=one)
    with pytest.raises(ParameterError, match="there is no file or folder"):
        find_drawings([folder], trajectory=tmp_path / "none")


def test_drawings_of_one_name_are_told_apart(tmp_path):
    for sub in ("x", "y"):
        (tmp_path / sub).mkdir()
        (tmp_path / sub / "plan.png").write_bytes(b"")
    (tmp_path / "x" / "plan.jpg").write_bytes(b"")
    found = find_drawings([tmp_path / "x", tmp_path / "y" / "plan.png"])
    assert [one.name for one in found] == [
        "plan.jpg",
        str(tmp_path / "x" / "plan.png"),
        str(tmp_path / "y" / "plan.png"),
    ]
    twice = find_drawings([tmp_path / "y", tmp_path / "y" / "plan.png", "a", "a"])
    assert [one.name for one in twice] == ["plan", "a"]


def test_a_place_without_a_drawing_is_refused(tmp_path):
    with pytest.raises(ParameterError, match="none is in"):
        find_drawings([tmp_path])
    with pytest.raises(ParameterError, match="a drawing is a sample .* got 'nowhere'"):
        find_drawings(["nowhere"])


def test_files_reach_the_building(folder):
    hall, _, shed = (read_content(one) for one in find_drawings([folder]))
    building = hall.building()
    np.testing.assert_array_equal(building.truth, room((80, 100)))
    np.testing.assert_array_equal(building.trajectory.poses[:, 0], [30.0, 60.0])
    planned = shed.building()
    assert planned.truth is None
    assert planned.trajectory is planned.tour


def test_a_sensor_may_be_chosen_for_files_and_is_a_samples_own(folder):
    choice = SensorChoice(range_px=33.0, fov_rad=1.0)
    (hall,) = find_drawings([folder / "hall.png"])
    assert read_content(hall, choice).building().sensor == Sensor(
        range_px=33.0, fov_rad=1.0
    )
    (sample,) = find_drawings(["a"])
    assert read_content(sample, choice).building().sensor.range_px != 33.0
    with pytest.raises(ParameterError, match="range_px must be above 0"):
        SensorChoice(range_px=0.0)


def test_a_truth_of_another_size_is_a_reason(folder):
    (folder / "hall_truth.png").write_bytes(mask_png(room((60, 60))))
    (hall,) = find_drawings([folder / "hall.png"])
    with pytest.raises(OccsimError, match="ground truth must have the drawing's size"):
        read_content(hall).building()


# --- Spreading ------------------------------------------------------------------------


def halved(number):
    """Work of the tests: it fails, and ends its process, for some numbers."""
    if number == 3:
        raise ParameterError("three is not even")
    if number == 5:
        raise RuntimeError("unforeseen")
    if number == 7:
        os.kill(os.getpid(), signal.SIGKILL)
    return number // 2


@pytest.mark.parametrize("processes", [1, 2])
def test_a_job_that_fails_leaves_the_others_alone(processes):
    found = dict(spread(halved, range(7), Machines(processes=processes)))
    failed = {n: r.reason for n, r in found.items() if isinstance(r, Failure)}
    assert failed == {
        3: "three is not even",
        5: "it could not be computed (RuntimeError: unforeseen)",
    }
    assert {n: found[n] for n in (0, 1, 2, 4, 6)} == {0: 0, 1: 0, 2: 1, 4: 2, 6: 3}


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
def test_a_job_that_ends_its_process_leaves_the_others_alone():
    found = dict(spread(halved, [0, 7, 2, 4, 6, 8], Machines(processes=2)))
    assert "the process that worked on it ended" in found.pop(7).reason
    assert found == {0: 0, 2: 1, 4: 2, 6: 3, 8: 4}


@pytest.mark.parametrize("processes", [1, 2])
def test_jobs_are_asked_for_as_late_as_possible(processes):
    """Thousands of drawings must not stand in memory: two a process, at most."""
    asked = []

    def jobs():
        for number in range(0, 100, 2):
            asked.append(number)
            yield number

    for done, _ in enumerate(spread(halved, jobs(), Machines(processes=processes))):
        assert len(asked) - done <= 2 * processes
    assert len(asked) == 50


def test_machines_are_checked():
    with pytest.raises(ParameterError, match="processes must be a whole number"):
        Machines(processes=0)


# --- Batches --------------------------------------------------------------------------


def test_a_batch_is_every_drawing_at_every_cell_size(folder, tmp_path):
    sources = find_drawings([folder])
    steps = list(run_batch(batch_of(sources, tmp_path)))
    assert [(step.name, step.cell_px, step.done) for step in steps] == [
        ("hall", 10, 1),
        ("hall", 20, 2),
        ("old/barn_drawing", 10, 3),
        ("old/barn_drawing", 20, 4),
        ("shed", 10, 5),
        ("shed", 20, 6),
    ]
    assert {(step.total, step.is_kept, step.reason) for step in steps} == {
        (6, False, "")
    }
    cases = list(Kept(STUDY, [step.path for step in steps]))
    assert [(case.name, case.cell_px) for case in cases] == [
        (step.name, step.cell_px) for step in steps
    ]


def test_a_stopped_batch_continues(folder, tmp_path):
    batch = batch_of(find_drawings([folder]), tmp_path)
    stopped = run_batch(batch)
    next(stopped)
    stopped.close()
    again = list(run_batch(batch))
    assert [step.is_kept for step in again] == [True, *[False] * 5]
    assert all(step.is_kept for step in run_batch(batch))
    assert len(list(tmp_path.glob("*.json"))) == 6
    assert not list(tmp_path.glob("*.part"))


@pytest.mark.parametrize(
    "change",
    ["drawing", "truth", "trajectory", "sensor", "settings", "cells"],
)
def test_other_inputs_are_computed_again(folder, tmp_path, change):
    place = [folder / "hall.png"]
    list(run_batch(batch_of(find_drawings(place), tmp_path)))
    other = {}
    if change == "drawing":
        (folder / "hall.png").write_bytes(sheet(np.roll(room((80, 100)), 1)))
    elif change == "truth":
        (folder / "hall_truth.png").unlink()
    elif change == "trajectory":
        (folder / "hall.poses").write_text("31 30 0\n60 40 1.5\n")
    elif change == "sensor":
        other["sensor"] = SensorChoice(range_px=31.0)
    elif change == "settings":
        other["described"] = plain(StudySettings(rule="prior_once"))
    else:
        other["cells"] = (11, 21)
    steps = list(run_batch(batch_of(find_drawings(place), tmp_path, **other)))
    assert [step.is_kept for step in steps] == [False, False]


@pytest.mark.parametrize("damage", ["", "{", "[]", '{"format": "other"}', "cut"])
def test_a_damaged_result_is_computed_again(folder, tmp_path, damage):
    batch = batch_of(find_drawings([folder / "hall.png"]), tmp_path, cells=(20,))
    (step,) = run_batch(batch)
    content = step.path.read_text(encoding="utf-8")
    step.path.write_text(
        content[: len(content) // 2] if damage == "cut" else damage, encoding="utf-8"
    )
    (again,) = run_batch(batch)
    assert not again.is_kept
    assert again.path.read_text(encoding="utf-8") == content


def test_a_result_that_lacks_a_part_is_computed_again(folder, tmp_path):
    batch = batch_of(find_drawings([folder / "hall.png"]), tmp_path, cells=(20,))
    (step,) = run_batch(batch)
    document = json.loads(step.path.read_text(encoding="utf-8"))
    del document["sweep"]["fp"]
    step.path.write_text(json.dumps(document), encoding="utf-8")
    assert [again.is_kept for again in run_batch(batch)] == [False]


def test_a_name_cannot_lead_out_of_the_folder(tmp_path):
    path = result_path(tmp_path, "../../etc/passwd", {"cell_px": 3})
    assert path.parent == tmp_path


def test_a_drawing_that_cannot_be_used_does_not_end_the_study(folder, tmp_path, capsys):
    (folder / "bad.png").write_bytes(b"no image")
    (folder / "attic.png").write_bytes(sheet(room((80, 100))))
    (folder / "empty.png").write_bytes(b"")
    (folder / "shed_trajectory.csv").write_text("a,b\n1,two\n")
    out = tmp_path / "out"
    command = ["study", str(folder), "--cell", "20", "--out", str(out)]
    assert main(command) == 0
    printed = capsys.readouterr()
    assert "3 of 6 drawings gave a result at every cell size." in printed.out
    coverage = json.loads((out / "coverage.json").read_text(encoding="utf-8"))
    reasons = {one["drawing"]: one["reason"] for one in coverage["failed"]}
    assert set(reasons) == {"bad", "empty", "shed"}
    assert coverage["without_ground_truth"] == 1  # the attic
    assert "Without a ground truth: 1 of them." in printed.out
    assert all("\n" not in reason for reason in reasons.values())
    assert all(f"{name}: {why}" in printed.out for name, why in reasons.items())
    # What failed is tried again, and only that.
    assert main(command) == 0
    assert capsys.readouterr().err.count("no result") == 3


def test_options_of_the_command_reach_the_sensor(folder, tmp_path):
    command = ["study", str(folder / "hall.png"), "--cell", "20", "--range", "31"]
    assert main([*command, "--fov", "90", "--out", str(tmp_path)]) == 0
    (path,) = (tmp_path / "cases").iterdir()
    sensor = json.loads(path.read_text(encoding="utf-8"))["sensor"]
    assert sensor["range_px"] == 31.0
    assert sensor["fov_rad"] == pytest.approx(math.pi / 2)


def test_processes_give_what_one_process_gives(folder, tmp_path):
    sources = find_drawings([folder])
    results = []
    for n in (1, 2):
        out = tmp_path / str(n)
        out.mkdir()
        list(run_batch(batch_of(sources, out), Machines(processes=n)))
        results.append({path.name: path.read_bytes() for path in out.iterdir()})
    assert results[0] == results[1]
    assert len(results[0]) == 6


# --- Progress -------------------------------------------------------------------------


def step_of(done, total, **changes):
    given = {"path": Path("x"), "is_kept": False, "reason": ""} | changes
    return Step("plan", 3, done, total, **given)


def test_the_bar_has_the_count_and_an_estimate():
    """6 of 24 done in steps of 10 s: a quarter of the bar, 18 x 10 s = 3 min left."""
    line = bar(step_of(6, 24), 10.0, columns=80)
    assert line == f"[{'#' * 6}{'.' * 18}] 6/24  about 3 min left  plan"
    assert "done" in bar(step_of(24, 24), 10.0, columns=80)
    assert len(bar(step_of(6, 24), 10.0, columns=40)) < 40


class Terminal:
    """A stream that says it is a terminal, or not, and keeps what is written."""

    def __init__(self, is_terminal):
        self.isatty = lambda: is_terminal
        self.text = ""

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_a_terminal_has_one_line_and_a_file_has_a_line_a_case():
    steps = [step_of(1, 3), step_of(2, 3, is_kept=True), step_of(3, 3, reason="why")]
    terminal, file = Terminal(True), Terminal(False)
    for stream in (terminal, file):
        assert list(shown(iter(steps), stream)) == steps
    assert file.text == (
        "[1/3] plan, 3 px: computed\n[2/3] plan, 3 px: kept\n"
        "[3/3] plan, 3 px: no result: why\n"
    )
    assert terminal.text.count("\n") == 2  # after the reason, and at the end
    assert "plan, 3 px: no result: why\n" in terminal.text


# --- A cluster ------------------------------------------------------------------------


def kill_a_worker(client, results, killed):
    """Kill the process of one worker as soon as there is a first result."""
    pids, until = client.run(os.getpid), time.monotonic() + 60.0
    while not list(results.glob("*.json")) and time.monotonic() < until:
        time.sleep(0.01)
    killed.append(next(iter(pids.values())))
    os.kill(killed[0], signal.SIGKILL)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
@pytest.mark.filterwarnings("default")  # of distributed, at the loss of a worker
def test_a_cluster_that_loses_a_worker_gives_what_one_process_gives(tmp_path, capsys):
    distributed = pytest.importorskip("distributed")
    plans = tmp_path / "plans"
    plans.mkdir()
    for i in range(6):
        walls = room((80, 100))
        walls[20:60, 30 + 5 * i : 34 + 5 * i] = True
        (plans / f"plan{i}.png").write_bytes(sheet(walls))
    command = ["study", str(plans), "--cell", "4", "10", "--range", "30", "--out"]
    results, killed = tmp_path / "many" / "cases", []
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    )
    with cluster, distributed.Client(cluster, set_as_default=False) as client:
        killer = threading.Thread(target=kill_a_worker, args=(client, results, killed))
        killer.start()
        many = [str(tmp_path / "many"), "--dask", cluster.scheduler_address]
        assert main([*command, *many]) == 0
        killer.join()
        assert killed[0] not in client.run(os.getpid).values()
    assert "6 of 6 drawings gave a result" in capsys.readouterr().out
    assert main([*command, str(tmp_path / "one")]) == 0
    alone = {p.name: p.read_bytes() for p in (tmp_path / "one" / "cases").iterdir()}
    assert {p.name: p.read_bytes() for p in results.iterdir()} == alone
    assert len(alone) == 12


def test_a_cluster_that_does_not_answer_is_named(tmp_path, capsys, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("occsim.study.machines.CONNECT_S", 0.3)
    command = ["study", "d", "--cell", "50", "--out", str(tmp_path)]
    assert main([*command, "--dask", "tcp://127.0.0.1:9"]) == 2
    assert "no Dask scheduler answers at 'tcp://127.0.0.1:9'" in capsys.readouterr().err


def test_without_dask_the_command_says_how_to_install_it(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    command = ["study", "d", "--cell", "50", "--out", str(tmp_path)]
    assert main([*command, "--dask", "tcp://127.0.0.1:9"]) == 2
    assert capsys.readouterr().err == (
        "occsim: a Dask cluster needs distributed: pip install 'occsim[cluster]'\n"
    )
