"""Wall detection on kinds of drawing that people bring, each made by its own test."""

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont

from occsim.imaging import Drawing
from occsim.samples import load_sample
from occsim.walls import ScaleSource, compare_masks, detect_walls, propose_scale

Pair = tuple[np.ndarray, np.ndarray]
"""A drawing (H, W, 3) uint8 and its true walls (H, W) bool."""

LEAST_F1 = 0.95

DOORS_PX = {"a": 40.0, "b": 40.0, "c": 20.0, "d": 20.0, "e": 20.0}
"""Leaves of the sample drawings, as their list in the package says."""


def boxes(shape: tuple[int, int], *corners: tuple[int, int, int, int]) -> np.ndarray:
    """Rectangles from (x0, y0) up to (x1, y1), (H, W) bool."""
    mask = np.zeros(shape, bool)
    for x0, y0, x1, y1 in corners:
        mask[y0:y1, x0:x1] = True
    return mask


def ring(x0: int, y0: int, x1: int, y1: int, px: int) -> list[tuple[int, ...]]:
    """The four walls of a rectangular house."""
    sides = [(x0, y0, x1, y0 + px), (x0, y1 - px, x1, y1)]
    return sides + [(x0, y0, x0 + px, y1), (x1 - px, y0, x1, y1)]


def base(px: int = 8, inner_px: int | None = None) -> np.ndarray:
    """A house of four rooms on 600 x 400 px with doorways of 40 px, (400, 600) bool."""
    half = (inner_px or px) // 2
    wall = boxes((400, 600), *ring(60, 60, 540, 340, px))
    rest = (inner_px or px) - half
    wall |= boxes(
        (400, 600), (300 - half, 60, 300 + rest, 340), (60, 200 - half, 540, 200 + rest)
    )
    for door in ((110, 150), (250, 290)):
        wall[slice(*door), 300 - half : 300 + rest] = False
    for door in ((160, 200), (400, 440)):
        wall[200 - half : 200 + rest, slice(*door)] = False
    return wall


def black_on(wall: np.ndarray, paper=(255, 255, 255), ink=(0, 0, 0)) -> np.ndarray:
    return np.where(wall[..., None], ink, paper).astype(np.uint8)


def faces(wall: np.ndarray, px: int = 1) -> np.ndarray:
    """Lines along the faces of walls, inside them."""
    kernel = np.ones((2 * px + 1, 2 * px + 1), np.uint8)
    return wall & (cv2.erode(wall.astype(np.uint8), kernel) == 0)


def hollow_house(px: int = 16) -> np.ndarray:
    """A larger house on 1000 x 760 px, its walls and doorways, bool."""
    wall = boxes((760, 1000), *ring(120, 120, 880, 640, px))
    wall |= boxes((760, 1000), (480, 120, 480 + px, 640), (120, 380, 880, 380 + px))
    wall |= boxes((760, 1000), (680, 120, 680 + px, 380))
    for y in (200, 480):
        wall[y : y + 60, 480 : 480 + px] = False
    for x in (250, 560, 760):
        wall[380 : 380 + px, x : x + 60] = False
    return wall


# --- Fills and watermarks -------------------------------------------------------------


def filled_rooms(colour: tuple[int, int, int]) -> Pair:
    wall = base()
    sheet = black_on(wall)
    sheet[68:196, 68:296] = colour
    sheet[204:332, 304:532] = colour
    sheet[wall] = 0
    return sheet, wall


def all_rooms_filled(colour: tuple[int, int, int]) -> Pair:
    wall = base()
    sheet = black_on(wall)
    sheet[60:340, 60:540] = colour
    sheet[wall] = 0
    return sheet, wall


def departments() -> Pair:
    """Every room of another colour, some of them dark."""
    wall = base()
    sheet = black_on(wall)
    sheet[60:200, 60:300] = 90, 140, 220
    sheet[60:200, 300:540] = 220, 110, 90
    sheet[200:340, 60:300] = 120, 190, 110
    sheet[200:340, 300:540] = 250, 230, 120
    sheet[wall] = 0
    return sheet, wall


def watermark(text_level: int) -> Pair:
    wall = base()
    sheet = black_on(wall)
    level = (text_level,) * 3
    cv2.putText(sheet, "AGENCY", (70, 260), cv2.FONT_HERSHEY_SIMPLEX, 3.6, level, 14)
    sheet[wall] = 0
    return sheet, wall


def watermark_box() -> Pair:
    wall = base()
    sheet = black_on(wall)
    sheet[120:280, 180:420] = 252, 246, 160
    sheet[wall] = 0
    return sheet, wall


# --- Papers ---------------------------------------------------------------------------


def on_paper(paper: tuple[int, int, int], ink=(0, 0, 0)) -> Pair:
    wall = base()
    return black_on(wall, paper, ink), wall


def half_grey() -> Pair:
    """Black walls; most of the sheet is grey paper, a strip of it white."""
    wall = base()
    sheet = black_on(wall, (90, 90, 90))
    sheet[370:] = 255
    return sheet, wall


# --- Houses that do not hang together -------------------------------------------------


def wing(with_windows: bool) -> Pair:
    """A house and a wing beside it; its windows are one-pixel outlines."""
    shape = 400, 640
    house = [(60, 60, 300, 67), (60, 333, 300, 340), (60, 60, 67, 340)]
    house += [(293, 60, 300, 150), (293, 200, 300, 340), (180, 60, 187, 150)]
    house += [(180, 200, 187, 340), (60, 200, 140, 207)]
    house += [(330, 60, 520, 67), (512, 60, 519, 300), (330, 293, 520, 300)]
    wall = boxes(shape, *house)
    sheet = black_on(wall)
    if with_windows:
        for x0, y0, x1, y1 in (
            (390, 60, 440, 68),
            (512, 150, 520, 200),
            (390, 293, 440, 301),
        ):
            sheet[y0:y1, x0:x1] = 255
            wall[y0:y1, x0:x1] = False
            cv2.rectangle(sheet, (x0, y0), (x1 - 1, y1 - 1), (0, 0, 0), 1)
    return sheet, wall


def joined_by_windows() -> Pair:
    """Two blocks whose only link are windows."""
    wall = boxes((400, 640), *ring(40, 60, 260, 340, 8), *ring(340, 60, 600, 340, 8))
    sheet = black_on(wall)
    for y in (100, 220):
        cv2.rectangle(sheet, (260, y), (339, y + 8), (0, 0, 0), 1)
    return sheet, wall


def free_core(width_px: int, height_px: int) -> Pair:
    """A core standing free inside a ring with rooms every 100 px."""
    shape = 700, 900
    wall = boxes(shape, *ring(40, 40, 860, 660, 6))
    for x in range(140, 860, 100):
        wall |= boxes(shape, (x, 40, x + 6, 140), (x, 560, x + 6, 660))
    x0, y0 = 450 - width_px // 2, 350 - height_px // 2
    wall |= boxes(shape, *ring(x0, y0, x0 + width_px, y0 + height_px, 6))
    return black_on(wall), wall


def two_storeys() -> Pair:
    """A storey with walls of 16 px beside a smaller one with walls of 5 px."""
    wall = boxes((460, 800), *ring(40, 40, 440, 380, 16), (230, 40, 246, 250))
    wall |= boxes((460, 800), *ring(500, 80, 750, 330, 5), (620, 80, 625, 260))
    return black_on(wall), wall


# --- Thickness ------------------------------------------------------------------------


def polygon() -> Pair:
    """A house with twelve corners, walls of 5 px and nothing thinner."""
    angle = np.arange(12) * np.pi / 6 + 0.1
    corners = np.stack([300 + 220 * np.cos(angle), 250 + 220 * np.sin(angle)], 1)
    wall = np.zeros((500, 600), np.uint8)
    cv2.polylines(wall, [corners.astype(np.int32)], True, 1, 5)
    return black_on(wall > 0), wall > 0


def thin_partitions(with_text: bool) -> Pair:
    wall = base(10, 3)
    sheet = black_on(wall)
    if with_text:
        for place in ((100, 120), (360, 150), (120, 280), (380, 300)):
            font = cv2.FONT_HERSHEY_PLAIN
            cv2.putText(sheet, "Room 1.02", place, font, 0.9, (0, 0, 0), 1)
    return sheet, wall


# --- Hollow, hatched and filled walls -------------------------------------------------


def hatched(pitch_px: int, wall: np.ndarray) -> Pair:
    rows, cols = np.indices(wall.shape)
    lines = faces(wall) | (wall & ((rows + cols) % pitch_px == 0))
    return black_on(lines), wall


def filled_between_lines(fill: int) -> Pair:
    """Walls of 34 px between lines of 2 px, on 900 x 675 px."""
    wall = boxes((675, 900), *ring(80, 80, 820, 600, 34))
    wall |= boxes((675, 900), (430, 80, 464, 600))
    wall[280:370, 430:464] = False
    sheet = black_on(wall, ink=(fill,) * 3)
    sheet[faces(wall, 2)] = 0
    return sheet, wall


def pale_base(fill: int) -> Pair:
    wall = base(12)
    sheet = black_on(wall, ink=(fill,) * 3)
    sheet[faces(wall, 2)] = 0
    return sheet, wall


def dimensioned(gap_px: int) -> Pair:
    """Hollow walls of 16 px and two dimension lines above them."""
    wall = hollow_house()
    sheet = black_on(faces(wall))
    for y in (60, 60 + gap_px):
        cv2.line(sheet, (120, y), (879, y), (0, 0, 0), 1)
        for x in (120, 480, 680, 879):
            cv2.line(sheet, (x, y - 5), (x, y + 5), (0, 0, 0), 1)
    return sheet, wall


def eaves(gap_px: int) -> Pair:
    """Hollow walls of 16 px and the edge of the roof outside them."""
    wall = hollow_house()
    sheet = black_on(faces(wall))
    low, high = (120 - gap_px, 120 - gap_px), (879 + gap_px, 639 + gap_px)
    cv2.rectangle(sheet, low, high, (0, 0, 0), 1)
    return sheet, wall


CAD_LINE_PX, CAD_WALL_PX, FLAT_PX = 3, 13, 540
"""Lines, walls and flats of `cad_floor` at its full size, px."""


def cad_walls() -> np.ndarray:
    """Flats on both sides of a corridor, (1400, 3000) bool."""
    shape, px = (1400, 3000), CAD_WALL_PX
    wall = boxes(shape, *ring(150, 150, 2850, 1250, px))
    for y in (600, 780):
        wall |= boxes(shape, (150, y, 2850, y + px))
    for x in range(690, 2800, FLAT_PX):
        wall |= boxes(shape, (x, 150, x + px, 600 + px), (x, 780, x + px, 1250))
    for x in range(230, 2800, FLAT_PX):
        for y in (600, 780):
            wall[y : y + px, x : x + 100] = False
    return wall


def draw_flat(sheet: np.ndarray, left: int) -> None:
    """An axis in the wall, cupboards that touch it, a kitchen, tiles, a bed, words."""
    middle, line = left + FLAT_PX + CAD_WALL_PX // 2, CAD_LINE_PX
    for y in range(170, 580, 44):
        cv2.line(sheet, (middle, y), (middle, y + 26), 1, 2)
    for k in range(3):
        x = left + 200 + 110 * k
        cv2.rectangle(sheet, (x, 520), (x + 100, 596), 1, line)
        cv2.rectangle(sheet, (x + 8, 575), (x + 92, 598), 1, cv2.FILLED)
    for k in range(0, 281, 28):
        cv2.line(sheet, (left + 200, 840 + k), (left + 480, 840 + k), 1, 2)
        cv2.line(sheet, (left + 200 + k, 840), (left + 200 + k, 1120), 1, 2)
    cv2.rectangle(sheet, (left + 60, 200), (left + 240, 400), 1, line)
    font = cv2.FONT_HERSHEY_SIMPLEX
    for k in range(4):
        place = left + 280, 260 + 40 * k
        cv2.putText(sheet, f"{left + k} - {left + 9}", place, font, 1.2, 1, line)


def cad_floor(factor: float) -> Pair:
    """A drafted floor reduced by a factor."""
    wall = cad_walls()
    sheet = faces(wall, CAD_LINE_PX).astype(np.uint8)
    for left in range(150, 2800, FLAT_PX):
        draw_flat(sheet, left)
    return reduced(black_on(sheet > 0), wall, factor)


def reduced(sheet: np.ndarray, wall: np.ndarray, factor: float) -> Pair:
    """A drawing and its walls at a smaller size."""
    size = round(sheet.shape[1] * factor), round(sheet.shape[0] * factor)
    area = cv2.INTER_AREA
    true = cv2.resize(wall.astype(np.uint8) * 255, size, interpolation=area)
    return cv2.resize(sheet, size, interpolation=area), true > 127


def framed(px: int) -> Pair:
    """A house on a sheet with a thick frame."""
    wall = base()
    return black_on(wall | boxes(wall.shape, *ring(12, 12, 588, 388, px))), wall


def headed(upright: bool) -> Pair:
    """A house with a heading whose strokes are as thick as its walls."""
    wall = base()
    sheet = black_on(wall)
    turns = int(upright)
    image = Image.fromarray(np.rot90(sheet, turns))
    # Pillow's own font: that of OpenCV's putText is another in each of its releases.
    font = ImageFont.load_default(44)
    ImageDraw.Draw(image).text(
        (20, 4), "FIRST FLOOR 12", (0, 0, 0), font, stroke_width=2
    )
    return np.rot90(np.asarray(image), -turns), wall


def in_a_large_frame() -> Pair:
    """A small house on a large sheet, whose frame is more ink than the house."""
    wall = np.zeros((1400, 1600), bool)
    wall[500:900, 500:1100] = base(6)
    return black_on(wall | boxes(wall.shape, *ring(12, 12, 1588, 1388, 6))), wall


KINDS: dict[str, Callable[[], Pair]] = {
    "two rooms filled orange": lambda: filled_rooms((255, 200, 60)),
    "two rooms filled cream": lambda: filled_rooms((248, 226, 165)),
    "all rooms filled orange": lambda: all_rooms_filled((255, 200, 60)),
    "all rooms filled grey": lambda: all_rooms_filled((190, 190, 190)),
    "rooms in department colours": departments,
    "pale watermark": lambda: watermark(205),
    "darker watermark": lambda: watermark(160),
    "watermark on a yellow box": watermark_box,
    "grey paper 68": lambda: on_paper((68, 68, 68)),
    "grey paper 110": lambda: on_paper((110, 110, 110)),
    "dark blue paper": lambda: on_paper((20, 30, 90)),
    "white on black": lambda: on_paper((0, 0, 0), (255, 255, 255)),
    "white on blue": lambda: on_paper((30, 60, 140), (255, 255, 255)),
    "red ink": lambda: on_paper((255, 255, 255), (200, 30, 30)),
    "pale grey walls": lambda: on_paper((255, 255, 255), (190, 190, 190)),
    "mostly grey sheet": half_grey,
    "frame as thick as walls": lambda: framed(8),
    "thinner frame": lambda: framed(5),
    "small house in a large frame": in_a_large_frame,
    "bold heading": lambda: headed(False),
    "bold heading along a side": lambda: headed(True),
    "house and wing": lambda: wing(False),
    "wing with windows": lambda: wing(True),
    "joined by windows": joined_by_windows,
    "small free core": lambda: free_core(100, 120),
    "large free core": lambda: free_core(200, 200),
    "two storeys": two_storeys,
    "polygon": polygon,
    "thin partitions": lambda: thin_partitions(False),
    "thin partitions and text": lambda: thin_partitions(True),
    "hatched 12": lambda: hatched(12, hollow_house()),
    "hatched 15": lambda: hatched(15, hollow_house()),
    "hatched 18": lambda: hatched(18, hollow_house()),
    "hatched 12, thin": lambda: hatched(12, base()),
    "hatched 18, thin": lambda: hatched(18, base()),
    "filled 230": lambda: filled_between_lines(230),
    "filled 215": lambda: filled_between_lines(215),
    "pale base": lambda: pale_base(230),
    "dimension lines 14": lambda: dimensioned(14),
    "dimension lines 16": lambda: dimensioned(16),
    "dimension lines 18": lambda: dimensioned(18),
    "eaves 14": lambda: eaves(14),
    "eaves 16": lambda: eaves(16),
    "eaves 18": lambda: eaves(18),
}


@pytest.mark.parametrize("kind", KINDS)
def test_walls_of_every_kind_of_drawing_are_found(kind):
    sheet, truth = KINDS[kind]()
    found = detect_walls(Drawing(rgb=sheet)).mask
    assert compare_masks(found, truth).f1 >= LEAST_F1


@pytest.mark.parametrize("factor", [0.5, 0.75, 2.0, 3.0])
@pytest.mark.parametrize("kind", ["two rooms filled cream", "hatched 15", "eaves 16"])
def test_another_resolution_gives_the_same_walls(kind, factor):
    """F1 at the tolerance of 2 px changes by less than 0.03, as at any size."""
    sheet, truth = KINDS[kind]()
    size = round(sheet.shape[1] * factor), round(sheet.shape[0] * factor)
    how = cv2.INTER_AREA if factor < 1 else cv2.INTER_CUBIC
    scaled = cv2.resize(sheet, size, interpolation=how)
    true = cv2.resize(truth.astype(np.uint8) * 255, size, interpolation=cv2.INTER_AREA)
    found = detect_walls(Drawing(rgb=scaled)).mask
    assert compare_masks(found, true > 127).f1 >= 0.97


def test_hollow_walls_at_another_angle_are_found():
    """Three of them, each 14 px thick, at 60 degrees in a house of upright ones."""
    along = 110 * np.array([1.0, np.sqrt(3.0)])
    oblique = np.zeros((760, 1000), np.uint8)
    for x in (150, 220, 290):
        end = x + int(along[0]), 404 + int(along[1])
        cv2.line(oblique, (x, 404), end, 1, 14)
    upright = hollow_house()
    lines = faces(upright | (oblique > 0))
    found = detect_walls(Drawing(rgb=black_on(lines))).mask
    assert found[(oblique > 0) & ~upright].mean() > 0.95


@pytest.mark.parametrize("factor", [0.33, 0.37, 0.42, 0.5, 0.62])
def test_hollow_walls_with_axes_and_kitchens_are_found_at_any_size(factor):
    """Recall asked of a drafted floor; its lines are 1 to 2 px thick here."""
    sheet, truth = cad_floor(factor)
    compared = compare_masks(detect_walls(Drawing(rgb=sheet)).mask, truth)
    assert compared.recall >= 0.97
    assert compared.f1 >= 0.9


def test_a_large_sheet_takes_little_memory_and_its_pictures_are_small():
    """The working copy has 1.5 megapixels, whatever the sheet."""
    wall = np.kron(base(), np.ones((8, 8), bool))
    detection = detect_walls(Drawing(rgb=black_on(wall)))
    assert compare_masks(detection.mask, wall, tolerance_px=8).f1 >= 0.99
    for _, image in detection.stages:
        assert image.size <= 1_510_000


def test_certainty_is_high_for_plain_walls_and_none_for_an_empty_sheet():
    plain = detect_walls(Drawing(rgb=black_on(base())))
    assert plain.certainty.confidence >= 0.95
    assert plain.certainty.wall_px == pytest.approx(8.0, abs=0.5)
    assert not plain.doubtful.any()
    empty = detect_walls(Drawing(rgb=black_on(np.zeros((300, 400), bool))))
    assert empty.certainty.confidence == 0.0
    assert "No walls were found." in empty.certainty.notes


def test_dropped_pieces_are_doubtful():
    """Two dimension lines are as far apart as the faces of the walls."""
    sheet, _ = dimensioned(16)
    detection = detect_walls(Drawing(rgb=sheet))
    assert detection.certainty.dropped >= 1
    assert detection.doubtful[62:74, 200:800].mean() > 0.9


def test_a_house_without_doors_is_no_frame():
    """It reaches to the borders, but holds less wall than it is itself."""
    wall = boxes((400, 600), *ring(12, 12, 588, 388, 8), (250, 150, 350, 158))
    found = detect_walls(Drawing(rgb=black_on(wall))).mask
    assert compare_masks(found, wall).recall >= 0.99


def test_a_row_of_piers_is_no_word():
    piers = [(80 + 40 * k, 20, 100 + 40 * k, 50) for k in range(10)]
    wall = base() | boxes((400, 600), *piers)
    found = detect_walls(Drawing(rgb=black_on(wall))).mask
    assert compare_masks(found, wall).recall >= 0.99


def test_scale_is_proposed_from_doorways():
    """The doorways are 40 px wide; no leaf is drawn."""
    proposal = propose_scale(Drawing(rgb=black_on(base())))
    assert proposal.source is ScaleSource.DOORWAYS
    assert proposal.door_px == pytest.approx(40.0, abs=1.0)
    assert proposal.count >= 3


def test_scale_is_proposed_from_the_walls_where_there_is_no_door():
    wall = boxes((300, 400), *ring(40, 40, 360, 260, 10))
    proposal = propose_scale(Drawing(rgb=black_on(wall)))
    assert proposal.source is ScaleSource.WALL_THICKNESS
    assert proposal.door_px == pytest.approx(40.0, abs=4.0)
    assert proposal.confidence < 0.5


def test_no_scale_is_proposed_for_an_empty_sheet():
    assert propose_scale(Drawing(rgb=black_on(np.zeros((200, 300), bool)))) is None


@pytest.mark.parametrize("name", list("abcde"))
def test_scale_of_the_samples_is_read_from_their_doors(name):
    """Leaves are drawn from the middle of the hinge: a px or two less than the door."""
    proposal = propose_scale(load_sample(name).drawing)
    assert proposal.source is ScaleSource.DOOR_LEAVES
    assert proposal.door_px == pytest.approx(DOORS_PX[name], rel=0.1)
