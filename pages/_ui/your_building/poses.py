"""A figure of the poses on the drawing: where the robot stands and looks."""

import base64
import math
from collections.abc import Iterable

import plotly.graph_objects as go

from occsim.building import Building
from pages._ui import palette
from pages._ui.your_building import detecting

MANY = 800
"""Arrows beyond this number would cover the drawing and slow the page."""


def poses_figure(building: Building, height_px: int) -> go.Figure:
    """Draw every pose as an arrow, those in walls or outside as crosses."""
    height, width = building.drawing.shape
    is_bad = building.is_outside | building.is_inside_walls
    figure = go.Figure()
    x, y, theta = building.trajectory.poses.T
    figure.add_scatter(
        x=x,
        y=y,
        mode="lines",
        line={"color": palette.PATH, "width": 1},
        opacity=0.5,
        hoverinfo="skip",
    )
    _add_poses(figure, building, ~is_bad, "free", palette.ROBOT)
    _add_poses(figure, building, is_bad, "in a wall or outside", palette.FALSE_WALL)
    encoded = base64.b64encode(detecting.backdrop(building.drawing)).decode()
    figure.add_layout_image(
        source=f"data:image/png;base64,{encoded}",
        xref="x",
        yref="y",
        x=0,
        y=0,
        sizex=width,
        sizey=height,
        sizing="stretch",
        opacity=0.6,
        layer="below",
    )
    left, right = _reach(x, width)
    top, bottom = _reach(y, height)
    figure.update_xaxes(range=[left, right], visible=False, constrain="domain")
    figure.update_yaxes(
        range=[bottom, top], visible=False, scaleanchor="x", constrain="domain"
    )
    figure.update_layout(
        height=height_px,
        margin={"l": 0, "r": 0, "t": 0, "b": 0},
        showlegend=False,
        plot_bgcolor=palette.PAPER,
        uirevision=building.drawing.digest,
    )
    return figure


def _reach(places: Iterable[float], size: int) -> tuple[float, float]:
    """The range to show: the drawing, and poses not far outside of it."""
    margin, edge = 0.25 * size, 0.02 * size
    outside = [p for p in places if -margin <= p < 0 or size < p <= size + margin]
    low, high = min(outside, default=0.0), max(outside, default=0.0)
    return (low - edge if low < 0 else 0.0), (high + edge if high > size else size)


def _add_poses(
    figure: go.Figure, building: Building, chosen: object, what: str, colour: str
) -> None:
    x, y, theta = building.trajectory.poses[chosen].T
    is_free = what == "free"
    few = len(x) <= MANY
    marker = {"color": colour, "size": 8 if few else 4}
    if few:
        # Plotly's arrow points up at 0 and turns clockwise, as headings do.
        degrees = [math.degrees(angle) for angle in theta]
        marker["angle"] = [90 + angle for angle in degrees] if is_free else 0
        marker["symbol"] = "arrow" if is_free else "x"
    figure.add_scatter(
        x=x,
        y=y,
        mode="markers",
        marker=marker,
        customdata=[math.degrees(angle) for angle in theta],
        hovertemplate="x %{x:.1f} px, y %{y:.1f} px, heading %{customdata:.0f}°"
        f"<extra>{what}</extra>",
    )
