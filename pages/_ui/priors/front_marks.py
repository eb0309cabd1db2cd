"""Maps of their own in a chart of fronts: where they stand, and their labels."""

from dataclasses import dataclass
from typing import Any

import plotly.graph_objects as go

from pages._ui import palette, words
from pages._ui.choices import FrontAxes
from pages._ui.priors.surface_figures import Pair

LETTER_PX, LINE_PX, MARK_PX = 6, 14, 13
PLOT_PX = 240, 280
"""The smallest chart, width and height: labels apart in it are apart in every one."""


@dataclass(frozen=True, slots=True)
class Mark:
    """One map of its own in a chart of fronts: a name, its scores, a symbol.

    A click chooses its ``pair``, if it has one. A mark that does not set the axes
    stands at the border of the chart if it lies beyond.
    """

    name: str
    precision: float
    recall: float
    symbol: str
    color: str = palette.HALO
    pair: Pair | None = None
    sets_axes: bool = True


def place(axes: FrontAxes, precision: Any, recall: Any) -> tuple[Any, Any]:
    """Where scores lie in a chart: x and y; numbers or arrays."""
    if axes is FrontAxes.INVERSE:
        return 1.0 / recall, 1.0 / precision
    return 100.0 * recall, 100.0 * precision


@dataclass(frozen=True, slots=True)
class Placed:
    """A mark where it stands, px of `PLOT_PX` from the lower left corner of the chart.

    The label has the scores that lie beyond an axis; it is empty where none does.
    """

    mark: Mark
    x: float
    y: float
    left_px: float
    bottom_px: float
    label: str

    @property
    def is_at_right(self) -> bool:
        """Whether it stands at the right border, so that its label ends there."""
        return self.left_px >= PLOT_PX[0]

    def label_px(self) -> tuple[float, float]:
        """Where its label begins and ends."""
        length = LETTER_PX * len(self.label) + MARK_PX / 2
        ends = (-length, 0.0) if self.is_at_right else (0.0, length)
        return self.left_px + ends[0], self.left_px + ends[1]


def placed(mark: Mark, axes: FrontAxes, ends: list[Pair]) -> Placed:
    """Place a mark; beyond an axis it stands at the border, with its score."""
    true = place(axes, mark.precision, mark.recall)
    at = [min(max(v, low), high) for v, (low, high) in zip(true, ends, strict=True)]
    scores = {"recall": mark.recall, "precision": mark.precision}
    label = ", ".join(
        f"{name} {100 * score:.0f} %"
        for (name, score), here, shown in zip(scores.items(), true, at, strict=True)
        if here != shown
    )
    left, bottom = (
        size * (value - low) / (high - low)
        for size, value, (low, high) in zip(PLOT_PX, at, ends, strict=True)
    )
    return Placed(mark, at[0], at[1], left, bottom, label)


def mark_traces(
    marks: list[Mark], axes: FrontAxes, ends: list[Pair]
) -> list[go.Scatter]:
    """Marked maps in a chart with these axes; no two labels touch.

    Where a label would run into one before it, the mark has none. Marks that lie on one
    another at the border all say their scores when one of them is pointed at.
    """
    all_placed = [placed(mark, axes, ends) for mark in marks]
    labelled: list[Placed] = []
    for one in all_placed:
        if one.label and not any(_touch(one, other) for other in labelled):
            labelled.append(one)
    return [
        _trace(
            one, one in labelled, [other for other in all_placed if _meet(one, other)]
        )
        for one in all_placed
    ]


def _touch(one: Placed, other: Placed) -> bool:
    (left, right), (start, end) = one.label_px(), other.label_px()
    is_beside = right <= start or end <= left
    return not is_beside and abs(one.bottom_px - other.bottom_px) < LINE_PX


def _meet(one: Placed, other: Placed) -> bool:
    """Whether two marks beyond an axis cover each other; a mark meets itself."""
    gaps = one.left_px - other.left_px, one.bottom_px - other.bottom_px
    are_beyond = bool(one.label and other.label)
    return one is other or (are_beyond and max(map(abs, gaps)) < MARK_PX)


def _trace(placed: Placed, is_labelled: bool, here: list[Placed]) -> go.Scatter:
    mark = placed.mark
    is_ring = mark.symbol.endswith("-open")
    line = {"color": mark.color if is_ring else palette.OUTLINE}
    line["width"] = 3 if is_ring else 1
    size = 17 if is_ring else MARK_PX
    marker = {"symbol": mark.symbol, "size": size, "color": mark.color, "line": line}
    about = "<br>".join(_about(one.mark) for one in here) + "<extra></extra>"
    return go.Scatter(
        x=[placed.x],
        y=[placed.y],
        customdata=None if mark.pair is None else [list(mark.pair)],
        mode="markers+text" if is_labelled else "markers",
        # A space that stays keeps the words off their mark.
        text=[f"\u00a0{placed.label}\u00a0" if is_labelled else ""],
        textposition="middle left" if placed.is_at_right else "middle right",
        textfont={"size": 11},
        name=mark.name,
        marker=marker,
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        # A ring lies around its point and must not catch the pointer.
        hoverinfo="skip" if is_ring else None,
        hovertemplate=None if is_ring else words.chart(about),
        showlegend=False,
        cliponaxis=False,
    )


def _about(mark: Mark) -> str:
    return (
        f"{mark.name}<br>precision {100 * mark.precision:.1f} %, "
        f"recall {100 * mark.recall:.1f} %"
    )
