"""What architects add to walls: stairs, furniture, dimensions, axes, titles."""

import numpy as np

from .sheet import BOLD, HAIR, MEDIUM, PAPER, THIN, Point, Sheet, arc_points, turned


class Frame:
    """A piece's own axes on a sheet: u to its right, v to its front, back at v = 0.

    `turn` is in degrees, clockwise on screen; unturned, the back is towards the top.
    """

    def __init__(self, sheet: Sheet, x: float, y: float, turn: float = 0.0):
        self.sheet, self.origin, self.turn = sheet, (x, y), turn

    def at(self, u: float, v: float) -> Point:
        """Place a point of the piece on the sheet."""
        return turned((u, v), self.turn, self.origin)

    def box(self, u0, v0, u1, v1, pen=THIN, fill=PAPER, radius=0.0):
        """Draw a rectangle, its corners rounded by `radius`."""
        corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
        if radius:
            centres = [
                (u0 + radius, v0 + radius, 180),
                (u1 - radius, v0 + radius, 270),
                (u1 - radius, v1 - radius, 0),
                (u0 + radius, v1 - radius, 90),
            ]
            arcs = [arc_points((u, v), radius, a, a + 90, 7) for u, v, a in centres]
            corners = [point for arc in arcs for point in arc]
        self.sheet.polygon([self.at(*c) for c in corners], pen, fill)

    def line(self, u0, v0, u1, v1, pen=THIN):
        """Draw a line."""
        self.sheet.line(self.at(u0, v0), self.at(u1, v1), pen)

    def circle(self, u, v, radius, pen=THIN):
        """Draw a circle."""
        self.sheet.circle(self.at(u, v), radius, pen, PAPER)

    def ellipse(self, u, v, ru, rv, pen=THIN):
        """Draw an ellipse."""
        self.sheet.ellipse(self.at(u, v), ru, rv, self.turn, pen)


def bed(sheet, x, y, turn, width, length):
    """Bed with pillows (two from a double's width on) and a turned-down cover."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, length)
    count = 2 if width > 0.65 * length else 1
    share = width / count
    for k in range(count):
        f.box(k * share + 3, 3, (k + 1) * share - 3, length * 0.19, HAIR, radius=2)
    f.line(0, length * 0.3, width, length * 0.3, HAIR)
    f.line(width, length * 0.3, width * 0.62, length * 0.48, HAIR)
    f.line(width * 0.62, length * 0.48, width * 0.62, length * 0.3, HAIR)


def nightstand(sheet, x, y, turn, side):
    """Small table with a lamp."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, side, side)
    f.circle(side / 2, side / 2, side / 4, HAIR)


def sofa(sheet, x, y, turn, width, depth, seats):
    """Sofa or armchair: back, arms and seats."""
    f = Frame(sheet, x, y, turn)
    edge = depth * 0.24
    f.box(0, 0, width, depth, radius=2)
    seat = (width - 2 * edge) / seats
    for k in range(seats):
        u = edge + k * seat
        f.box(u, edge, u + seat, depth, HAIR, radius=1.5)
    f.line(edge, edge, 0, edge, HAIR)
    f.line(width - edge, edge, width, edge, HAIR)


def chair(sheet, x, y, turn, side):
    """Chair: seat and back rest."""
    f = Frame(sheet, x, y, turn)
    f.box(0, side * 0.12, side, side, HAIR, radius=1.5)
    f.box(0, 0, side, side * 0.2, HAIR)


def dining_table(sheet, x, y, width, depth, side, columns):
    """Table with `columns` chairs at each long side and one at each end."""
    gap = width / columns
    for k in range(columns):
        u = x + (k + 0.5) * gap
        chair(sheet, u - side / 2, y - side * 0.75, 0, side)
        chair(sheet, u + side / 2, y + depth + side * 0.75, 180, side)
    chair(sheet, x - side * 0.75, y + depth / 2 + side / 2, 270, side)
    chair(sheet, x + width + side * 0.75, y + depth / 2 - side / 2, 90, side)
    sheet.rect(x, y, x + width, y + depth, THIN, PAPER)


def wardrobe(sheet, x, y, turn, width, depth, hangers=True):
    """Wardrobe: sliding doors, rail and hangers, or crossed if it is built in."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth)
    if not hangers:
        f.line(0, 0, width, depth, HAIR)
        f.line(0, depth, width, 0, HAIR)
        return
    f.line(0, depth / 2, width, depth / 2, HAIR)
    for u in np.arange(5, width - 2, 5.5):
        lean = 1.2 * ((int(u) % 3) - 1)
        f.line(u - lean, depth * 0.18, u + lean, depth * 0.82, HAIR)


def desk(sheet, x, y, turn, width, depth):
    """Desk with a screen, and its chair in front."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth)
    f.box(width * 0.32, depth * 0.15, width * 0.68, depth * 0.35, HAIR)
    side = depth * 0.75
    seat = f.at(width / 2 + side / 2, depth * 1.75)
    chair(sheet, *seat, turn + 180, side)


def toilet(sheet, x, y, turn, width):
    """Water closet: cistern and bowl."""
    f = Frame(sheet, x, y, turn)
    f.ellipse(width / 2, width * 0.95, width * 0.42, width * 0.58)
    f.ellipse(width / 2, width * 1.0, width * 0.27, width * 0.38, HAIR)
    f.box(0, 0, width, width * 0.42)


def basin(sheet, x, y, turn, width, depth):
    """Wash basin with its tap."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth, radius=2)
    f.ellipse(width / 2, depth * 0.55, width * 0.36, depth * 0.3, HAIR)
    f.circle(width / 2, depth * 0.18, 0.9, HAIR)


def bath(sheet, x, y, turn, width, depth):
    """Bath tub, drain at its right."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth)
    f.box(3, 3, width - 3, depth - 3, HAIR, radius=depth * 0.3)
    f.circle(width - 9, depth / 2, 1.4, HAIR)


def shower(sheet, x, y, side_u, side_v):
    """Shower tray with its falls and drain."""
    sheet.rect(x, y, x + side_u, y + side_v, THIN, PAPER)
    sheet.line((x, y), (x + side_u, y + side_v), HAIR)
    sheet.line((x, y + side_v), (x + side_u, y), HAIR)
    sheet.circle((x + side_u / 2, y + side_v / 2), 2, HAIR, PAPER)


def sink(sheet, x, y, turn, width, depth):
    """Kitchen sink: bowl and ribbed drainer."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth, HAIR, radius=1.5)
    f.box(2, 2, width * 0.5, depth - 2, HAIR, radius=2)
    for v in np.linspace(4, depth - 4, 4):
        f.line(width * 0.58, v, width - 2.5, v, HAIR)


def hob(sheet, x, y, turn, width, depth):
    """Four rings."""
    f = Frame(sheet, x, y, turn)
    f.box(0, 0, width, depth, HAIR)
    for u in (0.28, 0.72):
        for v in (0.28, 0.72):
            f.circle(width * u, depth * v, depth * 0.17, HAIR)


def appliance(sheet, x, y, width, depth, mark):
    """Box with a letter (refrigerator, washing machine), or crossed without one."""
    sheet.rect(x, y, x + width, y + depth, THIN, PAPER)
    sheet.text(x + width / 2, y + depth / 2, mark, 6.5)


def plant(sheet, x, y, radius):
    """Pot plant."""
    for angle in range(0, 360, 40):
        leaf = turned((radius, 0), angle, (x, y))
        sheet.ellipse(
            ((x + leaf[0]) / 2, (y + leaf[1]) / 2), radius / 2, radius / 5, angle, HAIR
        )
    sheet.circle((x, y), radius * 0.25, HAIR, PAPER)


def flight(sheet, x, y, turn, width, treads, going, cut=None):
    """Flight of stairs going up along +v; with `cut`, broken after that many treads."""
    f = Frame(sheet, x, y, turn)
    length = treads * going
    shown = treads if cut is None else cut
    f.line(0, 0, 0, shown * going)
    f.line(width, 0, width, shown * going)
    for k in range(shown + (cut is None)):
        f.line(0, k * going, width, k * going)
    reach = length if cut is None else (shown - 1.2) * going
    f.circle(width / 2, going * 0.5, 1.3, HAIR)
    f.line(width / 2, going * 0.5, width / 2, reach - 1, HAIR)
    for side in (-1, 1):
        f.line(width / 2, reach - 1, width / 2 + side * 2.6, reach - 5.5)
    if cut is not None:
        _break_line(f, width, shown * going, going)
        _hidden_treads(f, width, shown, treads, going)


def _break_line(f: Frame, width, at, going):
    """Two slanting zigzags where the section plane cuts a flight."""
    for shift in (0.0, going * 0.45):
        path = [
            (-3, at + going * 0.7 + shift),
            (width * 0.42, at + shift),
            (width * 0.46, at - going * 0.5 + shift),
            (width * 0.54, at + going * 0.45 + shift),
            (width * 0.58, at - going * 0.1 + shift),
            (width + 3, at - going * 0.8 + shift),
        ]
        f.sheet.polyline([f.at(*p) for p in path], HAIR)


def _hidden_treads(f: Frame, width, shown, treads, going):
    """Treads above the section plane, dashed."""
    for k in range(shown + 2, treads + 1):
        f.sheet.dashed(f.at(0, k * going), f.at(width, k * going), (2.5, 2.0))


def dimensions(sheet, marks, offset, horizontal, px_per_m, height=6.5, reach=4.0):
    """Chain of dimensions at x or y = `marks`, its line at y or x = `offset`.

    Figures are in metres with two decimals, above the line (or left of it).
    """

    def spot(along, across):
        return (along, across) if horizontal else (across, along)

    sheet.line(spot(marks[0] - 4, offset), spot(marks[-1] + 4, offset), HAIR)
    for mark in marks:
        sheet.line(spot(mark, offset - reach), spot(mark, offset + reach), HAIR)
        slash = (mark - 2.2, mark + 2.2), (mark + 2.2, mark - 2.2)
        (ax, bx) = slash[0]
        sheet.line(spot(ax, offset + 2.2), spot(bx, offset - 2.2), MEDIUM)
    for start, end in zip(marks[:-1], marks[1:], strict=True):
        words = f"{(end - start) / px_per_m:.2f}"
        middle = spot((start + end) / 2, offset - height * 0.75)
        sheet.text(*middle, words, height, 0 if horizontal else 90)


def axis(sheet, start: Point, end: Point, name, radius=6.5):
    """Grid axis: dash-dotted line with a bubble at its start."""
    sheet.dashed(start, end, (9.0, 2.0, 1.5, 2.0), HAIR)
    sheet.circle(start, radius, THIN, PAPER)
    sheet.text(*start, name, 7.5)


def label(sheet, x, y, words, area=None, height=8.0, halo=1.5):
    """Room name and, below it, its floor area."""
    if area is None:
        sheet.text(x, y, words, height, halo=halo)
        return
    sheet.text(x, y - height * 0.65, words, height, halo=halo)
    small = height * 0.85
    sheet.text(x, y + height * 0.65, f"{area:.1f} m", small, halo=halo)
    right = x + (len(f"{area:.1f} m") * 0.29 + 0.12) * small  # the square's figure
    sheet.text(right, y + height * 0.42, "2", small * 0.62)


def north(sheet, x, y, radius, turn=0.0):
    """North arrow."""
    sheet.circle((x, y), radius, THIN, PAPER)
    tip = turned((0, -radius * 1.3), turn, (x, y))
    left = turned((-radius * 0.5, radius * 0.7), turn, (x, y))
    right = turned((radius * 0.5, radius * 0.7), turn, (x, y))
    sheet.polygon([tip, left, (x, y)], HAIR, PAPER)
    sheet.polygon([tip, right, (x, y)], HAIR, 0)
    top = turned((0, -radius * 1.3 - 5), turn, (x, y))
    sheet.text(*top, "N", 7)


def scale_bar(sheet, x, y, px_per_m, metres):
    """Bar of alternate black and white metres."""
    for k in range(metres):
        left = x + k * px_per_m
        sheet.rect(left, y, left + px_per_m, y + 3, HAIR, 0 if k % 2 == 0 else PAPER)
    for k in range(metres + 1):
        sheet.text(x + k * px_per_m, y - 5, str(k), 6)
    sheet.text(x + metres * px_per_m + 8, y - 5, "m", 6)


def title(sheet, x, y, words, height=9.0):
    """Underlined title, centred on (x, y)."""
    sheet.text(x, y, words, height)
    half = len(words) * height * 0.31
    sheet.line((x - half, y + height * 0.75), (x + half, y + height * 0.75), BOLD * 0.7)
