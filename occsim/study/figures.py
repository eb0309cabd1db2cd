"""Figures of a study: colour maps (Fig. 4.5) and fronts (Fig. 4.7), by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from occsim._extras import needs_extra
from occsim._types import FloatArray
from occsim.errors import ParameterError
from occsim.prior import SOURCE_PAIR
from occsim.priors import MIN_RECALL, Objective, interpolate
from occsim.study.run import StudyCase

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MAP_POINTS = 200
"""Values across a colour map."""
WORST = 4.0
"""Largest 1/precision and 1/recall in a plot of fronts. Recalls near 0 would stretch
the axis until the rest is one point."""
DPI = 120
LONGEST_NAME = 48
"""Characters of a drawing's name and cell size: a longer legend leaves no room."""

# Okabe and Ito's colours: distinguishable with all common colour vision deficiencies.
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
_MARKERS = "osD^vP"
_DASHES = ("-", "--", "-.", ":")
_SOURCE = f"the source's choice, {SOURCE_PAIR}"
_STAR: dict[str, Any] = {"marker": "*", "ms": 13, "mec": "black", "ls": ""}
_BLANK: dict[str, Any] = {"marker": "X", "ms": 8, "mec": "black", "ls": ""}


def maps_figure(cases: Sequence[StudyCase]) -> Figure:
    """Return colour maps of precision and recall, a row a case (Fig. 4.5).

    Parameters
    ----------
    cases : sequence of StudyCase
        At least one.

    Returns
    -------
    matplotlib.figure.Figure
        p_wall to the right, p_space upwards; colours in percent, bilinearly
        interpolated as in the source, grey where undefined. Marked are the maxima of
        the sweep, the pairs of the exact front and the source's choice.

    Raises
    ------
    ParameterError
        Where there is no case.
    ImportError
        Where matplotlib is not installed.
    """
    figure = _figure(cases, width=9.0, height=3.4 * len(cases) + 0.4)
    axes = figure.subplots(len(cases), 2, squeeze=False)
    for case, row in zip(cases, axes, strict=True):
        for ax, objective in zip(row, Objective, strict=True):
            _draw_map(ax, case, objective)
    handles, names = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper center", ncols=3, frameon=False)
    return figure


def fronts_figure(cases: Sequence[StudyCase]) -> Figure:
    """Return the exact fronts of several cases in one plot (Fig. 4.7).

    Parameters
    ----------
    cases : sequence of StudyCase
        At least one, of one cell size as a rule.

    Returns
    -------
    matplotlib.figure.Figure
        1/precision to the right, 1/recall upwards, both to be minimised; second axes
        in percent. A line borders what each front attains. Marked, in the colour of
        the front: the source's choice and the map without a drawing.

    Raises
    ------
    ParameterError
        Where there is no case.
    ImportError
        Where matplotlib is not installed.
    """
    figure = _figure(cases, width=8.0, height=6.0)
    ax = figure.subplots()
    for i, case in enumerate(cases):
        _draw_front(ax, case, _COLOURS[i % 6], _MARKERS[i % 6], _DASHES[i // 6 % 4])
    ax.plot([], [], color="0.7", label=_SOURCE, **_STAR)
    ax.plot([], [], color="0.7", label="no drawing (prior of one half)", **_BLANK)
    _frame_fronts(ax, cases)
    figure.legend(loc="outside right upper", frameon=False)
    return figure


def save_figures(folder: Path, cases: Sequence[StudyCase]) -> list[Path]:
    """Write both figures of every cell size as PNG.

    Parameters
    ----------
    folder : Path
        An existing folder.
    cases : sequence of StudyCase
        At least one.

    Returns
    -------
    list of Path
        ``maps_3px.png``, ``fronts_3px.png`` and so on, by cell size.

    Raises
    ------
    ParameterError, ImportError
        As in `maps_figure`.
    """
    paths = []
    for cell_px in sorted({case.cell_px for case in cases}):
        same = [case for case in cases if case.cell_px == cell_px]
        for name, draw in (("maps", maps_figure), ("fronts", fronts_figure)):
            path = folder / f"{name}_{cell_px}px.png"
            draw(same).savefig(path, dpi=DPI)
            paths.append(path)
    return paths


def _figure(cases: Sequence[StudyCase], width: float, height: float) -> Figure:
    if not cases:
        raise ParameterError("a figure needs at least one case; got none")
    with needs_extra("study", "a figure"):
        # Not pyplot, which keeps every figure in memory and needs a display.
        from matplotlib.figure import Figure
    return Figure(figsize=(width, height), layout="constrained")


def _draw_map(ax: Axes, case: StudyCase, objective: Objective) -> None:
    best, front = case.maxima(objective), case.front
    _draw_colours(ax, case, objective)
    # Pairs on the border of the map are shown whole.
    rings = ax.plot(best.p_wall, best.p_space, "wo", mec="k", label="largest values")
    dots = ax.plot(front.p_wall, front.p_space, "k.", label="exact front")
    for line in rings + dots:
        # The box of an unclipped line without points has no size: no layout fits it.
        line.set_clip_on(np.size(line.get_xdata()) == 0)
    ax.plot(*SOURCE_PAIR, color=_COLOURS[1], label=_SOURCE, **_STAR)
    top = "undefined" if np.isnan(best.value) else f"up to {100 * best.value:.1f} %"
    ax.set_title(f"{_plain(case.name)}, {case.cell_px} px cells: {top}", fontsize=10)
    ax.set(xlabel=r"$p_\mathrm{wall}$", ylabel=r"$p_\mathrm{space}$")


def _draw_colours(ax: Axes, case: StudyCase, objective: Objective) -> None:
    from matplotlib import colormaps

    axes = case.sweep.p_wall, case.sweep.p_space
    across, up = (np.linspace(axis[0], axis[-1], MAP_POINTS) for axis in axes)
    values = interpolate(case.sweep, across[None, :], up[:, None], objective)
    low, high = _limits(100.0 * values)
    image = ax.imshow(
        100.0 * values,
        extent=(across[0], across[-1], up[0], up[-1]),
        origin="lower",
        cmap=colormaps["cividis"].with_extremes(bad="0.8"),
        vmin=low,
        vmax=high,
    )
    bar = ax.figure.colorbar(image, ax=ax, label=f"{objective.value}, %")
    bar.ax.ticklabel_format(useOffset=False)


def _limits(values: FloatArray) -> tuple[float, float]:
    # A constant or undefined map has no range of values.
    defined = values[~np.isnan(values)]
    if not defined.size:
        return 0.0, 100.0
    low, high = float(defined.min()), float(defined.max())
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _draw_front(
    ax: Axes, case: StudyCase, colour: str, marker: str, dashes: str
) -> None:
    points = case.front.objectives
    x, y = points[np.lexsort((-points[:, 1], points[:, 0]))].T
    # Nothing better is attained between two points: the border is a staircase through
    # the worse value of each.
    ax.step(x, y, where="post", color=colour, ls=dashes, lw=1.2, alpha=0.7)
    name = _plain(f"{case.name}, {case.cell_px} px cells")
    ax.plot(x, y, marker, color=colour, markersize=5, label=name)
    for mark, place in zip((_STAR, _BLANK), _marks(case), strict=True):
        ax.plot(*place, color=colour, **mark)


def _marks(case: StudyCase) -> FloatArray:
    """Return 1/precision and 1/recall of the source's pair and without a drawing.

    Shape (2, 2); NaN where a score is 0 or undefined, or the pair was not swept.
    """
    sweep, scores = case.sweep, np.full((2, 2), np.nan)
    here = np.ix_(sweep.p_wall == SOURCE_PAIR[0], sweep.p_space == SOURCE_PAIR[1])
    if sweep.tp[here].size:
        scores[0] = sweep.precision[here].item(), sweep.recall[here].item()
    scores[1] = case.blank.precision, case.blank.recall
    return 1.0 / np.where(scores > 0.0, scores, np.nan)


def _frame_fronts(ax: Axes, cases: Sequence[StudyCase]) -> None:
    shown = [array for c in cases for array in (c.front.objectives, _marks(c))]
    points = np.concatenate(shown)
    largest = np.nanmax(np.where(points <= WORST, points, np.nan), axis=0, initial=1.1)
    right, top = (1.0 + 1.05 * (largest - 1.0)).tolist()
    ax.set(xlim=(0.99, right), ylim=(0.99, top))
    ax.set(xlabel="1/precision (1 is perfect)", ylabel="1/recall (1 is perfect)")
    percent = (_percent, _percent)
    ax.secondary_xaxis("top", functions=percent).set_xlabel("precision, %")
    ax.secondary_yaxis("right", functions=percent).set_ylabel("recall, %")
    if top > 1.0 / MIN_RECALL:
        words = f"set C: recall above {100 * MIN_RECALL:g} %"
        ax.axhline(1.0 / MIN_RECALL, color="0.5", ls=":", label=words)
    ax.grid(color="0.9")
    ax.set_axisbelow(True)


def _percent(value: Any) -> Any:
    # 1/x is its own inverse; matplotlib also evaluates it at 0.
    with np.errstate(divide="ignore"):
        return 100.0 / np.asarray(value, dtype=np.float64)


def _plain(text: str) -> str:
    # Escape file names: matplotlib would read text between dollar signs as mathematics.
    shown = text if len(text) <= LONGEST_NAME else f"...{text[3 - LONGEST_NAME :]}"
    return shown.replace("$", r"\$")
