"""What is saved is what was seen: files are read back and compared with occsim."""

import json
import re
from collections import Counter
from io import BytesIO
from pathlib import Path
from urllib.parse import parse_qs, urlsplit
from xml.etree import ElementTree

import cv2
import numpy as np
import pytest
from PIL import Image, ImageSequence

from occsim import Prior, build_prior, fuse, load_sample
from pages._ui import palette
from tests.browser.players import (
    CELL_PX,
    ROOT,
    inspect,
    open_player,
    run,
    settled,
    shown,
)

pytestmark = pytest.mark.browser

SVG = "{http://www.w3.org/2000/svg}"
STEP = 60
RATIO = 2
MARGIN, GAP = 16, 16


def saved(page, label, root=ROOT):
    """The bytes and the name of what an item of the menu saves."""
    menu = page.locator(f"{root} .save")
    if menu.get_attribute("open") is None:
        menu.locator("summary").click()
    with page.expect_download(timeout=60_000) as coming:
        menu.get_by_role("button", name=label).click()
    coming.value.path()
    return Path(coming.value.path()).read_bytes(), coming.value.suggested_filename


def greys(step):
    """The map of drawing a at a step, as the page paints its cells."""
    evidence, wall_cells, _ = run()
    prior = build_prior(load_sample("a").world.occupied, evidence.grid, Prior())
    prior = type(prior)(prior.grid, wall_cells, np.where(wall_cells, 0.18, 0.81))
    made = fuse(evidence, prior, n_readings=step)
    return np.round(255 * made.p_free).astype(int), made.n_updates > 0


def map_place(picture):
    """Where the map begins in a GIF's frame: x, y, scale, from its border's lines."""
    sample = load_sample("a")
    height, width = sample.world.occupied.shape
    scale = min((960 - GAP - 2 * MARGIN) / 2 / width, 480 / height)
    x = MARGIN + round(width * scale) + GAP
    border = np.array(bytearray.fromhex(palette.UNSEEN[1:]))
    column = (picture[:, x + 20] == border).all(axis=1)
    return x, int(np.flatnonzero(column)[0]) + 1, round(width * scale) / width


def pixels_of(picture, cells, place):
    """The pixels of a picture at the middles of cells."""
    x, y, scale = place
    rows, cols = np.nonzero(cells)
    at = (np.stack([rows, cols]) + 0.5) * CELL_PX * scale
    return picture[(y + at[0]).astype(int), (x + at[1]).astype(int)]


def away_from_robot(step):
    """Cells that neither the robot nor its cone is drawn over, and no cut ones."""
    sample = load_sample("a")
    grid = run()[0].grid
    x, y, _ = sample.trajectory.poses[max(0, step - 1)]
    rows, cols = np.indices(grid.shape)
    far = np.hypot((cols + 0.5) * CELL_PX - x, (rows + 0.5) * CELL_PX - y)
    inside = (rows < grid.n_rows - 1) & (cols < grid.n_cols - 1)
    return (far > sample.sensor.range_px + 3 * CELL_PX) & inside


def test_a_figure_as_svg_has_its_words_its_settings_and_a_link(page, app_url):
    open_player(page, app_url, f"&step={STEP}&p_wall=0.35")
    data, name = saved(page, "SVG")
    assert name == f"occsim_build_a_map_reading_{STEP}.svg"
    root = ElementTree.fromstring(data)
    facts = json.loads(root.find(f"{SVG}metadata").text)
    assert root.find(f"{SVG}title").text == facts["title"] == "Build a map"
    assert facts["software"].startswith("occsim ")
    assert facts["settings"]["step"] == STEP
    assert facts["settings"]["columns"][0]["p_wall"] == 0.35
    query = parse_qs(urlsplit(facts["link"]).query)
    assert (query["step"], query["p_wall"]) == ([str(STEP)], ["0.35"])
    words = " ".join(text.text for text in root.iter(f"{SVG}text"))
    assert f"reading {STEP} of" in words
    assert "p_wall 0.35, p_space 0.9" in words
    assert len(list(root.iter(f"{SVG}image"))) == 2


def test_a_figure_says_what_the_drawing_gets_wrong(page, app_url):
    open_player(page, app_url, f"&step={STEP}&thickness_px=2&drawing_scale=1.05")
    data, _ = saved(page, "SVG")
    root = ElementTree.fromstring(data)
    words = " ".join(text.text for text in root.iter(f"{SVG}text"))
    assert "wall thickness 2 px, scale 1.05" in words
    assert "as found" not in words
    [own] = json.loads(root.find(f"{SVG}metadata").text)["settings"]["columns"]
    assert own["drawing_errors"] == "wall thickness 2 px, scale 1.05"
    assert "flaw" not in own


def test_a_figure_does_not_tell_what_an_exercise_hides(page, app_url):
    page.goto(f"{app_url}/Build_a_map?exercise=which_rule&step={STEP}")
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    data, _ = saved(page, "SVG")
    assert "prior_once" not in data.decode()
    assert "counted once" not in data.decode()


def test_the_link_in_a_figure_opens_what_the_figure_shows(page, app_url):
    player = open_player(page, app_url, f"&step={STEP}&overlay=errors")
    player.locator("[data-do=forward]").click()
    data, _ = saved(page, "SVG")
    before = inspect(player, "maps")
    facts = json.loads(ElementTree.fromstring(data).find(f"{SVG}metadata").text)
    page.goto(facts["link"])
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    player = page.locator(ROOT)
    assert shown(player, "step") == [STEP + 1]
    assert inspect(player, "maps") == before


def test_a_figure_as_png_has_the_colours_of_the_map_and_its_facts(page, app_url):
    open_player(page, app_url, f"&step={STEP}")
    place, _ = saved(page, "SVG")
    box = list(ElementTree.fromstring(place).iter(f"{SVG}image"))[1].attrib
    data, name = saved(page, "PNG")
    assert name.endswith(f"_reading_{STEP}.png")
    image = Image.open(BytesIO(data))
    assert image.text["Source"].startswith(app_url)
    assert json.loads(image.text["Description"])["n_readings"] == len(
        load_sample("a").trajectory
    )
    width = load_sample("a").world.occupied.shape[1]
    x, y, scale = (float(box[one]) for one in ("x", "y", "width"))
    at = (RATIO * x, RATIO * y, RATIO * scale / width)
    expected, seen = greys(STEP)
    cells = seen & away_from_robot(STEP)
    assert cells.sum() > 200
    found = pixels_of(np.asarray(image.convert("RGB")), cells, at)
    assert (found == expected[cells][:, None]).all()


def test_a_gif_begins_with_the_prior_and_ends_with_the_whole_map(page, app_url):
    player = open_player(page, app_url, f"&step={STEP}&speed=120")
    data, name = saved(page, "GIF")
    assert name == "occsim_build_a_map.gif"
    image = Image.open(BytesIO(data))
    frames = [frame.convert("RGB") for frame in ImageSequence.Iterator(image)]
    n = len(load_sample("a").trajectory)
    # Ten frames a second of a replay at 120 readings a second, and the last for 2 s.
    assert len(frames) == round(n / 120 * 10) + 1
    image.seek(0)
    shown_ms = [frame.info["duration"] for frame in ImageSequence.Iterator(image)]
    assert shown_ms == [100] * (len(frames) - 1) + [2000]
    first, last = np.asarray(frames[0]), np.asarray(frames[-1])
    expected, seen = greys(n)
    cells = seen & away_from_robot(n)
    found = pixels_of(last, cells, map_place(last))
    assert (found == expected[cells][:, None]).all()
    # Nothing has been looked at, so that all is hatched: most pixels are between lines.
    walls = run()[1]
    for cells, grey in [(walls, round(255 * 0.18)), (~walls, round(255 * 0.81))]:
        found = pixels_of(first, cells & away_from_robot(0), map_place(first))
        most = Counter(map(tuple, found.tolist())).most_common(1)[0][0]
        assert most == (grey, grey, grey)
    # The student is where the student was.
    assert shown(player, "step") == [STEP]
    assert json.loads(image.info["comment"])["settings"]["step"] == 0


def test_a_film_shows_the_whole_replay(page, app_url, tmp_path):
    open_player(page, app_url, "&speed=120")
    data, name = saved(page, "recorded as it plays")
    path = tmp_path / name
    path.write_bytes(data)
    film = cv2.VideoCapture(str(path))
    pictures = []
    while True:
        is_there, picture = film.read()
        if not is_there:
            break
        pictures.append(picture)
    film.release()
    # A busy machine draws fewer than the thirty frames a second that it may.
    assert len(pictures) > 10
    assert pictures[0].shape[1] > 900
    difference = np.abs(pictures[-1].astype(int) - pictures[0]).mean()
    assert difference > 2


@pytest.mark.parametrize(
    ("path", "n_images", "words"),
    [
        ("/Two_maps?drawing=c&step=50", 3, "Map B"),
        ("/Two_maps?drawing=c&columns=----u1", 4, "no drawing"),
        ("/?step=40", 3, "the drawing counted once"),
    ],
)
def test_several_maps_are_one_figure(page, app_url, path, n_images, words):
    page.goto(app_url + path)
    page.wait_for_selector(f"{ROOT}[data-ready='1']")
    data, _ = saved(page, "SVG")
    root = ElementTree.fromstring(data)
    assert len(list(root.iter(f"{SVG}image"))) == n_images
    assert words in " ".join(text.text for text in root.iter(f"{SVG}text"))


def test_the_lens_is_saved_with_the_numbers_of_the_cell(page, app_url):
    page.goto(f"{app_url}/What_the_sensor_says")
    page.wait_for_selector(".lens[data-ready='1']")
    data, name = saved(page, "SVG", ".lens")
    assert name == "occsim_what_the_sensor_says.svg"
    root = ElementTree.fromstring(data)
    cell = page.locator("[data-part=cell-name]").inner_text()
    row, column = re.findall(r"\d+", cell)
    words = " ".join(text.text for text in root.iter(f"{SVG}text"))
    assert f"cell {row}, {column}:" in words
    data, _ = saved(page, "PNG", ".lens")
    image = Image.open(BytesIO(data))
    assert "What_the_sensor_says" in image.text["Source"]
    found = {tuple(c) for c in np.asarray(image.convert("RGB")).reshape(-1, 3)}
    assert tuple(bytearray.fromhex(palette.READ_EMPTY[1:])) in found


def test_the_menu_is_used_with_the_keyboard_alone(page, app_url):
    player = open_player(page, app_url, f"&step={STEP}")
    page.locator(f"{ROOT} .save summary").focus()
    page.keyboard.press("Space")
    page.keyboard.press("Tab")
    with page.expect_download():
        page.keyboard.press("Enter")
    said = page.locator(f"{ROOT} .save [role=status]")
    said.get_by_text("Saved occsim_build_a_map").wait_for()
    page.keyboard.press("Escape")
    assert page.locator(f"{ROOT} .save").get_attribute("open") is None
    settled(page)
    # None of these keys was one of the player's.
    assert shown(player, "step") == [STEP]
    assert player.get_attribute("data-playing") in (None, "0")


def test_closing_the_menu_stops_a_recording(page, app_url):
    player = open_player(page, app_url, f"&step={STEP}&speed=5")
    page.locator(f"{ROOT} .save summary").click()
    page.locator(".save-menu").get_by_role("button", name="recorded").click()
    page.locator(".save-menu").get_by_text("1 of").wait_for()
    assert shown(player, "step") != [STEP]
    page.keyboard.press("Escape")
    # Long before the replay would be there by itself.
    player.and_(page.locator(f"[data-step='{STEP}']")).wait_for(timeout=3_000)
