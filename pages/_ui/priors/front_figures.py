"""Plotly figures of fronts: in precision and recall, and over the prior pairs."""

from dataclasses import dataclass
from typing import Any

import plotly.graph_objects as go
from plotly.colors import sample_colorscale

from occsim.prior import SOURCE_PAIR
from occsim.priors import ParetoFront
from pages._ui import palette, words
from pages._ui.choices import FrontAxes
from pages._ui.priors.fronts import scores_at
from pages._ui.priors.surface_figures import (
    Pair,
    pair_marks,
    pair_targets,
    square_axes_of,
)
from pages._ui.priors.surfaces import HIGH, LOW

FRONT_PX = 380
WORDS = {
    FrontAxes.SCORES: ("recall, %", "precision, %"),
    FrontAxes.INVERSE: ("1/precision", "1/recall"),
}
# The border is a staircase: nothing is attained between two points.
STEPS = {FrontAxes.SCORES: "vh", FrontAxes.INVERSE: "hv"}


DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")


@dataclass(frozen=True, slots=True)
class Mark:
    """One map of its own in a chart of fronts: a name, its scores, a symbol.

    A click chooses its ``pair``, if it has one.
    """

    name: str
    precision: float
    recall: float
    symbol: str
    color: str = "white"
    pair: Pair | None = None


def place(axes: FrontAxes, precision: Any, recall: Any) -> tuple[Any, Any]:
    """Where scores lie in a chart: x and y; numbers or arrays."""
    if axes is FrontAxes.INVERSE:
        return 1.0 / precision, 1.0 / recall
    return 100.0 * recall, 100.0 * precision


def front_figure(
    front: ParetoFront, axes: FrontAxes, marks: list[Mark], min_recall: float
) -> go.Figure:
    """The exact front; full points are those of set C, a click chooses one."""
    shown = [mark for mark in marks if mark.precision > 0.0 and mark.recall > 0.0]
    figure = go.Figure(front_steps(front, axes, palette.SERIES[0], "exact front"))
    # The points last, so that they lie on top and can be clicked.
    figure.add_traces([mark_trace(mark, axes) for mark in shown])
    figure.add_trace(front_points(front, axes, min_recall))
    threshold(figure, axes, min_recall)
    points = scores_at(front) + [(mark.precision, mark.recall) for mark in shown]
    frame_front(figure, axes, points, "front")
    return figure


def front_steps(
    front: ParetoFront, axes: FrontAxes, color: str, name: str, dash: str = "solid"
) -> go.Scatter:
    """The border of what can be attained."""
    x, y = place(axes, front.precision, front.recall)
    line = {"shape": STEPS[axes], "color": color, "width": 1.5, "dash": dash}
    return go.Scatter(
        x=x, y=y, mode="lines", line=line, name=name, hoverinfo="skip", opacity=0.8
    )


def front_points(front: ParetoFront, axes: FrontAxes, min_recall: float) -> go.Scatter:
    """The points of a front; those outside set C are hollow."""
    x, y = place(axes, front.precision, front.recall)
    inside = [recall > min_recall for recall in front.recall.tolist()]
    color = palette.SERIES[0]
    rows = zip(front.p_wall.tolist(), front.p_space.tolist(), strict=True)
    marker = {
        "size": 9,
        "symbol": ["circle" if flag else "circle-open" for flag in inside],
        "color": color,
        "opacity": 1,
    }
    return go.Scatter(
        x=x,
        y=y,
        customdata=[list(row) for row in rows],
        text=[
            f"precision {100 * p:.1f} %, recall {100 * r:.1f} %, F2 {100 * f:.1f} %"
            for p, r, f in zip(front.precision, front.recall, front.f2, strict=True)
        ],
        mode="markers",
        marker=marker,
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        name="its points",
        hovertemplate=(
            "%{text}<br>"
            + words.chart("p_wall %{customdata[0]:.3g}, p_space %{customdata[1]:.3g}")
            + "<extra></extra>"
        ),
        showlegend=False,
    )


def mark_trace(mark: Mark, axes: FrontAxes) -> go.Scatter:
    """One marked map."""
    x, y = place(axes, mark.precision, mark.recall)
    is_ring = mark.symbol.endswith("-open")
    line = {"color": mark.color if is_ring else "black", "width": 3 if is_ring else 1}
    size = 17 if is_ring else 13
    marker = {"symbol": mark.symbol, "size": size, "color": mark.color, "line": line}
    about = f"{mark.name}<br>precision {100 * mark.precision:.1f} %, "
    about += f"recall {100 * mark.recall:.1f} %<extra></extra>"
    return go.Scatter(
        x=[x],
        y=[y],
        customdata=None if mark.pair is None else [list(mark.pair)],
        mode="markers",
        name=mark.name,
        marker=marker,
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        # A ring lies around its point and must not catch the pointer.
        hoverinfo="skip" if is_ring else None,
        hovertemplate=None if is_ring else about,
        cliponaxis=False,
    )


def threshold(figure: go.Figure, axes: FrontAxes, min_recall: float) -> None:
    """A line at the smallest recall of set C; not drawn if all points exceed it."""
    if min_recall <= 0.0:
        return
    x, y = place(axes, 1.0, min_recall)
    note = {"text": f"set C: recall > {min_recall:.2f}", "font_size": 11}
    line = {"dash": "dot", "width": 1, "color": palette.GUIDE}
    if axes is FrontAxes.SCORES:
        figure.add_vline(x, line=line, annotation=note)
    else:
        figure.add_hline(y, line=line, annotation=note)


def frame_front(
    figure: go.Figure, axes: FrontAxes, points: list[Pair], revision: str
) -> None:
    """Axes, height and legend of a chart of points of precision and recall."""
    titles = WORDS[axes]
    places = [place(axes, precision, recall) for precision, recall in points]
    for which, update in enumerate((figure.update_xaxes, figure.update_yaxes)):
        values = [where[which] for where in places]
        update(title_text=titles[which], title_standoff=4, zeroline=False)
        if values:
            pad = 0.08 * (max(values) - min(values)) or 0.05 * max(values)
            update(range=[min(values) - pad, max(values) + pad])
    figure.update_layout(
        height=FRONT_PX,
        margin={"l": 52, "r": 8, "t": 10, "b": 84},
        legend={"orientation": "h", "y": -0.2, "x": 0, "font_size": 12},
        uirevision=f"{revision} {axes.value}",
        hovermode="closest",
    )


def prior_space_figure(
    front: ParetoFront, rectangles: list[list[float]], chosen: Pair, min_recall: float
) -> go.Figure:
    """The front's pairs and all pairs that score as the chosen one does."""
    figure = go.Figure(_rectangles(rectangles))
    inside = [recall > min_recall for recall in front.recall.tolist()]
    symbols = ["circle" if flag else "circle-open" for flag in inside]
    figure.add_trace(
        go.Scatter(
            x=front.p_space,
            y=front.p_wall,
            mode="markers",
            marker={"size": 7, "color": palette.SERIES[0], "symbol": symbols},
            selected={"marker": {"opacity": 1}},
            unselected={"marker": {"opacity": 1}},
            name="front",
            hovertemplate=words.chart(
                "p_wall %{y:.3g}, p_space %{x:.3g}<extra></extra>"
            ),
        )
    )
    figure.add_traces(pair_marks([], chosen))
    square_axes_of(figure, LOW - 0.03, HIGH + 0.03)
    figure.update_layout(
        height=FRONT_PX,
        margin={"l": 44, "r": 0, "t": 10, "b": 84},
        legend={"orientation": "h", "y": -0.2, "x": 0, "font_size": 12},
        uirevision="prior space",
        hovermode="closest",
    )
    return figure


def _rectangles(rows: list[list[float]]) -> go.Scatter:
    # One outline after another; None separates them.
    x: list[float | None] = []
    y: list[float | None] = []
    for bottom, top, left, right in rows:
        x += [left, right, right, left, left, None]
        y += [bottom, bottom, top, top, bottom, None]
    return go.Scatter(
        x=x,
        y=y,
        fill="toself",
        mode="lines",
        line={"color": palette.MARK, "width": 1.5},
        name="same scores",
        hoverinfo="skip",
    )


@dataclass(frozen=True, eq=False, slots=True)
class DrawingFront:
    """The front of one drawing, and where two pairs lie in its chart.

    ``source`` and ``chosen`` are precision and recall of the source's pair and of the
    chosen one.
    """

    name: str
    front: ParetoFront
    source: Pair
    chosen: Pair


def overlay_figure(
    drawn: list[DrawingFront], axes: FrontAxes, min_recall: float
) -> go.Figure:
    """The fronts of several drawings, as in Fig. 4.7; a click chooses a pair."""
    figure = study_figure({one.name: one.front for one in drawn}, axes, min_recall)
    points: list[Pair] = []
    for i, one in enumerate(drawn):
        color = palette.SERIES[i % len(palette.SERIES)]
        points += scores_at(one.front)
        for symbol, scores, pair in (
            ("star", one.source, SOURCE_PAIR),
            ("circle-open", one.chosen, None),
        ):
            if scores[0] > 0.0 and scores[1] > 0.0:
                points.append(scores)
                mark = mark_trace(Mark(one.name, *scores, symbol, color, pair), axes)
                figure.add_trace(mark.update(showlegend=False))
    frame_front(figure, axes, points, "overlay")
    return figure


def study_figure(
    fronts: dict[str, ParetoFront], axes: FrontAxes, min_recall: float
) -> go.Figure:
    """The fronts of several drawings, each in its colour and dashes."""
    figure = go.Figure()
    for i, (name, front) in enumerate(fronts.items()):
        color, dash = palette.SERIES[i % len(palette.SERIES)], DASHES[i % len(DASHES)]
        figure.add_trace(front_steps(front, axes, color, name, dash))
        dots = front_points(front, axes, min_recall)
        figure.add_trace(dots.update(marker_color=color, marker_size=6))
    threshold(figure, axes, min_recall)
    points = [point for front in fronts.values() for point in scores_at(front)]
    frame_front(figure, axes, points, "study")
    return figure


def region_figure(
    count: Any, values: list[float], n_drawings: int, chosen: Pair
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
    figure.add_traces(pair_marks([], chosen))
    near = [f"near {n} of {n_drawings} fronts" for row in count.tolist() for n in row]
    figure.add_trace(pair_targets(values, near))
    half = (values[1] - values[0]) / 2
    square_axes_of(figure, LOW - half, HIGH + half)
    figure.update_layout(
        height=FRONT_PX,
        margin={"l": 44, "r": 0, "t": 10, "b": 84},
        legend={"orientation": "h", "y": -0.2, "x": 0, "font_size": 12},
        uirevision="region",
        hovermode="closest",
        hoverdistance=40,
    )
    return figure
