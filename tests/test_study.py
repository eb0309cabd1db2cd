import csv
import io
import json
import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from occsim import (
    Drawing,
    ParameterError,
    Scores,
    Sensor,
    Trajectory,
    UpdateRule,
    __version__,
    load_sample,
)
from occsim.building import Building
from occsim.cli import main
from occsim.io.images import mask_png
from occsim.priors import SOURCE_AXIS, Objective, ParetoFront, PriorSweep
from occsim.study import (
    StudyCase,
    StudySettings,
    case_settings,
    fronts_csv,
    fronts_figure,
    is_reference,
    maps_figure,
    maxima_csv,
    maxima_table,
    maxima_text,
    pattern,
    pattern_text,
    read_case,
    run_case,
    study_document,
    sweeps_csv,
)
from occsim.study.published import published_maximum

AXIS = np.array(SOURCE_AXIS)


def room(shape=(60, 80)):
    """A room: walls of 4 px around free space."""
    walls = np.ones(shape, dtype=bool)
    walls[4:-4, 4:-4] = False
    return walls


def drawing_of(walls, name="room", poses=((30, 30, 0.0), (40, 30, 1.5), (40, 30, 3.1))):
    grey = np.where(walls, 0, 255).astype(np.uint8)
    return Building(
        drawing=Drawing(np.stack([grey] * 3, axis=-1), name=name),
        found=walls,
        trajectory=Trajectory(poses=poses),
        sensor=Sensor(range_px=40.0, fov_rad=1.0),
    )


def case_of(tp, fp, fn, name="x", cell_px=3, is_reference=False):
    """A case with given counts at the 10 x 10 pairs, by (row, column) or everywhere."""
    tp, fp, fn = (np.broadcast_to(x, (10, 10)).astype(np.int64) for x in (tp, fp, fn))
    sweep = PriorSweep(AXIS, AXIS, tp=tp, fp=fp, fn=fn, tn=np.zeros_like(tp))
    front = ParetoFront(*(np.array([0.5]) for _ in range(4)))
    return StudyCase(name, cell_px, sweep, front, Scores(1, 1, 1, 0), is_reference)


@pytest.fixture(scope="module")
def cases():
    return [run_case(drawing_of(room()), cell_px) for cell_px in (5, 10)]


def test_a_case_holds_the_scores_without_a_drawing(cases):
    """With a prior of one half the update rule and the drawing's walls are nothing."""
    bare = drawing_of(room())
    blank = Building(
        drawing=bare.drawing,
        found=np.zeros((60, 80), dtype=bool),
        truth=room(),
        trajectory=bare.trajectory,
        sensor=bare.sensor,
        name="blank",
    )
    once = StudySettings(rule=UpdateRule.PRIOR_ONCE)
    found = run_case(blank, 5, once)
    assert found.blank == cases[0].blank
    assert found.blank.tp > 0


def test_the_front_is_as_good_as_the_sweep(cases):
    for case in cases:
        assert case.front.recall.max() >= case.recall.value
        assert case.front.precision.max() >= case.precision.value


def test_settings_reach_the_sweep():
    drawing = drawing_of(room())
    once = StudySettings(rule=UpdateRule.PRIOR_ONCE)
    default, other = run_case(drawing, 5), run_case(drawing, 5, once)
    assert not np.array_equal(default.sweep.tp, other.sweep.tp)


def test_poses_in_walls_are_left_out():
    drawing = drawing_of(room(), poses=((30, 30, 0.0), (1, 1, 0.0), (-9, 0, 0.0)))
    alone = drawing_of(room(), poses=((30, 30, 0.0),))
    np.testing.assert_array_equal(
        run_case(drawing, 5).sweep.tp, run_case(alone, 5).sweep.tp
    )


@pytest.mark.parametrize(
    ("walls", "poses"),
    [
        (np.zeros((40, 40), dtype=bool), ((20, 20, 0.0),)),
        (room(), ((30, 30, 0.0),)),
    ],
    ids=["a drawing without walls", "a sensor that reaches none"],
)
def test_a_study_without_a_hit_is_reported_as_such(walls, poses):
    drawing = drawing_of(walls, poses=poses)
    short = replace(drawing, sensor=Sensor(range_px=3.0))
    found = [run_case(short, 5)]
    assert len(found[0].front) == 0
    assert np.isnan(found[0].recall.value)
    assert not found[0].conflict
    assert found[0].recommended() is None
    assert pattern(found).n_cases == 0
    assert "–" in maxima_text(found)
    assert fronts_csv(found).count("\n") == 1
    figure = maps_figure(found)
    assert "undefined" in figure.axes[0].get_title()
    for one in (figure, fronts_figure(found)):
        one.savefig(io.BytesIO())


def test_pattern_of_three_cases_by_hand():
    """The first has both peaks in the pattern, and conflicting; the second none.

    First: TP 2 of 4 in the column p_space = 1 with FP 2, else TP 1 and FP 0: recall
    0.5 only there, precision 1 elsewhere (also below 0.5). Second: everything scores
    the same, so the peaks are everywhere, also in one pair together. Third: undefined.
    """
    last = AXIS == 1.0
    cases = [
        case_of(np.where(last, 2, 1), np.where(last, 2, 0), np.where(last, 2, 3)),
        case_of(1, 1, 1),
        case_of(0, 0, 0),
    ]
    found = pattern(cases)
    assert found.n_cases == 2
    assert found.recall_at_full_space == 2
    assert found.recall_only_at_full_space == 1
    assert found.precision_at_low_space == 2
    assert found.precision_only_at_low_space == 0
    assert found.conflicts == 1
    assert "in 1 of 2 cases" in pattern_text(cases)


def test_published_maxima_stand_beside_those_of_the_samples():
    """Tables 4.1 and 4.2 of the thesis, three entries read off the page."""
    assert published_maximum(Objective.PRECISION, 3, "a") == (98.49, "(0.3, 0.3)")
    assert published_maximum(Objective.PRECISION, 10, "c").pairs == (
        "(0.1:0.2, 0.3:0.5)"
    )
    assert published_maximum(Objective.RECALL, 5, "e") == (88.68, "(0.9:1, 1)")
    assert published_maximum(Objective.RECALL, 4, "a") is None
    assert published_maximum(Objective.RECALL, 3, "room") is None
    case = case_of(3, 1, 1, name="d", is_reference=True)
    rows = list(csv.DictReader(io.StringIO(maxima_csv([case]))))
    assert rows[0]["percent"] == "75.0"
    assert rows[0]["pairs"] == "(0.1:1, 0.1:1)"
    assert rows[0]["published_percent"] == "95.56"
    assert rows[1]["published_pairs"] == "(0.7:1, 1)"


def test_published_maxima_stand_only_beside_true_samples():
    """An own drawing called "d", and sample d with its walls changed, are others."""
    sample = load_sample("d")
    assert is_reference(sample)
    blank = np.zeros(sample.world.shape, dtype=bool)
    for own in (drawing_of(room(), name="d"), replace(sample, found=blank)):
        assert not is_reference(own)
        rows = list(csv.DictReader(io.StringIO(maxima_csv([run_case(own, 3)]))))
        assert [row["published_percent"] for row in rows] == ["", ""]


def test_undefined_figures_are_empty_in_csv():
    row = next(csv.DictReader(io.StringIO(maxima_csv([case_of(0, 0, 0)]))))
    assert (row["percent"], row["published_percent"]) == ("", "")
    assert row["pairs"] == "–"


def test_csv_files_hold_all_points_and_pairs(cases):
    points = list(csv.DictReader(io.StringIO(fronts_csv(cases))))
    assert len(points) == sum(len(case.front) for case in cases)
    recommended = [row["recommended"] == "True" for row in points]
    assert sum(recommended) == sum(case.recommended() is not None for case in cases) > 0
    assert float(points[0]["precision"]) == cases[0].front.precision[0]
    pairs = list(csv.DictReader(io.StringIO(sweeps_csv(cases))))
    assert len(pairs) == 100 * len(cases)
    assert (pairs[1]["p_wall"], pairs[1]["p_space"]) == ("0.1", "0.2")
    assert int(pairs[1]["tp"]) == cases[0].sweep.tp[0, 1]


def test_tables_come_by_cell_size_and_files_by_case():
    """As in the source: all drawings at one cell size, then at the next."""
    names = [("a", 3), ("a", 5), ("b", 3), ("b", 5)]
    cases = [case_of(3, 1, 1, name=name, cell_px=px) for name, px in names]
    table = maxima_table(cases, Objective.RECALL)
    assert [(row[2], row[1]) for row in table] == [
        ("a", 3),
        ("b", 3),
        ("a", 5),
        ("b", 5),
    ]
    rows = list(csv.DictReader(io.StringIO(maxima_csv(cases))))
    assert [row["objective"] for row in rows] == ["precision", "recall"] * 4


def test_a_table_of_own_drawings_has_no_figures_of_the_source():
    own = maxima_text([case_of(3, 1, 1, name="a")])
    assert "published" not in own
    assert "Table" not in own
    both = [case_of(3, 1, 1, name="d", is_reference=True), case_of(3, 1, 1)]
    assert "95.56" in maxima_text(both)


def test_a_case_comes_back_from_its_document_as_it_was(cases):
    document = json.loads(
        json.dumps(study_document(drawing_of(room()), 5, StudySettings()))
    )
    again = read_case(document | {"cell_px": 5})
    for name in ("p_wall", "p_space", "tp", "fp", "fn", "tn"):
        np.testing.assert_array_equal(
            getattr(again.sweep, name), getattr(cases[0].sweep, name)
        )
    for name in ("p_wall", "p_space", "precision", "recall", "rectangles"):
        np.testing.assert_array_equal(
            getattr(again.front, name), getattr(cases[0].front, name)
        )
    assert (again.name, again.cell_px, again.blank) == ("room", 5, cases[0].blank)
    assert document["sensor"]["range_px"] == 40.0


def test_settings_are_described_with_the_versions():
    described = case_settings(drawing_of(room()), 5, StudySettings())
    assert set(described["software"]) == {"occsim", "numpy", "opencv"}
    assert described["settings"]["rule"] == "subtract_prior"


def lines_of(ax):
    """What is marked in a plot: label and points, (x, y) a row."""
    return {line.get_label(): line.get_xydata() for line in ax.lines}


def test_maps_show_precision_and_recall_of_every_case(cases):
    axes = maps_figure(cases).axes
    maps, bars = axes[:4], axes[4:]
    titles = [ax.get_title().split(":")[0] for ax in maps]
    assert titles == ["room, 5 px cells"] * 2 + ["room, 10 px cells"] * 2
    assert [bar.get_ylabel() for bar in bars] == ["precision, %", "recall, %"] * 2
    case, lines = cases[0], lines_of(maps[1])
    best = np.stack((case.recall.p_wall, case.recall.p_space), axis=1)
    np.testing.assert_array_equal(lines["largest values"], best)
    front = np.stack((case.front.p_wall, case.front.p_space), axis=1)
    np.testing.assert_array_equal(lines["exact front"], front)
    np.testing.assert_array_equal(
        lines["the source's choice, (0.2, 0.9)"], [[0.2, 0.9]]
    )


def test_colours_of_a_map_are_the_sweeps_values_upright():
    """p_wall to the right and p_space upwards: precision 1, but 0.2 at (1, 0.1)."""
    tp, fp = np.full((10, 10), 4), np.zeros((10, 10))
    tp[9, 0], fp[9, 0] = 1, 4
    (image,) = maps_figure([case_of(tp, fp, 1)]).axes[0].images
    values, origin = np.asarray(image.get_array()), image.origin
    assert origin == "lower"
    assert tuple(image.get_extent()) == (0.1, 1.0, 0.1, 1.0)
    assert values[0, -1] == pytest.approx(20.0)
    assert values[0, 0] == values[-1, -1] == values[-1, 0] == pytest.approx(100.0)


def test_fronts_are_drawn_with_the_source_and_without_a_drawing():
    """The front of `case_of` is the point (0.5, 0.5), (2, 2) in the plot; the sweep
    has precision 3/4 and recall 3/5 everywhere, so also at the source's pair; without
    a drawing both scores are one half."""
    ax = fronts_figure([case_of(3, 1, 2, name="cost_$x$")]).axes[0]
    name, points, star, blank = (line.get_xydata() for line in ax.lines[:4])
    np.testing.assert_array_equal(points, [[2.0, 2.0]])
    np.testing.assert_array_equal(name, points)
    np.testing.assert_allclose(star, [[4 / 3, 5 / 3]])
    np.testing.assert_array_equal(blank, [[2.0, 2.0]])
    assert r"cost_\$x\$, 3 px cells" in lines_of(ax)
    assert ax.get_xlabel().startswith("1/precision")
    assert ax.get_ylabel().startswith("1/recall")


def test_a_long_name_leaves_room_for_the_figure():
    case = case_of(3, 1, 2, name="folder/" * 12 + "plan")
    for figure in (maps_figure([case]), fronts_figure([case])):
        figure.savefig(io.BytesIO())


def test_the_border_of_a_front_turns_where_both_scores_are_worse():
    """Of (1/precision, 1/recall) = (1, 2) and (2, 1): by way of (2, 2)."""
    case = case_of(1, 1, 1)
    front = ParetoFront(*np.array([[0.5, 0.5], [0.5, 0.5], [0.5, 1.0], [1.0, 0.5]]))
    case = replace(case, front=front)
    border = fronts_figure([case]).axes[0].lines[0]
    assert border.get_drawstyle() == "steps-post"
    np.testing.assert_array_equal(border.get_xydata(), [[1.0, 2.0], [2.0, 1.0]])


def test_a_figure_of_nothing_is_refused():
    with pytest.raises(ParameterError, match="at least one case"):
        maps_figure([])


def test_without_matplotlib_the_command_writes_tables_and_says_so(
    tmp_path, capsys, monkeypatch
):
    for name in ("matplotlib", "matplotlib.figure"):
        monkeypatch.setitem(sys.modules, name, None)
    assert main(["study", "d", "--cells", "50", "--out", str(tmp_path)]) == 0
    assert capsys.readouterr().err == (
        "[1/1] d, 50 px: computed\n"
        "occsim: no figures: a figure needs matplotlib: pip install 'occsim[study]'\n"
    )
    assert (tmp_path / "maxima.csv").is_file()
    assert not list(tmp_path.glob("*.png"))


def test_the_study_subtracts_the_prior_at_every_reading_by_default(tmp_path):
    """As in the source, whatever the default of the library's maps is."""
    assert main(["study", "d", "--cells", "50", "--out", str(tmp_path)]) == 0
    (kept,) = (tmp_path / "cases").iterdir()
    settings = json.loads(kept.read_text(encoding="utf-8"))["settings"]
    assert settings["rule"] == "subtract_prior"
    assert settings["region"] == "explored"
    assert settings["behind_hit"] == "occupied"


def test_the_command_says_its_version(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out == f"occsim {__version__}\n"


def test_the_command_writes_resumes_and_says_so(tmp_path, capsys):
    image = tmp_path / "hall.png"
    image.write_bytes(mask_png(room((120, 160))))
    command = ["study", str(image), "--cells", "20", "10", "--out", str(tmp_path / "o")]
    assert main(command) == 0
    first = capsys.readouterr()
    assert first.err.count("computed") == 2
    assert "Maximum precision\n" in first.out
    assert "1 of 1 drawings gave a result" in first.out
    written = {path.name for path in (tmp_path / "o").iterdir()}
    assert {"maxima.csv", "fronts.csv", "sweeps.csv", "pattern.txt"} < written
    assert {"maps_10px.png", "fronts_20px.png"} < written
    next((tmp_path / "o" / "cases").glob("*_10px_*.json")).unlink()
    assert main(command) == 0
    second = capsys.readouterr()
    assert (second.err.count("computed"), second.err.count("kept")) == (1, 1)
    assert second.out == first.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["no such drawing"], "a drawing is a sample .* got 'no such drawing'"),
        (["a", "--cells", "0"], "--cell must be 1 px or more; got 0"),
        (
            ["a", "--cells", "9" * 20],
            "cell_px must be a whole number, 1 to 2,147,483,647; got 9",
        ),
        (["a", "--range-px", "-1"], "range_px must be above 0"),
    ],
)
def test_bad_arguments_get_one_sentence(tmp_path, capsys, arguments, message):
    assert main(["study", *arguments, "--out", str(tmp_path / "o")]) == 2
    captured = capsys.readouterr()
    assert len(captured.err.splitlines()) == 1
    assert re.search(message, captured.err)


def test_a_folder_that_is_a_file_gets_one_sentence(tmp_path, capsys):
    file = tmp_path / "o"
    file.touch()
    assert main(["study", "a", "--cells", "100", "--out", str(file)]) == 2
    captured = capsys.readouterr()
    assert re.fullmatch(r"occsim: \S+ cannot be used \(.+\)\n", captured.err)


def test_a_reader_that_goes_away_ends_the_command_quietly(tmp_path):
    reader, writer = os.pipe()
    os.close(reader)
    command = ["study", "a", "--cells", "100", "--out", str(tmp_path)]
    ended = subprocess.run(
        [sys.executable, "-m", "occsim", *command],
        stdout=writer,
        stderr=subprocess.PIPE,
    )
    os.close(writer)
    assert ended.stderr == b"[1/1] a, 100 px: computed\n"
    assert ended.returncode == 128 + 13  # as of a command ended by SIGPIPE


def test_a_study_of_no_usable_drawing_ends_with_the_reason(tmp_path, capsys):
    bad = tmp_path / "bad.png"
    bad.write_bytes(b"no image")
    assert main(["study", str(bad), "--out", str(tmp_path / "o")]) == 2
    assert re.search(r"\noccsim: bad.png is .*, not an image", capsys.readouterr().err)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rule": "once"}, "rule must be one of UpdateRule.PRIOR_ONCE .*; got 'once'"),
        ({"low": 0.0}, "low and high must satisfy"),
        ({"wall_share": 1.0}, r"wall_share must lie in \[0, 1\)"),
    ],
)
def test_bad_settings_are_refused(change, message):
    with pytest.raises(ParameterError, match=message):
        StudySettings(**change)
