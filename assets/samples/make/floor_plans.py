"""Drawings a and b: whole floors of small dwellings at about 1:50 (44 px to a metre).

A door leaf of 0.9 m is 40 px.
"""

from . import fittings as fit
from .plan import Plan, Style
from .sheet import HAIR, MEDIUM, THIN

PX_PER_M = 40 / 0.9
UP, DOWN, LEFT, RIGHT = (0, -1), (0, 1), (-1, 0), (1, 0)


def area(width_px: float, height_px: float) -> float:
    """Floor area in square metres."""
    return width_px * height_px / PX_PER_M**2


def plan_a() -> Plan:
    """House, ground floor: solid walls of 8, 5 and 4 px, labels, stairs, built-ins."""
    plan = Plan(460, 350)
    _fixtures_a(plan.sheet)
    _structure_a(plan)
    plan.render_structure()
    _annotation_a(plan.sheet)
    return plan


def _structure_a(plan: Plan):
    outer = [
        (46, 40, 438, 48),
        (46, 302, 438, 310),
        (46, 40, 54, 310),
        (430, 40, 438, 310),
    ]
    bearing = [(204, 48, 209, 302), (209 + 62, 154, 430, 159), (271, 154, 276, 302)]
    partitions = [(54, 196, 204, 200), (338, 48, 342, 154)]
    chimney = [(54, 112, 68, 142)]
    plan.walls(Style.SOLID, outer + bearing + partitions + chimney)
    plan.door((219, 306), (259, 306), UP, 8)  # entrance
    plan.double_door((206.5, 92), (206.5, 152), LEFT, 5)  # living room
    plan.door((206.5, 206), (206.5, 246), LEFT, 5)  # kitchen
    plan.door((273.5, 208), (273.5, 168), RIGHT, 5)  # bedroom
    plan.door((340, 145), (340, 105), RIGHT, 4)  # bathroom
    plan.door((146, 198), (186, 198), UP, 4)  # kitchen to living room
    for start, end in (
        ((94, 44), (166, 44)),
        ((238, 44), (288, 44)),
        ((50, 60), (50, 100)),
        ((50, 152), (50, 186)),
        ((98, 306), (158, 306)),
        ((310, 306), (376, 306)),
        ((434, 92), (434, 120)),
    ):
        plan.window(start, end, 8)


def _fixtures_a(sheet):
    sheet.tiles(342, 48, 430, 154, 11)
    fit.flight(sheet, 332, 49, 90, 41, 11, 11.0, cut=7)
    fit.bath(sheet, 346, 49, 0, 80, 33)
    fit.basin(sheet, 429, 92, 90, 26, 18)
    fit.toilet(sheet, 427, 128, 90, 17)
    sheet.rect(54, 276, 204, 302)  # worktop
    sheet.rect(54, 216, 80, 302)
    sheet.line((54, 276), (80, 302), HAIR)
    fit.sink(sheet, 104, 280, 0, 40, 18)
    fit.hob(sheet, 76, 224, 90, 30, 20)
    fit.appliance(sheet, 178, 277, 26, 25, "F")
    fit.wardrobe(sheet, 430, 160, 90, 70, 26, hangers=False)
    fit.wardrobe(sheet, 430, 230, 90, 71, 26, hangers=False)
    sheet.rect(54, 104, 74, 150, HAIR)  # hearth
    for step in (0, 11):  # steps before the entrance
        sheet.rect(212 - step / 2, 310, 266 + step / 2, 318 + step * 0.7, HAIR)


def _annotation_a(sheet):
    fit.label(sheet, 128, 78, "LIVING ROOM", area(150, 148))
    fit.label(sheet, 132, 246, "KITCHEN", area(150, 102))
    fit.label(sheet, 348, 236, "BEDROOM", area(154, 143))
    fit.label(sheet, 388, 114, "BATH", area(88, 106), 7.5)
    fit.label(sheet, 254, 122, "HALL", area(129, 106))
    sheet.text(320, 97, "UP", 6.5)
    fit.dimensions(sheet, [46, 206.5, 340, 438], 18, True, PX_PER_M)
    fit.dimensions(sheet, [40, 198, 310], 20, False, PX_PER_M)
    fit.title(sheet, 110, 334, "GROUND FLOOR  1:50")
    fit.scale_bar(sheet, 290, 338, PX_PER_M, 2)
    fit.north(sheet, 430, 333, 8, 15)
    sheet.dashed((4, 180), (456, 180), (12, 3, 2, 3), HAIR, 90)  # section A-A
    for x in (8, 452):
        sheet.text(x, 171, "A", 8)


def plan_b() -> Plan:
    """Flat: hollow walls of 8 and 5 px, suggested furniture, tiled floors."""
    plan = Plan(460, 350)
    _furniture_b(plan.sheet)
    _structure_b(plan)
    plan.render_structure()
    _annotation_b(plan.sheet)
    return plan


def _structure_b(plan: Plan):
    outer = [
        (24, 22, 436, 30),
        (24, 302, 436, 310),
        (24, 22, 32, 310),
        (428, 22, 436, 310),
    ]
    inner = [
        (32, 112, 224, 117),
        (222, 30, 227, 302),
        (275, 30, 280, 302),
        (280, 162, 428, 167),
        (150, 30, 155, 112),
        (227, 244, 275, 249),
    ]
    plan.walls(Style.HOLLOW, outer + inner)
    plan.door((271, 26), (231, 26), DOWN, 8)  # entrance
    plan.door((224.5, 106), (224.5, 66), LEFT, 5)  # bathroom
    plan.door((224.5, 128), (224.5, 168), LEFT, 5)  # living room
    plan.door((277.5, 154), (277.5, 114), RIGHT, 5)  # bedroom 1
    plan.door((277.5, 178), (277.5, 218), RIGHT, 5)  # bedroom 2
    plan.door((146, 114.5), (106, 114.5), UP, 5)  # kitchen
    plan.door((231, 246.5), (271, 246.5), UP, 5)  # store
    plan.double_door((96, 306), (156, 306), DOWN, 8)  # balcony
    for start, end in (
        ((60, 26), (120, 26)),
        ((174, 26), (204, 26)),
        ((28, 150), (28, 220)),
        ((322, 306), (392, 306)),
        ((432, 66), (432, 126)),
        ((238, 306), (264, 306)),
    ):
        plan.window(start, end, 8)


def _furniture_b(sheet):
    sheet.tiles(32, 30, 150, 112, 12)
    sheet.tiles(155, 30, 222, 112, 9)
    sheet.tiles(44, 310, 208, 342, 10)
    sheet.rect(44, 310, 208, 342, THIN)
    sheet.rect(46, 310, 206, 340, HAIR)
    _kitchen_b(sheet)
    _bathroom_b(sheet)
    _living_b(sheet)
    _bedrooms_b(sheet)


def _kitchen_b(sheet):
    sheet.rect(32, 30, 150, 56, THIN, 255)
    sheet.rect(32, 30, 58, 112, THIN, 255)
    sheet.line((32, 30), (58, 56), HAIR)
    fit.sink(sheet, 72, 34, 0, 40, 18)
    fit.hob(sheet, 54, 66, 90, 30, 19)
    fit.appliance(sheet, 122, 31, 27, 27, "REF")


def _bathroom_b(sheet):
    fit.shower(sheet, 155, 30, 30, 32)
    fit.toilet(sheet, 196, 31, 0, 16)
    fit.basin(sheet, 156, 94, 270, 24, 17)
    fit.appliance(sheet, 156, 96, 16, 16, "W")


def _living_b(sheet):
    sheet.rect(62, 214, 142, 286, HAIR)  # rug
    sheet.rect(65, 217, 139, 283, HAIR)
    fit.sofa(sheet, 34, 288, 270, 84, 36, 3)
    fit.sofa(sheet, 132, 208, 30, 34, 32, 1)
    sheet.rect(90, 232, 114, 266, THIN, 255)  # coffee table
    sheet.rect(93, 235, 111, 263, HAIR)
    sheet.rect(212, 214, 222, 284, THIN, 255)  # television
    sheet.rect(207, 228, 211, 270, HAIR, 255)
    fit.dining_table(sheet, 56, 142, 62, 34, 17, 2)
    fit.plant(sheet, 208, 291, 9)


def _bedrooms_b(sheet):
    fit.bed(sheet, 427, 62, 90, 72, 88)
    fit.nightstand(sheet, 427, 44, 90, 16)
    fit.nightstand(sheet, 427, 138, 90, 16)
    fit.wardrobe(sheet, 282, 31, 0, 92, 26)
    fit.bed(sheet, 427, 168, 90, 42, 88)
    fit.desk(sheet, 318, 301, 180, 34, 24)
    fit.wardrobe(sheet, 427, 232, 90, 68, 26)
    sheet.rect(228, 280, 274, 301, THIN, 255)  # shelves of the store
    sheet.line((228, 291), (274, 291), HAIR)
    fit.plant(sheet, 290, 66, 7)


def _annotation_b(sheet):
    fit.label(sheet, 172, 190, "LIVING", area(190, 185))
    fit.label(sheet, 84, 86, "KITCHEN", None, 7.0)
    fit.label(sheet, 318, 86, "BED 1", area(148, 132), 7.5)
    fit.label(sheet, 354, 244, "BED 2", area(148, 135), 7.5)
    fit.label(sheet, 251, 266, "STORE", None, 6.5)
    sheet.text(182, 327, "BALCONY", 7, halo=1.5)
    fit.label(sheet, 251, 186, "HALL", None, 7.5)
    sheet.line((251, 4), (251, 16), MEDIUM)  # entrance arrow
    sheet.polygon([(247.5, 13), (254.5, 13), (251, 19)], HAIR, 0)
    sheet.text(282, 10, "ENTRANCE", 6.5)
