"""Every page runs, with every setting that a student can choose."""

import re
from pathlib import Path

import cv2
import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from occsim import sample_names

ROOT = Path(__file__).resolve().parents[1]
PAGES = ["app.py", *(f"pages/{p.name}" for p in sorted((ROOT / "pages").glob("*.py")))]
BUILD = "pages/1_Build_a_map.py"


def launch(page):
    """Run a page as its first visitor does; it must not raise."""
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    if page != "app.py":
        app.switch_page(page)
    app.run()
    assert not app.exception
    return app


def control(app, name):
    """The key of the widget of a setting; see `renew_widgets`."""
    return f"control_{name}:{app.session_state['generation']}"


def said(elements):
    """What a page says, without the escapes and the marks of mathematics."""
    symbol = re.compile(r"\$([pl])_(?:\\text\{(\w+)\}|(0))\$")
    joined = [one.value.replace("\u2060", "") for one in elements]
    plain = [symbol.sub(r"\1_\2\3", text) for text in joined]
    return [re.sub(r"\\(.)", r"\1", text) for text in plain]


def png(image):
    return cv2.imencode(".png", image)[1].tobytes()


def rooms(height=160, width=220):
    """A plan that is not one of ours: two rooms with a door between them."""
    image = np.full((height, width), 255, np.uint8)
    cv2.rectangle(image, (10, 10), (width - 11, height - 11), 0, 6)
    cv2.line(image, (width // 2, 10), (width // 2, height // 2 - 15), 0, 6)
    cv2.line(image, (width // 2, height // 2 + 15), (width // 2, height - 11), 0, 6)
    return image


def upload(app, label, name, data, mime="image/png"):
    """Give a file to the uploader of this label."""
    uploader = next(item for item in app.get("file_uploader") if item.label == label)
    file = (name, data, mime)
    uploader.set_value([file] if uploader.proto.multiple_files else file)
    app.run()
    assert not app.exception
    return app


def file_in(app, label):
    """The name of the file that an uploader lists, or None."""
    file = next(x for x in app.get("file_uploader") if x.label == label).value
    return file.name if file else None


def own(app):
    return app.session_state["own"]


@pytest.mark.parametrize("page", PAGES)
def test_every_page_opens_without_a_message(page):
    app = launch(page)
    assert not app.error


@pytest.mark.parametrize("page", PAGES[1:])
def test_every_page_can_stand_alone(page):
    app = AppTest.from_file(str(ROOT / page), default_timeout=60).run()
    assert not app.exception


@pytest.mark.parametrize("name", sample_names())
def test_every_reference_drawing_maps(name):
    app = launch(BUILD)
    app.selectbox(key=control(app, "choice")).select(name).run()
    assert not app.exception
    assert not app.error
    assert app.session_state["choice"] == name


@pytest.mark.parametrize(
    ("name", "value"), [("cell_px", 1), ("cell_px", 20), ("range_px", 5)]
)
def test_sliders_reach_their_ends(name, value):
    app = launch(BUILD)
    app.slider(key=control(app, name)).set_value(value).run()
    assert not app.exception
    assert getattr(app.session_state["settings"], name) == value


def test_the_widest_view_and_the_longest_range():
    app = launch(BUILD)
    app.slider(key=control(app, "fov_deg")).set_value(360)
    app.slider(key=control(app, "range_px")).set_value(300).run()
    assert not app.exception


def test_more_than_can_be_replayed_is_refused_before_it_is_simulated():
    app = launch(BUILD)
    app.slider(key=control(app, "cell_px")).set_value(1)
    app.slider(key=control(app, "fov_deg")).set_value(360)
    app.slider(key=control(app, "range_px")).set_value(300).run()
    assert "choose larger cells" in said(app.error)[0]
    app.slider(key=control(app, "cell_px")).set_value(5).run()
    assert not app.error


def test_an_uploaded_plan_maps_at_once():
    app = upload(launch(BUILD), "Drawing", "rooms.png", png(rooms()))
    assert not app.error
    assert own(app).title == "rooms.png"
    assert own(app).truth is None
    assert len(own(app).trajectory) > 10
    assert any("No ground truth" in info.value for info in app.info)


def test_a_ground_truth_must_have_the_drawings_size():
    app = upload(launch(BUILD), "Drawing", "rooms.png", png(rooms()))
    app = upload(app, "Ground truth", "truth.png", png(rooms(80, 90)))
    assert "220 x 160 px; got 90 x 80 px" in said(app.error)[0]
    app = upload(app, "Ground truth", "truth.png", png(rooms()))
    assert not app.error
    assert own(app).truth is not None


def test_a_new_drawing_forgets_the_files_of_the_last_one():
    app = upload(launch(BUILD), "Drawing", "rooms.png", png(rooms()))
    app = upload(app, "Ground truth", "truth.png", png(rooms()))
    assert file_in(app, "Ground truth") == "truth.png"
    app = upload(app, "Drawing", "small.png", png(rooms(120, 150)))
    assert own(app).truth is None
    assert file_in(app, "Ground truth") is None


BAD_IMAGES = {
    "empty": b"",
    "words": b"this is no image",
    "truncated": png(rooms())[:200],
}


@pytest.mark.parametrize("kind", BAD_IMAGES)
def test_a_bad_image_is_answered_in_one_sentence_and_loses_nothing(kind):
    app = upload(launch(BUILD), "Drawing", "rooms.png", png(rooms()))
    kept = own(app)
    app = upload(app, "Drawing", f"{kind}.png", BAD_IMAGES[kind])
    assert len(app.error) == 1
    assert own(app) is kept


BAD_TRAJECTORIES = {
    "words": b"x,y,theta_deg\n1,2,north\n",
    "nan": b"x,y,theta_deg\n1,nan,0\n",
    "two columns": b"x,y\n1,2\n",
    "no rows": b"x,y,theta_deg\n",
    "too long": b"x,y,theta_deg\n" + b"30,30,0\n" * 100_000,
}


@pytest.mark.parametrize("kind", BAD_TRAJECTORIES)
def test_a_bad_trajectory_is_answered_in_one_sentence_and_loses_nothing(kind):
    app = upload(
        launch(BUILD), "Trajectory", "bad.csv", BAD_TRAJECTORIES[kind], "text/csv"
    )
    assert len(app.error) == 1
    assert own(app) is None


def test_poses_in_walls_and_outside_are_counted_and_can_be_dropped():
    # Truth of sample a: (100, 100) is a room, (50, 150) its outer wall, -5 outside.
    rows = b"x,y,theta_deg\n100,100,0\n100,110,90\n50,150,0\n-5,20,0\n"
    app = launch(BUILD)
    app.selectbox(key=control(app, "choice")).select("a").run()
    app = upload(app, "Trajectory", "path.csv", rows, "text/csv")
    notice = "Of 4 poses, 1 outside the drawing and 1 in walls."
    assert app.warning[0].value == notice
    next(b for b in app.button if b.label == "Drop them").click().run()
    assert not app.warning
    assert len(own(app).trajectory) == 2


@pytest.mark.parametrize("page", PAGES)
def test_a_damaged_link_is_answered_with_one_sentence(page):
    app = AppTest.from_file(str(ROOT / "app.py"), default_timeout=60)
    if page != "app.py":
        app.switch_page(page)
    for name, value in {"cell_px": "abc", "drawing": "zz", "p_wall": "9"}.items():
        app.query_params[name] = value
    app.run()
    assert not app.exception
    (said,) = (item.value for item in app.warning if "link" in item.value)
    assert "drawing, cell_px, p_wall" in said


def test_a_drawing_without_walls_says_that_there_is_nothing_to_score():
    app = launch(BUILD)
    upload(app, "Drawing", "white.png", png(np.full((160, 220), 255, np.uint8)))
    assert "no wall to map" in app.info[0].value
    app.switch_page("pages/5_Sweep_the_priors.py").run()
    assert "No wall was found in the drawing and no" in app.warning[0].value
