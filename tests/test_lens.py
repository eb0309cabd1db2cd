"""The lens computes what occsim computes; its document, and what a link holds of it."""

import json
import math
import shutil
import subprocess
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import (
    BehindHit,
    EvidenceLog,
    Grid,
    PriorMap,
    Sensor,
    UpdateRule,
    fuse,
    lens_world,
    one_reading,
)
from occsim.sensor import inverse_sensor_model
from pages._ui.components.lens import lens_data
from pages._ui.components.lens.document import (
    CELL_SIZES,
    FOV_DEG,
    MAX_CHIPS,
    OPENING,
    RANGE_PX,
    LensDocument,
    decode_commit,
    link_texts,
    to_texts,
    with_texts,
)
from tests.oracles import classify, naive_reading
from tests.test_session import opened

PAGE = "pages/0_What_the_sensor_says.py"
SCRIPT = Path(__file__).parent / "node" / "lens_readings.mjs"
OUT_OF_VIEW, UNSAID, EMPTY, OBJECT = range(4)
SEED = 20


def sensor_of(document):
    return Sensor(
        range_px=float(document.range_px),
        fov_rad=math.radians(document.fov_deg),
        behind_hit=document.behind_hit,
        clear_no_hit=document.clear_no_hit,
    )


def pose_of(document):
    return document.x_px, document.y_px, math.radians(document.heading_deg)


def in_node(documents=(), ladders=()):
    """What the scripts of the lens make of these documents, in Node."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("there is no Node")
    given = {
        "header": json.loads(lens_data(OPENING, "key")),
        "readings": [to_texts(document) for document in documents],
        "ladders": [to_texts(document) for document in ladders],
    }
    done = subprocess.run(
        [node, str(SCRIPT)],
        input=json.dumps(given),
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def random_documents(n):
    """Poses and sensors, half of them on half pixels and whole degrees, where rays
    pass through corners and pixels lie exactly on the edge of the view."""
    rng = np.random.default_rng(SEED)
    height, width = lens_world().shape
    for i in range(n):
        # As many digits as a text holds.
        x, y, heading = rng.uniform(0.0, (width, height, 360.0)).round(6)
        if i % 2:
            x, y = np.floor(2.0 * np.array([x, y])) / 2.0
            heading = rng.choice([0, 45, 90, 180, 270, np.floor(heading)])
        yield replace(
            OPENING,
            x_px=float(x),
            y_px=float(y),
            heading_deg=float(heading),
            range_px=int(rng.integers(RANGE_PX[0], RANGE_PX[1] + 1)),
            fov_deg=int(rng.choice([5, 30, 60, 90, 180, 270, 360])),
            cell_px=int(rng.choice(CELL_SIZES)),
        )


def kinds_of(reading):
    """What a reading says of each pixel, as the lens numbers it."""
    kinds = np.where(reading.in_view, UNSAID, OUT_OF_VIEW)
    kinds[reading.empty] = EMPTY
    kinds[reading.object] = OBJECT
    return kinds


def test_browser_and_library_agree_on_500_poses():
    """Each with both readings behind a hit and both of a ray without one."""
    world = lens_world()
    documents = [
        replace(document, behind_hit=behind_hit, clear_no_hit=clear)
        for document in random_documents(500)
        for behind_hit, clear in product(BehindHit, (True, False))
    ]
    got = in_node(documents)["readings"]
    for document, one in zip(documents, got, strict=True):
        kinds, in_view, empty, objects, log_odds, hidden = one
        grid = world.grid(document.cell_px)
        seen = one_reading(world, pose_of(document), sensor_of(document), grid)
        np.testing.assert_array_equal(kinds, kinds_of(seen).ravel(), str(document))
        np.testing.assert_array_equal(in_view, grid.count(seen.in_view).ravel())
        np.testing.assert_array_equal(empty, seen.n_empty.ravel())
        np.testing.assert_array_equal(objects, seen.n_object.ravel())
        np.testing.assert_array_equal(log_odds, seen.log_odds.ravel())
        assert hidden == (seen.object & ~world.occupied).sum()


def test_each_pixel_of_the_browser_is_what_its_own_ray_says():
    """Against the naive loop over wall pixels, without the library's rays."""
    occupied = lens_world().occupied.tolist()
    documents = [
        replace(document, fov_deg=30, range_px=min(document.range_px, 36))
        for document in random_documents(24)
    ]
    for document, one in zip(documents, in_node(documents)["readings"], strict=True):
        pose, sensor = pose_of(document), sensor_of(document)
        numbers = {"empty": EMPTY, "object": OBJECT}
        for i, kind in enumerate(one[0]):
            said = classify(occupied, pose, *divmod(i, 48), sensor)
            assert numbers.get(said) == (kind if kind >= EMPTY else None)
        counts = naive_reading(occupied, pose, sensor, document.cell_px)
        read = {c: n for c, n in enumerate(zip(*one[2:4], strict=True)) if any(n)}
        assert read == counts


def test_readings_add_up_as_in_a_map():
    grid = Grid(height_px=1, width_px=1, cell_px=1)
    counts = {"e": (1, 0), "o": (0, 1), "5.3": (5, 3), "8.8": (8, 8), "63.1": (63, 1)}
    documents = [
        replace(OPENING, p_free=p_free, rule=rule, chips=chips)
        for p_free in (0.02, 0.18, 0.5, 0.9, 0.98)
        for rule in UpdateRule
        for chips in ((), ("e",), ("e", "e"), ("e", "o"), ("o", "o"), tuple(counts))
    ]
    for document, total in zip(
        documents, in_node(ladders=documents)["ladders"], strict=True
    ):
        said = [inverse_sensor_model(*counts[chip]) for chip in document.chips]
        k = len(said)
        log = EvidenceLog(grid, range(k + 1), [0] * k, np.array(said, dtype=float))
        prior = PriorMap(grid, np.array([[True]]), np.array([[document.p_free]]))
        assert total == fuse(log, prior, document.rule).log_odds[0, 0]


def test_the_numbers_of_the_lesson_are_those_of_the_library():
    """30 cells in view at the opening, 5 mixed, 66 free pixels called object, 8 : 8."""
    world, grid = lens_world(), lens_world().grid(OPENING.cell_px)
    seen = one_reading(world, pose_of(OPENING), sensor_of(OPENING), grid)
    cell = OPENING.row, OPENING.col
    assert (seen.n_empty[cell], seen.n_object[cell]) == (8, 8)
    assert seen.is_updated.sum() == 30
    assert ((seen.n_empty > 0) & (seen.n_object > 0)).sum() == 5
    assert (seen.object & ~world.occupied).sum() == 66


# --- The document and its link ------------------------------------------------------

free_places = [
    (col + part, row + part)
    for row, col in np.argwhere(~lens_world().occupied).tolist()
    for part in (0.0, 0.5)
]
chips = st.sampled_from(["e", "o"]) | st.tuples(
    st.integers(0, 32), st.integers(1, 32)
).map(lambda pair: f"{pair[0]}.{pair[1]}")


@st.composite
def documents(draw):
    cell_px = draw(st.sampled_from(CELL_SIZES))
    n_rows, n_cols = (side // cell_px for side in lens_world().shape)
    x_px, y_px = draw(st.sampled_from(free_places))
    return LensDocument(
        rev=4,
        x_px=x_px,
        y_px=y_px,
        heading_deg=draw(st.integers(0, 359)),
        cell_px=cell_px,
        row=draw(st.integers(0, n_rows - 1)),
        col=draw(st.integers(0, n_cols - 1)),
        range_px=draw(st.integers(*RANGE_PX)),
        fov_deg=draw(st.integers(*FOV_DEG)),
        behind_hit=draw(st.sampled_from(BehindHit)),
        clear_no_hit=draw(st.booleans()),
        p_free=draw(st.integers(2, 98)) / 100,
        rule=draw(st.sampled_from(UpdateRule)),
        chips=tuple(draw(st.lists(chips, max_size=MAX_CHIPS))),
    )


IMPOSED = LensDocument(rev=4)


@given(documents())
def test_a_commit_comes_back_as_it_was_chosen(document):
    commit = json.loads(json.dumps({"rev": 4, **to_texts(document)}))
    assert decode_commit(commit, IMPOSED) == document


@given(documents())
def test_a_link_holds_all_that_was_chosen_and_is_short(document):
    texts = link_texts(document)
    assert with_texts(IMPOSED, texts) == (document, [])
    assert sum(len(name) + len(text) for name, text in texts.items()) < 200


def test_a_link_to_the_opening_says_nothing():
    assert link_texts(OPENING) == {}


@given(st.dictionaries(st.sampled_from(list(to_texts(OPENING))), st.text() | st.none()))
def test_whatever_is_committed_the_document_stays_within_bounds(commit):
    document = decode_commit({**commit, "rev": 4}, IMPOSED)
    assert decode_commit({"rev": 4, **to_texts(document)}, IMPOSED) == document


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("pose", "48.5_10_0"),
        ("pose", "8.5_10.5"),
        ("pose", "nan_10_0"),
        ("pose", "8_8_inf"),
        ("pose", "39.5_2.5_0"),  # in the wall
        ("size", "3"),
        ("cell", "8_0"),
        ("cell", "-1_0"),
        ("range", "59"),
        ("fov", "0"),
        ("behind", "else"),
        ("clear", "yes"),
        ("prior", "0.99"),
        ("prior", "nan"),
        ("rule", "none"),
        ("chips", "_".join("e" * (MAX_CHIPS + 1))),
        ("chips", "x"),
        ("chips", "0.0"),
        ("chips", "60.5"),
        ("chips", "².1"),
    ],
)
def test_what_is_wrong_keeps_what_was_and_is_named(name, text):
    assert with_texts(IMPOSED, {name: text}) == (IMPOSED, [name])


def test_a_commit_on_an_older_document_is_ignored():
    late = {"rev": 3, **to_texts(replace(OPENING, p_free=0.7))}
    assert decode_commit(late, IMPOSED) == IMPOSED
    assert decode_commit("nonsense", IMPOSED) == IMPOSED


def test_larger_cells_keep_the_selected_cell_in_the_world():
    document, wrong = with_texts(OPENING, {"size": "8"})
    assert (document.row, document.col) == (2, 5)
    assert not wrong


# --- The page -----------------------------------------------------------------------


def test_a_link_opens_the_lens_and_says_what_was_wrong_with_it():
    app = opened(PAGE, lens_pose="8.5_28.5_0", lens_cell="6_9", lens_prior="2")
    chosen = app.session_state["lens_chosen"]
    assert (chosen.x_px, chosen.y_px, chosen.row, chosen.col) == (8.5, 28.5, 6, 9)
    assert chosen.p_free == OPENING.p_free
    assert "lens_prior" in app.warning[0].value.replace("\\", "")


def test_a_reset_returns_the_lens_to_its_opening_and_ignores_late_commits():
    app = opened(PAGE, lens_pose="8.5_28.5_0", lens_chips="o")
    before = app.session_state["lens_chosen"].rev
    next(one for one in app.button if one.label == "Reset all").click().run()
    chosen = app.session_state["lens_chosen"]
    assert chosen.rev > before
    assert replace(chosen, rev=OPENING.rev) == OPENING
