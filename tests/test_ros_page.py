"""Maps of ROS on the pages: in as drawing, ground truth or prior, and out."""

import numpy as np
import pytest

from occsim import Prior
from occsim.io.replay import unpack_walls
from occsim.io.ros_map import (
    MapMode,
    RosMap,
    building_from_map,
    dump,
    load_files,
    map_drawing,
    pack,
)
from pages._ui import compute, replays
from pages._ui.choices import Flaw, PriorDrawing
from pages._ui.columns import Column
from pages._ui.robot_data import files, ros
from pages._ui.settings import Settings
from tests.test_pages import launch, own, said
from tests.test_ros_packing import zipped

PAGE = "pages/4_Robot_data.py"
YOURS = "pages/2_Your_building.py"


def values(height=120, width=160):
    """Two rooms with a door between them, in unknown surroundings."""
    made = np.full((height, width), -1)
    made[10:110, 10:150] = 0
    made[10:110, [10, 11, 80, 81, 148, 149]] = 100
    made[[10, 11, 108, 109], 10:150] = 100
    made[50:70, 80:82] = 0
    return made


MAP = RosMap(values(), 0.05, (1.0, 2.0, 0.0))


def opened(page=PAGE):
    app = launch(page)
    if page == PAGE:
        app.session_state["view_robot_section"] = "A ROS map"
        app.session_state["views"] = {"robot_section": "A ROS map"}
        app.run()
    return app


def give(app, *given):
    uploader = next(x for x in app.get("file_uploader") if x.label == "ROS map")
    uploader.set_value([(name, data, "application/zip") for name, data in given])
    app.run()
    assert not app.exception
    return app


def click(app, label):
    next(b for b in app.button if b.label == label).click().run()
    assert not app.exception
    return app


def two_files(ros_map=MAP, mode=MapMode.RAW):
    yaml, image = dump(ros_map, mode=mode)
    return ("map.yaml", yaml), ("map.pgm", image)


@pytest.mark.parametrize("page", [PAGE, YOURS])
def test_a_map_becomes_a_building_with_its_own_walls_and_scale(page):
    app = click(give(opened(page), *two_files()), "Use as drawing")
    assert not app.error
    assert own(app).metres_per_px == pytest.approx(0.05)
    np.testing.assert_array_equal(own(app).wall_mask, MAP.is_occupied)
    # The tour keeps to what is known to be free.
    x, y = own(app).trajectory.poses[:, :2].T.astype(int)
    assert (MAP.values[y, x] == 0).all()


def lying(app):
    """Where the page says that the maps of the open building lie."""
    (text,) = (one for one in said(app.markdown) if "lower left corner lies at" in one)
    return text.partition(" lies at ")[2]


def test_maps_of_a_building_lie_where_its_robots_map_lay():
    """As robots' programs need them: on one goes by the same coordinates."""
    app = opened()
    at_home = "x = 0 m, y = 0 m, turned by 0 rad."
    assert lying(app) == at_home
    away = RosMap(values(), 0.05, (-10.0, 2.5, 0.5))
    app = click(give(app, *two_files(away)), "Use as drawing")
    assert lying(app) == "x = −10 m, y = 2.5 m, turned by 0.5 rad."
    # Another building, of another map, lies elsewhere.
    app.session_state.choice = "b"
    app.run()
    assert lying(app) == at_home


def test_what_is_unknown_is_said():
    app = give(opened(), ("map.zip", pack(MAP, mode=MapMode.RAW)))
    (text,) = (one for one in said(app.caption) if "unknown (grey)" in one)
    share = 100 * (values() == -1).mean()
    assert f"unknown (grey) {share:.1f} %" in text
    assert "160 × 120 px of 0.05 m" in text


def test_a_level_of_unknown_that_the_file_calls_free_can_be_kept_unknown():
    yaml, image = dump(MAP)
    newer = yaml.replace(b"free_thresh: 0.196", b"free_thresh: 0.25")
    app = give(opened(), ("map.yaml", newer), ("map.pgm", image))
    assert any("unknown (grey) 0.0 %" in text for text in said(app.caption))
    app.toggle(key="view_ros_keep_unknown").set_value(True).run()
    share = 100 * (values() == -1).mean()
    assert any(f"unknown (grey) {share:.1f} %" in text for text in said(app.caption))


def test_a_map_of_the_drawings_size_is_its_ground_truth_or_its_walls():
    app = click(give(opened(), *two_files()), "Use as drawing")
    thicker = values()
    thicker[10:110, 76:86] = 100
    other = RosMap(thicker, 0.05)
    app = click(give(app, *two_files(other)), "Use as ground truth")
    np.testing.assert_array_equal(own(app).truth, other.is_occupied)
    np.testing.assert_array_equal(own(app).wall_mask, MAP.is_occupied)
    app = click(app, "Use as prior")
    np.testing.assert_array_equal(own(app).wall_mask, other.is_occupied)


def shown_drawn(building, columns):
    """Wall cells and unknown cells as the player gets them, by column."""
    parts = replays.replay_of(building, Settings(cell_px=1), columns).parts
    return [unpack_walls(part.data) for part in parts if part.kind == "walls"]


def test_what_a_map_does_not_know_stays_unknown_on_every_page():
    app = click(give(opened(), *two_files()), "Use as drawing")
    building = own(app)
    mirrored = Column(cell_px=1, prior_drawing=PriorDrawing.MIRRORED)
    thin = Column(cell_px=1, flaw=Flaw.THIN_1)
    drawn = shown_drawn(building, [Column(cell_px=1), mirrored, thin])
    unknown = [MAP.is_unknown, MAP.is_unknown[:, ::-1], MAP.is_unknown]
    for (is_wall, is_unknown), expected in zip(drawn, unknown, strict=True):
        np.testing.assert_array_equal(is_unknown, expected & ~is_wall)
    run = compute.run(building, Settings(cell_px=1))
    prior_map = run.prior_map(Prior())
    np.testing.assert_array_equal(prior_map.p_free == 0.5, MAP.is_unknown)
    for page in (YOURS, "pages/3_Two_maps.py", "pages/5_Sweep_the_priors.py"):
        app.switch_page(page).run()
        assert not app.exception


def test_a_map_as_prior_brings_its_unknown_and_it_can_be_forgotten():
    app = click(give(opened(), *two_files()), "Use as drawing")
    known = np.where(values() == -1, 0, values())
    known[20:60, 20:60] = -1
    app = click(give(app, *two_files(RosMap(known, 0.05))), "Use as prior")
    np.testing.assert_array_equal(own(app).unknown, known == -1)
    app.session_state["views"] = {"section": "4 Corrections"}
    app.switch_page(YOURS).run()
    share = f"{100 * (known == -1).mean():.1f} %"
    assert any(f"unknown in {share}" in text for text in said(app.caption))
    app = click(app, "Take unknown for free space")
    assert own(app).unknown is None
    assert not any("is unknown in" in text for text in said(app.caption))
    click(app, "Undo")
    np.testing.assert_array_equal(own(app).unknown, known == -1)


def test_a_map_of_another_size_is_refused_in_a_sentence():
    app = click(give(opened(), *two_files()), "Use as ground truth")
    (message,) = said(app.error)
    assert "must have the drawing's size" in message
    assert own(app) is None


def test_one_file_of_the_two_is_answered_with_what_is_missing():
    app = give(opened(), two_files()[0])
    assert "needs one image" in said(app.error)[0]
    app = give(app, *two_files())
    assert not app.error


def test_of_a_zip_of_several_maps_one_is_chosen():
    other = RosMap(values()[:60, :80], 0.1)
    entries = {}
    for name, one in (("upper", MAP), ("lower", other)):
        yaml, image = dump(one, name, mode=MapMode.RAW)
        entries |= {f"{name}.yaml": yaml, f"{name}.pgm": image}
    app = give(opened(), ("floors.zip", zipped(**entries)))
    assert not app.error
    assert any(t.startswith("lower.yaml: 80 × 60 px of 0.1") for t in said(app.caption))
    choice = next(box for box in app.selectbox if box.label == "One of 2 maps")
    assert choice.options == ["lower.yaml", "upper.yaml"]
    choice.set_value("upper.yaml").run()
    assert any(t.startswith("upper.yaml: 160 × 120") for t in said(app.caption))
    app = click(app, "Use as drawing")
    np.testing.assert_array_equal(own(app).wall_mask, MAP.is_occupied)
    app = give(app, *two_files())
    assert not [box for box in app.selectbox if box.label == "One of 2 maps"]


def test_our_own_map_and_prior_can_be_downloaded():
    app = opened()
    labels = [x.label for x in app.get("download_button")]
    assert {"Map: percentages (zip)", "Prior: trinary (zip)"} <= set(labels)


@pytest.mark.parametrize("mode", list(files.MODES.values()))
def test_what_is_downloaded_is_a_map(mode):
    again = load_files({"map.zip": files.zipped(MAP, "map", mode)})
    np.testing.assert_array_equal(again.values, MAP.values)


def test_a_large_map_is_scaled_down_with_its_metres():
    building = building_from_map(MAP, working_px=80)
    assert building.drawing.shape == (60, 80)
    assert building.metres_per_px == pytest.approx(0.1)


def test_a_map_is_drawn_as_map_server_does():
    grey = map_drawing(RosMap([[100, 0, -1, 50]], 0.05)).gray
    assert grey.tolist() == [[0, 254, 205, 127]]
    assert ros.UNKNOWN_BELOW == 0.196
