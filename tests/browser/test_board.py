"""The drawing board in a real browser: what is drawn is what Python gets."""

import hashlib
import json
import time

import pytest
from playwright.sync_api import expect

from tests.browser.running import no_trouble, running_app

pytestmark = pytest.mark.browser

WAIT_SECONDS = 20
READY = ".board[data-ready='1']"


@pytest.fixture(scope="module")
def board_url(tmp_path_factory):
    """The address of a small app that holds nothing but a board."""
    log_path = tmp_path_factory.mktemp("board") / "server.log"
    with running_app(log_path, "tests/browser/board_app.py") as url:
        yield url
    no_trouble(log_path)


class Board:
    """A board on a page, with the hand of a person and the eyes of Python."""

    def __init__(self, page, url, mode="walls"):
        self.page = page
        page.goto(f"{url}/?mode={mode}")
        page.wait_for_selector(READY)
        self.root = page.locator(".board")

    def state(self):
        return self.root.evaluate("root => root.boardState()")

    def screen(self, x, y):
        """Where a point of the drawing is in the window."""
        camera = self.state()["camera"]
        box = self.root.locator("canvas").bounding_box()
        return (
            box["x"] + camera["x"] + x * camera["scale"],
            box["y"] + camera["y"] + y * camera["scale"],
        )

    def tool(self, name):
        self.root.locator(f"[data-tool={name}]").click()

    def act(self, name):
        self.root.locator(f"[data-act={name}]").click()

    def drag(self, *points, steps=4):
        mouse = self.page.mouse
        mouse.move(*self.screen(*points[0]))
        mouse.down()
        for point in points[1:]:
            mouse.move(*self.screen(*point), steps=steps)
        mouse.up()

    def click(self, x, y, **options):
        self.page.mouse.click(*self.screen(x, y), **options)

    def python(self):
        return json.loads(self.page.locator("[data-testid=stText]").inner_text())

    def until(self, condition):
        """What Python knows, once it fulfils a condition."""
        deadline = time.monotonic() + WAIT_SECONDS
        while not condition(facts := self.python()):
            assert time.monotonic() < deadline, facts
            self.page.wait_for_timeout(30)
        return facts

    def agrees(self):
        """Wait until Python's mask is the browser's, pixel by pixel."""
        pixels = bytes(int(flag) for flag in self.state()["mask"])
        digest = hashlib.sha1(pixels).hexdigest()
        return self.until(lambda facts: facts["mask"] == digest)


@pytest.fixture
def board(page, board_url):
    return Board(page, board_url)


def near(point, x, y, tolerance=0.75):
    return abs(point[0] - x) <= tolerance and abs(point[1] - y) <= tolerance


# --- Walls --------------------------------------------------------------------------


def test_stroke_is_in_python_pixel_by_pixel(board):
    empty = board.python()["mask"]
    board.drag((40, 40), (120, 70), (200, 30))
    facts = board.agrees()
    assert facts["mask"] != empty
    assert [row[0] for row in facts["strokes"]] == ["brush"]


def test_every_wall_tool_draws_what_python_gets(board):
    for name in ("line", "rectangle", "outline", "eraser", "clear"):
        board.tool(name)
        board.drag((60, 60), (170, 130))
    facts = board.agrees()
    kinds = ["line", "rectangle", "outline", "eraser", "clear"]
    assert [row[0] for row in facts["strokes"]] == kinds


def test_shift_keeps_a_straight_line_level(board):
    board.tool("line")
    board.page.keyboard.down("Shift")
    board.drag((60, 60), (170, 71))
    board.page.keyboard.up("Shift")
    (line,) = board.agrees()["strokes"]
    assert line[-1] == 0  # the last step down, in quarters of a pixel


def test_undo_and_redo_by_buttons_and_keys(board):
    empty = board.python()["mask"]
    board.drag((40, 40), (120, 70))
    board.drag((40, 180), (120, 200))
    two = board.agrees()
    board.act("undo")
    board.page.keyboard.press("Control+z")
    assert board.agrees()["mask"] == empty
    expect(board.root.locator("[data-act=undo]")).to_be_disabled()
    board.act("redo")
    board.root.locator("canvas").press("Control+Shift+z")
    assert board.agrees() == two


def test_new_stroke_forgets_what_was_undone(board):
    board.drag((40, 40), (120, 70))
    board.act("undo")
    board.drag((40, 180), (120, 200))
    board.until(lambda facts: facts["n_strokes"] == 1)
    expect(board.root.locator("[data-act=redo]")).to_be_disabled()


def test_stroke_lands_where_it_was_drawn_after_zoom_and_pan(board):
    before = board.state()["camera"]
    board.click(1, 1)  # the wheel belongs to the page until the board was touched
    board.page.mouse.move(*board.screen(300, 50))
    board.page.mouse.wheel(0, -400)
    expect(board.root.locator("[data-part=facts]")).not_to_contain_text(
        f"{round(100 * before['scale'])} %"
    )
    board.page.keyboard.down(" ")
    board.drag((300, 50), (290, 60))
    board.page.keyboard.up(" ")
    after = board.state()["camera"]
    assert after["scale"] > 1.5 * before["scale"]
    assert after["x"] != before["x"]
    board.drag((290, 50), (310, 60), (320, 50))
    stroke = board.until(lambda facts: facts["n_strokes"] == 2)["strokes"][-1]
    assert near([stroke[2] / 4, stroke[3] / 4], 290, 50)
    board.agrees()
    board.act("fit")
    assert board.state()["camera"]["scale"] == pytest.approx(before["scale"])


def test_width_slider_sets_the_width_of_the_stroke(board):
    board.root.locator("[data-part=width]").fill("21")
    board.drag((40, 40), (120, 70))
    (stroke,) = board.agrees()["strokes"]
    assert stroke[:2] == ["brush", 4 * 21]


def test_walls_can_be_drawn_with_the_keyboard_alone(board):
    canvas = board.root.locator("canvas")
    canvas.focus()
    for key in ["r", "Shift+ArrowLeft", "Enter", "Shift+ArrowRight", "Shift+ArrowDown"]:
        canvas.press(key)
    canvas.press("Enter")
    (stroke,) = board.agrees()["strokes"]
    # From ten left of the middle of 360 x 240 px, ten right and ten down.
    assert stroke == ["rectangle", 4, 4 * 170 + 2, 4 * 120 + 2, 40, 40]


def test_hundreds_of_quick_strokes_all_arrive_and_old_ones_are_folded(board):
    for i in range(300):
        x, y = 20 + (i * 37) % 320, 20 + (i * 53) % 200
        board.page.mouse.click(*_at(board, x, y))
    facts = board.until(lambda facts: facts["n_strokes"] == 300 and facts["first"] > 0)
    assert len(facts["strokes"]) < 300
    board.agrees()
    board.act("undo")
    board.until(lambda facts: facts["n_strokes"] == 299)
    board.agrees()


def _at(board, x, y):
    """As `Board.screen`, without asking the browser each time."""
    if not hasattr(board, "corner"):
        board.corner = board.screen(0, 0)
        board.scale = board.state()["camera"]["scale"]
    return board.corner[0] + x * board.scale, board.corner[1] + y * board.scale


# --- Leaving and coming back --------------------------------------------------------


def test_board_taken_off_the_screen_comes_back_with_its_strokes(board):
    board.drag((40, 40), (120, 70))
    board.drag((40, 180), (120, 200))
    drawn = board.agrees()
    board.page.get_by_text("Show").click()
    expect(board.root).to_have_count(0)
    board.page.get_by_text("Show").click()
    board.page.wait_for_selector(READY)
    board.until(lambda facts: facts["rev"] > drawn["rev"])
    assert board.state()["strokes"] == 2
    assert board.agrees()["mask"] == drawn["mask"]
    board.act("undo")
    board.until(lambda facts: facts["n_strokes"] == 1)
    board.agrees()


def test_document_imposed_by_python_replaces_what_was_drawn(board):
    empty = board.python()["mask"]
    board.drag((40, 40), (120, 70))
    board.agrees()
    board.page.get_by_role("button", name="Reset").click()
    board.until(lambda facts: facts["mask"] == empty)
    expect(board.root).to_have_attribute("data-strokes", "0")
    board.drag((40, 180), (120, 200))
    assert board.agrees()["n_strokes"] == 1


# --- Trajectory ---------------------------------------------------------------------


@pytest.fixture
def path(page, board_url):
    return Board(page, board_url, mode="trajectory")


def test_ten_quick_clicks_are_ten_waypoints_in_order(path):
    wanted = [(20 + 30 * i, 40 + 12 * (i % 3)) for i in range(10)]
    for x, y in wanted:
        path.page.mouse.click(*_at(path, x, y))
    points = path.until(lambda facts: len(facts["points"]) == 10)["points"]
    assert all(near(p, x, y) for p, (x, y) in zip(points, wanted, strict=True))
    assert all(is_waypoint for *_, is_waypoint in points)


def test_waypoints_are_moved_inserted_deleted_and_restored(path):
    for x in (40, 140, 240):
        path.click(x, 60)
    path.drag((140, 60), (140, 160))
    moved = path.until(
        lambda facts: len(facts["points"]) == 3 and near(facts["points"][1], 140, 160)
    )
    path.click(190, 110)  # on the segment from (140, 160) to (240, 60)
    inserted = path.until(lambda facts: len(facts["points"]) == 4)
    assert near(inserted["points"][2], 190, 110)
    path.click(40, 60, button="right")
    path.until(lambda facts: len(facts["points"]) == 3)
    path.click(240, 60)
    path.page.keyboard.press("Delete")
    path.until(lambda facts: len(facts["points"]) == 2)
    for _ in range(2):
        path.page.keyboard.press("Control+z")
    assert path.until(lambda facts: len(facts["points"]) == 4) == inserted
    path.page.keyboard.press("Control+z")
    assert path.until(lambda facts: len(facts["points"]) == 3) == moved


def test_free_hand_line_becomes_a_polyline_of_few_points(path):
    path.tool("freehand")
    path.drag((40, 40), (200, 40), (200, 90), steps=30)
    points = path.until(lambda facts: facts["points"])["points"]
    assert near(points[0], 40, 40)
    assert near(points[-1], 200, 90)
    assert any(near(point, 200, 40, tolerance=2) for point in points)
    assert len(points) < 12
    assert not any(is_waypoint for *_, is_waypoint in points)


def test_path_through_a_wall_is_said_to_run_through_it(path):
    path.click(60, 60)
    path.click(60, 160)  # the wall lies between, on rows 100 to 109
    expect(path.root.locator("[data-part=facts]")).to_contain_text("1 part in walls")


def test_points_outside_the_drawing_are_kept_inside_it(path):
    path.click(-3, 50)
    path.click(363, 50)
    points = path.until(lambda facts: len(facts["points"]) == 2)["points"]
    assert [p[0] for p in points] == [0, 359.75]


# --- Measure and crop ---------------------------------------------------------------


def test_two_clicks_measure_a_length(page, board_url):
    board = Board(page, board_url, mode="measure")
    board.click(50, 50)
    board.page.wait_for_timeout(200)
    assert board.python()["points"] == []
    board.click(90, 80)
    points = board.until(lambda facts: facts["points"])["points"]
    assert near(points[0], 50, 50)
    assert near(points[1], 90, 80)


def test_dragged_frame_is_two_corners_in_whole_pixels(page, board_url):
    board = Board(page, board_url, mode="crop")
    board.drag((200, 150), (50, 40))
    points = board.until(lambda facts: facts["points"])["points"]
    assert near(points[0], 200, 150, tolerance=1)
    assert near(points[1], 50, 40, tolerance=1)
    assert all(value == int(value) for x, y, _ in points for value in (x, y))
    board.drag((125, 95), (145, 105))  # inside: the frame moves as it is
    moved = board.until(lambda facts: facts["points"] != points)["points"]
    widths = {abs(a[0] - b[0]) for a, b in (points, moved)}
    assert len(widths) == 1


# --- Touch --------------------------------------------------------------------------


@pytest.fixture
def phone(chromium, board_url):
    context = chromium.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    page = context.new_page()
    yield lambda mode: Board(page, board_url, mode)
    context.close()


def touch(board, *fingers):
    """Move fingers, each along points of the drawing, all at once."""
    session = board.page.context.new_cdp_session(board.page)
    tracks = [[board.screen(*point) for point in finger] for finger in fingers]

    def send(kind, index):
        points = [
            {"x": track[index][0], "y": track[index][1], "id": number}
            for number, track in enumerate(tracks)
        ]
        session.send(
            "Input.dispatchTouchEvent",
            {"type": kind, "touchPoints": [] if kind == "touchEnd" else points},
        )

    send("touchStart", 0)
    for index in range(1, len(tracks[0])):
        send("touchMove", index)
    send("touchEnd", -1)


def test_finger_draws_walls_and_two_fingers_zoom(phone):
    board = phone("walls")
    touch(board, [(60, 60), (90, 70), (120, 60)])
    board.until(lambda facts: facts["n_strokes"] == 1)
    before = board.state()["camera"]["scale"]
    touch(
        board,
        [(160, 120), (140, 110), (120, 100)],
        [(200, 120), (220, 130), (240, 140)],
    )
    assert board.state()["camera"]["scale"] > 1.5 * before
    touch(board, [(170, 60), (180, 70), (185, 60)])
    assert board.until(lambda facts: facts["n_strokes"] == 2)
    board.agrees()


def test_taps_are_waypoints_and_a_long_press_deletes_one(phone):
    board = phone("trajectory")
    for x in (60, 160, 260):
        board.page.touchscreen.tap(*board.screen(x, 60))
    board.until(lambda facts: len(facts["points"]) == 3)
    session = board.page.context.new_cdp_session(board.page)
    x, y = board.screen(160, 60)
    finger = [{"x": x, "y": y, "id": 1}]
    session.send(
        "Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": finger}
    )
    points = board.until(lambda facts: len(facts["points"]) == 2)["points"]
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    assert [round(point[0]) for point in points] == [60, 260]


def test_tools_are_large_enough_for_a_thumb_and_nothing_scrolls_sideways(phone):
    board = phone("walls")
    for button in board.root.locator("button").all():
        box = button.bounding_box()
        assert box["width"] >= 44
        assert box["height"] >= 44
    assert board.page.evaluate(
        "document.documentElement.scrollWidth <= document.documentElement.clientWidth"
    )
