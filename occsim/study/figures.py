"""Pictures of a study, drawn plainly: colour maps (Fig. 4.5) and fronts (Fig. 4.7)."""

from collections.abc import Sequence

import cv2
import numpy as np

from occsim._types import ByteArray, FloatArray
from occsim.errors import ParameterError
from occsim.priors import Maxima, Objective, ParetoFront, PriorSweep, interpolate
from occsim.study.run import StudyCase

MAP_PX = 200
"""Side of a colour map, px."""
LEFT_PX, TOP_PX, RIGHT_PX, BOTTOM_PX = 50, 30, 20, 44
"""Room around a plot for labels, px."""
PLOT_PX = 420
"""Side of the plot of fronts, px."""

_INK = (40, 40, 40)
_UNDEFINED = (205, 205, 205)
# Okabe and Ito's colours, told apart by colour-blind readers too; red first.
_COLOURS = (
    (0, 114, 178),
    (213, 94, 0),
    (0, 158, 115),
    (204, 121, 167),
    (86, 180, 233),
    (230, 159, 0),
)
_MARKERS = (
    cv2.MARKER_CROSS,
    cv2.MARKER_SQUARE,
    cv2.MARKER_TRIANGLE_UP,
    cv2.MARKER_DIAMOND,
    cv2.MARKER_TILTED_CROSS,
    cv2.MARKER_TRIANGLE_DOWN,
)


def maps_picture(cases: Sequence[StudyCase]) -> ByteArray:
    """Return the colour maps of precision and recall, a row a case (Fig. 4.5).

    Parameters
    ----------
    cases : sequence of StudyCase
        At least one.

    Returns
    -------
    ndarray of uint8, shape (H, W, 3)
        p_wall to the right, p_space upwards, bilinearly interpolated as in the source;
        the largest values yellow. White dots: the maxima. Black dots: pairs of the
        exact front. Grey: undefined.

    Raises
    ------
    ParameterError
        Where there is no case.
    """
    _require_some(cases)
    rows = [
        np.hstack([_map_panel(case, objective) for objective in Objective])
        for case in cases
    ]
    return np.asarray(np.vstack(rows), dtype=np.uint8)


def fronts_picture(cases: Sequence[StudyCase]) -> ByteArray:
    """Return the exact fronts of several cases in one plot (Fig. 4.7).

    Parameters
    ----------
    cases : sequence of StudyCase
        At least one, of one cell size as a rule.

    Returns
    -------
    ndarray of uint8, shape (H, W, 3)
        1/precision to the right, 1/recall upwards, both to be minimised.

    Raises
    ------
    ParameterError
        Where there is no case.
    """
    _require_some(cases)
    points = np.concatenate([case.front.objectives for case in cases])
    # A front may reach recalls near 0; beyond 4 the plot would show nothing else.
    top = np.clip(points.max(axis=0, initial=1.0), 1.2, 4.0)
    canvas = _canvas(PLOT_PX)
    _axes(canvas, PLOT_PX, ((1.0, float(top[0])), (1.0, float(top[1]))))
    _axis_names(canvas, PLOT_PX, "1/precision", "1/recall")
    for i, case in enumerate(cases):
        colour, marker = _COLOURS[i % len(_COLOURS)], _MARKERS[i % len(_MARKERS)]
        _draw_front(canvas, case.front, top, colour, marker)
        at = (LEFT_PX + PLOT_PX - 110, TOP_PX + 20 + 18 * i)
        cv2.drawMarker(canvas, (at[0] - 12, at[1] - 4), colour, marker, 8, 1)
        _text(canvas, f"{case.name[:10]}, {case.cell_px} px", at)
    return canvas


def _require_some(cases: Sequence[StudyCase]) -> None:
    if not cases:
        raise ParameterError("a picture needs at least one case; got none")


def _canvas(side_px: int) -> ByteArray:
    shape = (TOP_PX + side_px + BOTTOM_PX, LEFT_PX + side_px + RIGHT_PX, 3)
    return np.full(shape, 255, dtype=np.uint8)


def _map_panel(case: StudyCase, objective: Objective) -> ByteArray:
    canvas, sweep = _canvas(MAP_PX), case.sweep
    ends = (
        (float(sweep.p_wall[0]), float(sweep.p_wall[-1])),
        (float(sweep.p_space[0]), float(sweep.p_space[-1])),
    )
    best = case.maxima(objective)
    inside = (
        slice(TOP_PX, TOP_PX + MAP_PX),
        slice(LEFT_PX, LEFT_PX + MAP_PX),
    )
    canvas[inside] = _colour_map(sweep, objective)
    _axes(canvas, MAP_PX, ends)
    _axis_names(canvas, MAP_PX, "p_wall", "p_space")
    _dots(canvas, ends, case.front.p_wall, case.front.p_space, 2, (0, 0, 0))
    _dots(canvas, ends, best.p_wall, best.p_space, 3, (255, 255, 255))
    title = f"{case.name[:14]}, {case.cell_px} px: {objective.value} {_range(best)}"
    _text(canvas, title, (LEFT_PX - 30, TOP_PX - 10))
    return canvas


def _range(best: Maxima) -> str:
    return "undefined" if np.isnan(best.value) else f"to {100 * best.value:.1f} %"


def _colour_map(sweep: PriorSweep, objective: Objective) -> ByteArray:
    across = np.linspace(sweep.p_wall[0], sweep.p_wall[-1], MAP_PX)
    up = np.linspace(sweep.p_space[-1], sweep.p_space[0], MAP_PX)
    values = interpolate(sweep, across[None, :], up[:, None], objective)
    undefined = np.isnan(values)
    if undefined.all():
        return np.full((MAP_PX, MAP_PX, 3), _UNDEFINED, dtype=np.uint8)
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    # A flat map has no range to spread; it is drawn as high throughout.
    share = (values - low) / (high - low) if high > low else np.ones_like(values)
    levels = np.rint(255.0 * np.where(undefined, 0.0, share)).astype(np.uint8)
    colours = cv2.applyColorMap(levels, cv2.COLORMAP_CIVIDIS)[:, :, ::-1]
    return np.where(undefined[..., None], _UNDEFINED, colours).astype(np.uint8)


def _dots(
    canvas: ByteArray,
    ends: tuple[tuple[float, float], tuple[float, float]],
    p_wall: FloatArray,
    p_space: FloatArray,
    radius: int,
    colour: tuple[int, int, int],
) -> None:
    for pair in zip(p_wall.tolist(), p_space.tolist(), strict=True):
        at = _place(pair, ends, MAP_PX)
        cv2.circle(canvas, at, radius + 1, _INK, -1, cv2.LINE_AA)
        cv2.circle(canvas, at, radius, colour, -1, cv2.LINE_AA)


def _draw_front(
    canvas: ByteArray,
    front: ParetoFront,
    top: FloatArray,
    colour: tuple[int, int, int],
    marker: int,
) -> None:
    ends = ((1.0, float(top[0])), (1.0, float(top[1])))
    shown = front.objectives[(front.objectives <= top).all(axis=1)]
    places = [_place((x, y), ends, PLOT_PX) for x, y in shown.tolist()]
    for (x0, y0), (x1, y1) in zip(places, places[1:], strict=False):
        # The edge of what the front dominates turns where both are at their worse.
        corner = (max(x0, x1), min(y0, y1))
        cv2.line(canvas, (x0, y0), corner, colour, 1, cv2.LINE_AA)
        cv2.line(canvas, corner, (x1, y1), colour, 1, cv2.LINE_AA)
    for place in places:
        cv2.drawMarker(canvas, place, colour, marker, 8, 1, cv2.LINE_AA)


def _place(
    point: tuple[float, float],
    ends: tuple[tuple[float, float], tuple[float, float]],
    side_px: int,
) -> tuple[int, int]:
    (x0, x1), (y0, y1) = ends
    x = LEFT_PX + (point[0] - x0) / (x1 - x0) * (side_px - 1)
    y = TOP_PX + (y1 - point[1]) / (y1 - y0) * (side_px - 1)
    return round(x), round(y)


def _axes(
    canvas: ByteArray,
    side_px: int,
    ends: tuple[tuple[float, float], tuple[float, float]],
) -> None:
    right, bottom = LEFT_PX + side_px - 1, TOP_PX + side_px - 1
    cv2.rectangle(canvas, (LEFT_PX, TOP_PX), (right, bottom), _INK, 1)
    for share in (0.0, 0.5, 1.0):
        x, y = (low + share * (high - low) for low, high in ends)
        at_x, at_y = _place((x, y), ends, side_px)
        cv2.line(canvas, (at_x, bottom), (at_x, bottom + 4), _INK, 1)
        cv2.line(canvas, (LEFT_PX - 4, at_y), (LEFT_PX, at_y), _INK, 1)
        _text(canvas, f"{x:.2f}", (at_x - 13, bottom + 17))
        _text(canvas, f"{y:.2f}", (LEFT_PX - 36, at_y + 4))


def _axis_names(canvas: ByteArray, side_px: int, across: str, up: str) -> None:
    _text(canvas, across, (LEFT_PX + side_px // 2 - 25, TOP_PX + side_px + 34))
    side = np.full((14, 90, 3), 255, dtype=np.uint8)
    _text(side, up, (2, 11))
    # Read from the bottom up, at the left edge.
    turned = np.rot90(side)[: canvas.shape[0]]
    first = TOP_PX + side_px // 4 - 30
    canvas[first : first + 90, 0:14] = turned


def _text(canvas: ByteArray, text: str, at: tuple[int, int]) -> None:
    # OpenCV's fonts know ASCII only.
    plain = text.encode("ascii", "replace").decode()
    cv2.putText(canvas, plain, at, cv2.FONT_HERSHEY_SIMPLEX, 0.38, _INK, 1, cv2.LINE_AA)
