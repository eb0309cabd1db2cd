"""The drawing board in a real browser: Python receives what is drawn."""

import hashlib
import json
import math
import random
import threading
import time

import pytest
from playwright.sync_api import expect

from tests.browser.running import no_complaint, running_app

pytestmark = pytest.mark.browser

WAIT_SECONDS = 20
READY = ".board[data-ready='1']"


@pytest.fixture(scope="module")
def board_url(tmp_path_factory):
    """The address of a small app with a board and nothing else."""
    log_path = tmp_path_factory.mktemp("board") / "server.log"
    with running_app(log_path, "tests/browser/board_app.py") as url:
        yield url
    no_complaint(log_path)


class Board:
    """A board on a page: input by mouse and keyboard, and the state in Python."""

    def __init__(self, page, url, mode="walls", size="small"):
        self.page = page
        page.goto(f"{url}/?mode={mode}&size={size}")
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
        """Python's state, once it fulfils a condition."""
        deadline = time.monotonic() + WAIT_SECONDS
        while not condition(facts := self.python()):
            assert time.monotonic() < deadline, facts
            self.page.wait_for_timeout(30)
        return facts

    def steps(self, n):
        """Wait until so many strokes can be undone."""
        expect(self.root).to_have_attribute("data-steps", str(n))

    def agrees(self):
        """Wait until Python's mask is the browser's, pixel by pixel."""
        pixels = bytes(int(flag) for flag in self.state()["mask"])
        digest = hashlib.sha1(pixels).hexdigest()
        return self.until(lambda facts: facts["mask"] == digest)


@pytest.fixture
def board(page, board_url):
    return Board(page, board_url)


@pytest.fixture
def doubtful(page, board_url):
    """A board with two doubtful pieces: 400 px of the wall, and 600 px beside it."""
    return Board(page, board_url, size="small&doubtful=1")


def near(point, x, y, tolerance=0.75):
    return abs(point[0] - x) <= tolerance and abs(point[1] - y) <= tolerance


# --- Walls --------------------------------------------------------------------------


def test_stroke_is_in_python_pixel_by_pixel(board):
    empty = board.python()["mask"]
    board.drag((40, 40), (120, 70), (200, 30))
    facts = board.agrees()
    assert facts["mask"] != empty
    assert facts["added"] > 0
    assert facts["erased"] == 0
    # A brush of 8 px from (40, 40) over (120, 70) to (200, 30).
    assert facts["box"] == pytest.approx([26, 74, 36, 204], abs=2)
    board.steps(1)


@pytest.mark.parametrize(
    ("tool", "added", "erased"),
    [
        # 110 x 70 px from corner to corner; lines of 4 px, an eraser of 12 px.
        ("line", 4 * 130.4, 0),
        ("rectangle", 110 * 70, 0),
        ("outline", 2 * 4 * (110 + 70), 0),
        ("eraser", 0, 12 * 130.4 + 36 * math.pi),
        ("clear", 0, 110 * 70),
    ],
)
def test_every_wall_tool_covers_what_it_should(board, tool, added, erased):
    board.tool(tool)
    board.drag((60, 60), (170, 130))
    facts = board.agrees()
    assert facts["added"] == pytest.approx(added, rel=0.05)
    assert facts["erased"] == pytest.approx(erased, rel=0.05)


def test_the_last_of_strokes_over_each_other_holds(board):
    for name in ("line", "rectangle", "outline", "eraser", "clear"):
        board.tool(name)
        board.drag((60, 60), (170, 130))
    board.steps(5)
    facts = board.agrees()
    # The cleared rectangle leaves the outer half of the outline's walls of 4 px; the
    # eraser removed a part of the corners.
    assert 0 < facts["added"] < 2 * 2 * (110 + 70 + 4)
    assert facts["erased"] > 110 * 70


def left(board, n):
    """Wait until so many doubtful pieces are open."""
    expect(board.root).to_have_attribute("data-doubtful", str(n))


def test_one_click_accepts_or_removes_a_doubtful_piece(doubtful):
    left(doubtful, 2)
    doubtful.tool("accept")
    doubtful.click(230, 145)
    left(doubtful, 1)
    assert doubtful.agrees()["added"] == 600
    doubtful.tool("reject")
    doubtful.click(40, 105)
    left(doubtful, 0)
    facts = doubtful.agrees()
    assert (facts["added"], facts["erased"]) == (600, 400)
    doubtful.steps(2)
    doubtful.act("undo")
    left(doubtful, 1)
    assert doubtful.until(lambda facts: not facts["erased"])["added"] == 600


@pytest.mark.parametrize(
    ("act", "added", "erased"), [("accept-all", 1000, 0), ("reject-all", 0, 1000)]
)
def test_all_doubtful_pieces_are_decided_in_one_step(doubtful, act, added, erased):
    doubtful.act(act)
    left(doubtful, 0)
    facts = doubtful.agrees()
    assert (facts["added"], facts["erased"]) == (added, erased)
    doubtful.steps(1)
    expect(doubtful.root.locator(f"[data-act={act}]")).to_be_disabled()
    doubtful.act("undo")
    left(doubtful, 2)


def test_doubtful_pieces_are_decided_by_the_keyboard_alone(doubtful):
    """N goes to the piece of the wall first, then to the one below it."""
    doubtful.root.locator("canvas").focus()
    for key in ("a", "n", "Enter", "d", "n", "Enter"):
        doubtful.page.keyboard.press(key)
    left(doubtful, 0)
    # The mask stays as it was: its piece is wall, and the other is not.
    doubtful.until(lambda facts: (facts["added"], facts["erased"]) == (400, 600))


def test_a_click_beside_all_pieces_decides_nothing(doubtful):
    doubtful.tool("accept")
    doubtful.click(300, 200)
    doubtful.steps(0)
    left(doubtful, 2)


def test_without_doubtful_pieces_nothing_offers_to_decide_them(board):
    for name in ("[data-tool=accept]", "[data-tool=reject]", "[data-act=next-piece]"):
        expect(board.root.locator(name)).to_have_count(0)


def test_shift_keeps_a_straight_line_level(board):
    board.tool("line")
    board.page.keyboard.down("Shift")
    board.drag((60, 60), (170, 71))
    board.page.keyboard.up("Shift")
    top, bottom, left, right = board.agrees()["box"]
    assert bottom - top == 4  # the width of a line
    assert right - left == pytest.approx(110 + 4, abs=2)


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
    again = board.agrees()
    assert [again[name] for name in ("mask", "added", "erased")] == [
        two[name] for name in ("mask", "added", "erased")
    ]


def test_each_stroke_is_undone_by_itself_where_they_cross(board):
    masks = [board.python()["mask"]]
    for tool in ("rectangle", "clear", "outline", "eraser"):
        board.tool(tool)
        board.drag((60, 60), (170, 130))
        masks.append(board.agrees()["mask"])
    assert len(set(masks)) == 5
    for before in reversed(masks[:-1]):
        board.act("undo")
        assert board.agrees()["mask"] == before
    for after in masks[1:]:
        board.act("redo")
        assert board.agrees()["mask"] == after


def test_a_stroke_that_changes_nothing_is_no_step(board):
    board.tool("rectangle")
    for _ in range(2):
        board.drag((60, 60), (170, 130))
    board.steps(1)


def test_new_stroke_forgets_what_was_undone(board):
    board.drag((40, 40), (120, 70))
    board.act("undo")
    board.drag((40, 180), (120, 200))
    board.agrees()
    board.steps(1)
    expect(board.root.locator("[data-act=redo]")).to_be_disabled()


def test_stroke_lands_where_it_was_drawn_after_zoom_and_pan(board):
    before = board.state()["camera"]
    board.click(1, 1)  # the wheel scrolls the page until the board was clicked
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
    board.steps(2)
    board.act("undo")
    board.root.locator("[data-act=undo]").click()  # the click at the start, too
    assert board.agrees()["box"] is None
    board.drag((290, 50), (310, 60), (320, 50))
    # A brush of 8 px.
    assert board.agrees()["box"] == pytest.approx([46, 64, 286, 324], abs=1.5)
    board.act("fit")
    assert board.state()["camera"]["scale"] == pytest.approx(before["scale"])


def test_width_slider_sets_the_width_of_the_stroke(board):
    board.root.locator("[data-part=width]").fill("21")
    board.drag((40, 40), (120, 70))
    added = board.agrees()["added"]
    length = math.dist((40, 40), (120, 70))
    assert added == pytest.approx(21 * length + math.pi * 10.5**2, rel=0.03)


def test_walls_can_be_drawn_with_the_keyboard_alone(board):
    canvas = board.root.locator("canvas")
    canvas.focus()
    for key in ["r", "Shift+ArrowLeft", "Enter", "Shift+ArrowRight", "Shift+ArrowDown"]:
        canvas.press(key)
    canvas.press("Enter")
    facts = board.agrees()
    # From ten left of the middle of 360 x 240 px, ten right and ten down.
    assert facts["box"] == [120, 130, 170, 180]
    assert facts["added"] == 100


def test_letters_choose_tools_and_do_not_reach_the_page(board):
    """Streamlit has keys of its own: c clears its cache, r runs the script again."""
    canvas = board.root.locator("canvas")
    canvas.focus()
    for key, tool in (("c", "clear"), ("r", "rectangle"), ("E", "eraser")):
        canvas.press(key)
        chosen = board.root.locator("[data-tool][aria-pressed=true]")
        expect(chosen).to_have_attribute("data-tool", tool)
    canvas.press("F2")  # no key of the board
    expect(chosen).to_have_attribute("data-tool", "eraser")
    expect(board.page.get_by_role("dialog")).to_have_count(0)


def test_hundreds_of_quick_strokes_all_arrive(board):
    dots = [(20 + 16 * (i % 20), 10 + 15 * (i // 20)) for i in range(300)]
    for x, y in dots:
        board.page.mouse.click(*_at(board, x, y))
    board.steps(300)
    before = board.agrees()["mask"]
    for _ in range(2):
        board.act("undo")
    board.steps(298)
    assert board.agrees()["mask"] != before
    board.act("redo")
    board.act("redo")
    assert board.agrees()["mask"] == before


def curves(n, seed=4):
    """Short curves on 1500 x 1000 px, as in tracing walls by hand."""
    rng = random.Random(seed)
    for _ in range(n):
        x, y, angle = rng.uniform(60, 1440), rng.uniform(60, 940), rng.uniform(0, 6.3)
        points = []
        for _ in range(4):
            angle += rng.gauss(0, 0.3)
            x, y = x + 25 * math.cos(angle), y + 25 * math.sin(angle)
            points.append((min(max(x, 2), 1498), min(max(y, 2), 998)))
        yield points


# All in one turn of the page, so that few of the commits on the way are sent: by the
# mouse 250 strokes last a minute.
DRAW = """(canvas, strokes) => {
    const tell = (name, [clientX, clientY]) => canvas.dispatchEvent(
        new PointerEvent(name, { pointerId: 1, clientX, clientY, bubbles: true }));
    for (const points of strokes) {
        tell("pointerdown", points[0]);
        points.slice(1).forEach((point) => tell("pointermove", point));
        tell("pointerup", points.at(-1));
    }
}"""


@pytest.mark.parametrize(("n", "limit_kb"), [(10, 2.5), (250, 45)])
def test_a_commit_of_a_large_drawing_is_small(page, board_url, n, limit_kb):
    board = Board(page, board_url, size="large")
    strokes = [[_at(board, *point) for point in points] for points in curves(n)]
    board.root.locator("canvas").evaluate(DRAW, strokes)
    board.steps(n)
    facts = board.agrees()
    print(f"{n} strokes: a commit of {facts['commit_bytes'] / 1000:.1f} kB")
    assert facts["commit_bytes"] < 1000 * limit_kb


def test_the_next_commit_replaces_a_lost_one(page, board_url):
    lost, is_open = [], threading.Event()

    def relay(socket):
        server = socket.connect_to_server()
        socket.on_message(
            lambda message: (server.send if is_open.is_set() else lost.append)(message)
        )

    is_open.set()
    page.route_web_socket("**/_stcore/stream", relay)
    board = Board(page, board_url)
    empty = board.python()["mask"]
    is_open.clear()
    board.drag((40, 40), (120, 70))
    board.steps(1)
    page.wait_for_timeout(500)
    assert lost
    assert board.python()["mask"] == empty
    is_open.set()
    board.drag((40, 180), (120, 200))
    assert board.agrees()["box"] == pytest.approx([36, 204, 36, 124], abs=2)


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
    board.steps(2)
    assert board.agrees()["mask"] == drawn["mask"]
    board.act("undo")
    board.steps(1)
    # Only the upper of the two is left.
    assert board.agrees()["box"] == pytest.approx([36, 74, 36, 124], abs=2)


def test_document_imposed_by_python_replaces_what_was_drawn(board):
    empty = board.python()["mask"]
    board.drag((40, 40), (120, 70))
    board.agrees()
    board.page.get_by_role("button", name="Reset").click()
    board.until(lambda facts: facts["mask"] == empty)
    board.steps(0)
    board.drag((40, 180), (120, 200))
    assert board.agrees()["box"] == pytest.approx([176, 204, 36, 124], abs=2)


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
    path.root.locator("canvas").press("f")
    path.drag((40, 40), (200, 40), (200, 90), steps=30)
    points = path.until(lambda facts: facts["points"])["points"]
    assert near(points[0], 40, 40)
    assert near(points[-1], 200, 90)
    assert any(near(point, 200, 40, tolerance=2) for point in points)
    assert len(points) < 12
    assert not any(is_waypoint for *_, is_waypoint in points)


def test_a_path_through_a_wall_is_reported(path):
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
    board.steps(1)
    before = board.state()["camera"]["scale"]
    touch(
        board,
        [(160, 120), (140, 110), (120, 100)],
        [(200, 120), (220, 130), (240, 140)],
    )
    assert board.state()["camera"]["scale"] > 1.5 * before
    touch(board, [(170, 60), (180, 70), (185, 60)])
    board.steps(2)
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
