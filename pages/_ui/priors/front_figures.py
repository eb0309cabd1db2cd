"""Plotly figures of fronts: in precision and recall, and over the prior pairs."""

from dataclasses import dataclass
from typing import Any

import plotly.graph_objects as go
from plotly.colors import sample_colorscale

from occsim.priors import ParetoFront
from pages._ui import palette, words
from pages._ui.choices import FrontAxes
from pages._ui.priors.front_marks import Mark, mark_traces, place
from pages._ui.priors.fronts import pairs_of, scores_at
from pages._ui.priors.marks import MarkedPrior
from pages._ui.priors.surface_figures import (
    Pair,
    pair_axes,
    pair_marks,
    pair_targets,
)
from pages._ui.priors.surfaces import HIGH, LOW

FRONT_PX = 400
# Recall to the right and precision up, in either quantity.
WORDS = {
    FrontAxes.SCORES: ("recall, %", "precision, %"),
    FrontAxes.INVERSE: ("1/recall", "1/precision"),
}
BEST = {FrontAxes.SCORES: 100.0, FrontAxes.INVERSE: 1.0}
"""The value of both axes beyond which there is nothing."""
STEPS = "vh"
"""The border is a staircase: nothing is attained between two points."""
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")


@dataclass(frozen=True, eq=False, slots=True)
class Drawn:
    """A front as it is drawn, and the marked maps that belong to it.

    With a ``size`` of 0 only its border is drawn, pale: a front to compare with.
    """

    name: str
    front: ParetoFront
    color: str = palette.ONCE
    dash: str = "solid"
    symbol: str = "circle"
    size: int = 9
    marks: tuple[Mark, ...] = ()


def fronts_figure(
    drawn: list[Drawn], axes: FrontAxes, min_recall: float, title: str, revision: str
) -> go.Figure:
    """Some fronts with their marks; full points are those of set C, a click chooses."""
    figure = go.Figure()
    shown = [m for d in drawn for m in d.marks if m.precision > 0.0 and m.recall > 0.0]
    for one in drawn:
        figure.add_trace(front_steps(one, axes))
    points = [point for one in drawn for point in scores_at(one.front)]
    # A calibrated prior that is taken off at every reading can score next to nothing:
    # it must not squeeze the fronts.
    points += [(m.precision, m.recall) for m in shown if m.sets_axes]
    ends = frame_front(figure, axes, points, title, revision)
    figure.add_traces(mark_traces(shown, axes, ends))
    # The points last, so that they lie on top and can be clicked.
    for one in drawn:
        if one.size:
            figure.add_trace(front_points(one, axes, min_recall))
    threshold(figure, axes, min_recall)
    return figure


def front_figure(
    front: ParetoFront, axes: FrontAxes, marks: list[Mark], min_recall: float
) -> go.Figure:
    """One exact front with some marked maps."""
    one = Drawn("exact front", front, marks=tuple(marks))
    return fronts_figure([one], axes, min_recall, "Exact front", "front")


def study_figure(
    fronts: dict[str, ParetoFront], cell_px: int, axes: FrontAxes, min_recall: float
) -> go.Figure:
    """The fronts of several drawings, each in its colour and dashes."""
    title = f"Exact fronts, cells of {cell_px} px"
    return fronts_figure(series(fronts), axes, min_recall, title, "study")


def series(fronts: dict[str, ParetoFront]) -> list[Drawn]:
    """The fronts of several drawings, told apart by colour and dashes."""
    return [
        Drawn(
            name,
            front,
            palette.SERIES[i % len(palette.SERIES)],
            DASHES[i % len(DASHES)],
            size=6,
        )
        for i, (name, front) in enumerate(fronts.items())
    ]


def front_steps(drawn: Drawn, axes: FrontAxes) -> go.Scatter:
    """The border of what can be attained."""
    x, y = place(axes, drawn.front.precision, drawn.front.recall)
    line = {"shape": STEPS, "color": drawn.color, "width": 1.5}
    line["dash"] = drawn.dash
    return go.Scatter(
        x=x,
        y=y,
        # A front of one point has no border; its symbol stands in the legend.
        mode="lines" if len(drawn.front) > 1 else "lines+markers",
        line=line,
        marker={"symbol": drawn.symbol, "size": drawn.size or 8},
        cliponaxis=False,
        name=drawn.name,
        hoverinfo="skip",
        opacity=0.8 if drawn.size else 0.5,
        showlegend=drawn.size > 0,
    )


def front_points(drawn: Drawn, axes: FrontAxes, min_recall: float) -> go.Scatter:
    """The points of a front; those outside set C are hollow."""
    front = drawn.front
    x, y = place(axes, front.precision, front.recall)
    marker = {
        "size": drawn.size,
        "symbol": _symbols(drawn, min_recall),
        "color": drawn.color,
        "opacity": 1,
    }
    return go.Scatter(
        x=x,
        y=y,
        customdata=[list(pair) for pair in pairs_of(front)],
        text=[
            f"precision {100 * p:.1f} %, recall {100 * r:.1f} %, F2 {100 * f:.1f} %"
            for p, r, f in zip(front.precision, front.recall, front.f2, strict=True)
        ],
        mode="markers",
        marker=marker,
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        name=drawn.name,
        hovertemplate=(
            f"{drawn.name}<br>%{{text}}<br>"
            + words.chart("p_wall %{customdata[0]:.3g}, p_space %{customdata[1]:.3g}")
            + "<extra></extra>"
        ),
        showlegend=False,
        cliponaxis=False,
    )


def _symbols(drawn: Drawn, min_recall: float) -> list[str]:
    inside = [recall > min_recall for recall in drawn.front.recall.tolist()]
    return [drawn.symbol if flag else f"{drawn.symbol}-open" for flag in inside]


def threshold(figure: go.Figure, axes: FrontAxes, min_recall: float) -> None:
    """A line at the smallest recall of set C; not drawn if all points exceed it."""
    if min_recall <= 0.0:
        return
    x, _ = place(axes, 1.0, min_recall)
    note = {"text": f"set C: recall > {min_recall:.2f}", "font_size": 11}
    figure.add_vline(
        x, line={"dash": "dot", "width": 1, "color": palette.GUIDE}, annotation=note
    )


def axis_ends(axes: FrontAxes, values: list[float], margin: float = 0.08) -> Pair:
    """Ends of an axis that shows some values; nothing lies beyond its best value."""
    pad = margin * (max(values) - min(values)) or 0.05 * max(values)
    low, high = min(values) - pad, max(values) + pad
    if axes is FrontAxes.INVERSE:
        return max(low, BEST[axes]), high
    return max(low, 0.0), min(high, BEST[axes])


def frame_front(
    figure: go.Figure,
    axes: FrontAxes,
    points: list[Pair],
    title: str,
    revision: str,
) -> list[Pair]:
    """Set title, height, legend and axes of a chart of points; return the axes' ends.

    Without a point the axes span all scores.
    """
    points = points or [(0.05, 0.05), (1.0, 1.0)]
    places = [place(axes, precision, recall) for precision, recall in points]
    ends = [axis_ends(axes, list(values)) for values in zip(*places, strict=True)]
    for which, update in enumerate((figure.update_xaxes, figure.update_yaxes)):
        update(title_text=WORDS[axes][which], title_standoff=4, zeroline=False)
        update(range=ends[which])
    figure.update_layout(
        title={"text": title, "x": 0.0, "font_size": 14},
        height=FRONT_PX,
        margin={"l": 52, "r": 8, "t": 34, "b": 84},
        legend={"orientation": "h", "y": -0.2, "x": 0, "font_size": 12},
        uirevision=f"{revision} {axes.value}",
        hovermode="closest",
    )
    return ends


@dataclass(frozen=True, eq=False, slots=True)
class PairsOfRule:
    """A front over the prior pairs, and the pairs that score as the chosen one does.

    ``rectangles`` has rows p_wall low and high, p_space low and high.
    """

    drawn: Drawn
    rectangles: list[list[float]]


def prior_space_figure(
    rules: list[PairsOfRule],
    marked: list[MarkedPrior],
    chosen: Pair,
    min_recall: float,
) -> go.Figure:
    """The pairs of some fronts, and all pairs that score as the chosen one does."""
    figure = go.Figure()
    for one in rules:
        figure.add_trace(_rectangles(one))
    for one in rules:
        figure.add_trace(_front_pairs(one.drawn, min_recall))
    figure.add_traces(pair_marks(marked, chosen))
    figure.update_layout(
        **pair_axes(LOW - 0.03, HIGH + 0.03),
        title={"text": "The same pairs of priors", "x": 0.0, "font_size": 14},
        height=FRONT_PX,
        margin={"l": 44, "r": 0, "t": 34, "b": 40},
        showlegend=False,
        uirevision="prior space",
        hovermode="closest",
    )
    return figure


def _front_pairs(drawn: Drawn, min_recall: float) -> go.Scatter:
    return go.Scatter(
        x=drawn.front.p_space,
        y=drawn.front.p_wall,
        mode="markers",
        marker={
            "size": 8,
            "color": drawn.color,
            "symbol": _symbols(drawn, min_recall),
        },
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        showlegend=False,
        hovertemplate=f"{drawn.name}<br>"
        + words.chart("p_wall %{y:.3g}, p_space %{x:.3g}<extra></extra>"),
        cliponaxis=False,
    )


def _rectangles(of: PairsOfRule) -> go.Scatter:
    # One outline after another; None separates them.
    x: list[float | None] = []
    y: list[float | None] = []
    for bottom, top, left, right in of.rectangles:
        x += [left, right, right, left, left, None]
        y += [bottom, bottom, top, top, bottom, None]
    return go.Scatter(
        x=x,
        y=y,
        fill="toself",
        mode="lines",
        line={"color": of.drawn.color, "width": 1.5, "dash": of.drawn.dash},
        opacity=0.5,
        hoverinfo="skip",
    )


def region_figure(
    count: Any,
    values: list[float],
    n_drawings: int,
    marked: list[MarkedPrior],
    chosen: Pair,
) -> go.Figure:
    """For how many drawings each prior pair is near the front."""
    colors = sample_colorscale(
        palette.SCORE_SCALE, [n / n_drawings for n in range(n_drawings + 1)]
    )
    scale = [
        [edge / (n_drawings + 1), color]
        for n, color in enumerate(colors)
        for edge in (n, n + 1)
    ]
    figure = go.Figure(
        go.Heatmap(
            x=values,
            y=values,
            z=count.astype("uint8"),
            zmin=-0.5,
            zmax=n_drawings + 0.5,
            colorscale=scale,
            colorbar={"title": {"text": "drawings"}, "thickness": 12, "dtick": 1},
            hoverinfo="skip",
        )
    )
    figure.add_traces(pair_marks(marked, chosen))
    near = [f"near {n} of {n_drawings} fronts" for row in count.tolist() for n in row]
    figure.add_trace(pair_targets(values, near))
    half = (values[1] - values[0]) / 2
    figure.update_layout(
        **pair_axes(LOW - half, HIGH + half),
        title={
            "text": "Near how many fronts a pair lies",
            "x": 0.0,
            "font_size": 14,
        },
        height=FRONT_PX,
        margin={"l": 44, "r": 0, "t": 34, "b": 40},
        showlegend=False,
        uirevision="region",
        hovermode="closest",
        hoverdistance=40,
    )
    return figure
