"""Drawings c, d and e: sections (cut-outs) of larger buildings, 22 px to a metre.

A door leaf of 0.9 m is 20 px.
"""

from . import fittings as fit
from .plan import Plan, Style, along, perpendicular, strip, unit
from .sheet import HAIR

PX_PER_M = 20 / 0.9
UP, DOWN, LEFT, RIGHT = (0, -1), (0, 1), (-1, 0), (1, 0)


def plan_c() -> Plan:
    """Teaching wing: solid structure, hollow partitions, stairs, double doors."""
    plan = Plan(300, 240)
    sheet = plan.sheet
    for x, name in ((38, "1"), (152, "2"), (228, "3")):
        fit.axis(sheet, (x, 10), (x, 236), name)
    for y, name in ((30, "A"), (98, "B"), (142, "C"), (210, "D")):
        fit.axis(sheet, (12, y), (298, y), name)
    _stairs_c(sheet)
    _structure_c(plan)
    plan.render_structure()
    fit.dimensions(sheet, [38, 107.5, 178.5, 242, 299], 227, True, PX_PER_M, 6.0, 3.0)
    return plan


def _structure_c(plan: Plan):
    partitions = [
        (150, 30, 154, 98),
        (226, 30, 230, 98),
        (240, 142, 244, 210),
        (34, 96, 300, 100),
        (34, 140, 300, 144),
    ]
    structure = [
        (34, 26, 300, 34),
        (34, 206, 300, 214),
        (34, 26, 42, 214),
        (105, 140, 110, 214),
        (176, 140, 181, 214),
        (110, 140, 176, 144),
        (176, 96, 181, 102),
        (176, 138, 181, 144),
    ]
    columns = [
        (x - 5, y - 5, x + 5, y + 5) for x in (152, 228) for y in (35, 98, 142, 205)
    ]
    plan.walls(Style.HOLLOW, partitions)
    plan.walls(Style.SOLID, structure + [c for c in columns if c[0] > 147 or c[1] < 90])
    plan.double_door((86, 98), (126, 98), UP, 4)  # seminar room
    plan.double_door((123, 142), (163, 142), UP, 4)  # staircase
    plan.double_door((178.5, 102), (178.5, 138), RIGHT, 5)  # across the corridor
    plan.door((216, 98), (196, 98), UP, 4)
    plan.door((260, 98), (240, 98), UP, 4)
    plan.door((96, 142), (76, 142), DOWN, 4)
    plan.door((218, 142), (198, 142), DOWN, 4)
    plan.door((272, 142), (252, 142), DOWN, 4)
    plan.door((242, 172), (242, 192), LEFT, 4)
    for y in (30, 210):
        for x0, x1 in ((56, 88), (176, 212), (248, 284)):
            plan.window((x0, y), (x1, y), 8)
    plan.window((104, 30), (136, 30), 8)
    plan.window((130, 210), (156, 210), 8)
    plan.window((38, 108), (38, 132), 8)


def _stairs_c(sheet):
    """Dog-leg stairs, their landing at the facade."""
    top, bottom = 156, 156 + 6 * 5.6
    fit.flight(sheet, 147, top, 0, 28.5, 6, 5.6)
    fit.flight(sheet, 139, bottom, 180, 28.5, 6, 5.6, cut=4)
    sheet.rect(139, top, 147, bottom, HAIR, 255)
    sheet.line((143, top), (143, bottom), HAIR)


def plan_d() -> Plan:
    """Offices: nothing but solid walls and doors."""
    plan = Plan(300, 240)
    outer = [
        (20, 20, 280, 27),
        (20, 213, 280, 220),
        (20, 20, 27, 220),
        (273, 20, 280, 220),
    ]
    inner = [
        (27, 94, 273, 98),
        (27, 134, 194, 138),
        (226, 134, 273, 138),
        (96, 27, 100, 94),
        (188, 27, 192, 94),
        (118, 134, 122, 213),
        (190, 134, 194, 213),
        (226, 134, 230, 213),
    ]
    plan.walls(Style.SOLID, outer + inner)
    plan.door((23.5, 126), (23.5, 106), RIGHT, 7)
    plan.door((200, 216.5), (220, 216.5), UP, 7)
    plan.door((90, 96), (70, 96), UP, 4)
    plan.door((106, 96), (126, 96), UP, 4)
    plan.door((198, 96), (218, 96), UP, 4)
    plan.door((112, 136), (92, 136), DOWN, 4)
    plan.door((128, 136), (148, 136), DOWN, 4)
    plan.door((228, 164), (228, 144), RIGHT, 4)
    plan.door((190, 70), (190, 50), LEFT, 4)
    plan.render_structure()
    return plan


FACADE_E = (284.0, 22.0), (232.0, 216.0)  # axis of the oblique wall of drawing e


def facade_x(y: float) -> float:
    """Where the oblique facade's axis is at height `y`."""
    (x0, y0), (x1, y1) = FACADE_E
    return x0 + (x1 - x0) * (y - y0) / (y1 - y0)


def plan_e() -> Plan:
    """Wing's end: hatched facade at an angle, grey partitions, a door at 45 degrees."""
    plan = Plan(300, 240)
    _underlay_e(plan.sheet)
    _structure_e(plan)
    plan.render_structure()
    _annotation_e(plan.sheet)
    return plan


def _structure_e(plan: Plan):
    inner = [
        (0, 86, facade_x(88), 90),
        (0, 126, 144, 130),
        (206, 126, facade_x(128), 130),
        (84, 30, 88, 88),
        (152, 30, 156, 88),
        (92, 128, 96, 208),
        (140, 126, 144, 208),
        (172, 160, 176, 208),
    ]
    splay = (174.0, 160.5), (206.5, 128.0)
    plan.walls(Style.GREY, inner, [strip(*splay, 4)])
    facade = [(0, 26, facade_x(30), 34), (0, 204, facade_x(208), 212)]
    line = unit(*FACADE_E)
    half = 4 / line[1]  # of 8 px across the wall, measured level
    ends = [(26, -half), (26, half), (212, half), (212, -half)]
    oblique = [(facade_x(y) + side, y) for y, side in ends]
    plan.walls(Style.HATCHED, facade, [oblique])
    way = unit(*splay)
    hinge = along(splay[0], way, 13.0)
    plan.door(hinge, along(hinge, way, 20.0), perpendicular(way), 4)  # at an angle
    plan.door((78, 88), (58, 88), UP, 4)
    plan.door((110, 88), (130, 88), DOWN, 4)
    plan.door((162, 88), (182, 88), UP, 4)
    plan.door((86, 128), (66, 128), DOWN, 4)
    plan.door((142, 156), (142, 136), LEFT, 4)
    plan.door((148, 208), (168, 208), UP, 8)
    for x0, x1 in ((14, 54), (102, 138), (176, 208), (222, 252)):
        plan.window((x0, 30), (x1, 30), 8)
    for x0, x1 in ((22, 62), (110, 126), (190, 216)):
        plan.window((x0, 208), (x1, 208), 8)
    for start, end in ((30, 60), (76, 100), (126, 166)):
        first = along(FACADE_E[0], line, start)
        plan.window(first, along(FACADE_E[0], line, end), 8)


def _underlay_e(sheet):
    fit.flight(sheet, 94, 80, 270, 34, 8, 5.6, cut=5)
    sheet.tiles(96, 130, 140, 204, 5.6)
    fit.toilet(sheet, 104, 203, 180, 9)
    fit.basin(sheet, 97, 176, 270, 12, 8)
    sheet.rect(114, 160, 115, 204, HAIR)
    fit.axis(sheet, (86, 10), (86, 236), "7")
    fit.axis(sheet, (154, 10), (154, 236), "8")
    sheet.dashed((0, 108), (298, 108), (9, 2, 1.5, 2), HAIR)


def _annotation_e(sheet):
    fit.label(sheet, 42, 56, "2.01 OFFICE", 84 * 52 / PX_PER_M**2, 7.0)
    study_px = facade_x(60) - 4.1 - 156  # its mean width
    fit.label(sheet, 210, 58, "2.03 STUDY", study_px * 52 / PX_PER_M**2, 7.0)
    fit.label(sheet, 40, 172, "2.04 STORE", 92 * 74 / PX_PER_M**2, 7.0)
    fit.label(sheet, 206, 182, "2.06 OFFICE", None, 6.5)
    fit.label(sheet, 34, 116, "CORRIDOR", None, 7.0)
    fit.label(sheet, 220, 116, "2.05 LOBBY", None, 7.0)
    fit.label(sheet, 126, 166, "WC", None, 6.5)
    sheet.text(120, 38.5, "2.02 STAIR", 6.0)
    sheet.text(146, 61, "UP", 6.0)
    fit.dimensions(sheet, [2, 86, 154, 276], 227, True, PX_PER_M, 6.0, 3.0)
    sheet.polyline([(253, 152), (274, 168), (297, 168)], HAIR)
    sheet.text(285, 162, "FIXED", 6.0)
    sheet.text(285, 174, "GLASS", 6.0)
    sheet.polygon([(270, 204), (277, 204), (273.5, 210)], HAIR, 0)  # level mark
    sheet.line((270, 204), (296, 204), HAIR)
    sheet.text(286, 199, "+3.40", 6.0)
