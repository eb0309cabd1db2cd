"""Plotly figures of surfaces over prior pairs: arrays in, figure out."""

import base64

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from occsim.prior import SOURCE_PAIR
from pages._ui import palette, words
from pages._ui.choices import Surface
from pages._ui.priors.surfaces import HIGH, LOW, SurfaceView

Pair = tuple[float, float]
P_WALL, P_SPACE = words.chart("p_wall"), words.chart("p_space")
SURFACE_PX = 400
ROW_PX = 250
ROW_GAP_PX = 56
COLUMN_GAP = 0.12
TICKS = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
TEN_PERCENT = 10.0

# Shown where a score is undefined: the heatmap is transparent there.
_HATCH = f"""<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400">
<defs><pattern id="h" width="10" height="10" patternUnits="userSpaceOnUse">
<rect width="10" height="10" fill="{palette.UNSEEN}"/>
<path d="M0 10L10 0" stroke="{palette.UNSEEN_HATCH}"/></pattern></defs>
<rect width="400" height="400" fill="url(#h)"/></svg>"""
HATCH = "data:image/svg+xml;base64," + base64.b64encode(_HATCH.encode()).decode()


def colour_range(views: list[SurfaceView]) -> Pair:
    """Ends of a colour scale shared by some surfaces, in percent."""
    low = min(view.range[0] for view in views)
    high = max(view.range[1] for view in views)
    if views[0].kind is Surface.DIFFERENCE:
        limit = max(-low, high, 1.0)
        return -limit, limit
    return TEN_PERCENT * min(low // TEN_PERCENT, 9.0), 100.0


def heatmap(view: SurfaceView, ends: Pair, bar: dict | None) -> go.Heatmap:
    """One surface in colours; ``bar`` describes its colour bar, None leaves it out."""
    difference = view.kind is Surface.DIFFERENCE
    return go.Heatmap(
        x=view.values,
        y=view.values,
        z=view.percent.astype("float32"),
        zmin=ends[0],
        zmax=ends[1],
        colorscale=palette.EVIDENCE_SCALE if difference else palette.SCORE_SCALE,
        showscale=bar is not None,
        colorbar=bar,
        hoverinfo="skip",
    )


def surface_figure(
    view: SurfaceView,
    *,
    ends: Pair,
    chosen: Pair,
    best: list[Pair],
    front: list[Pair] | None = None,
) -> go.Figure:
    """One surface with the chosen pair, the source's and the best ones."""
    bar = {"title": {"text": view.unit}, "thickness": 12, "len": 1.0}
    figure = go.Figure(heatmap(view, ends, bar))
    if front:
        figure.add_trace(front_dots(front))
    figure.add_traces([*pair_marks(best, chosen), target_layer(view)])
    square_axes(figure, view)
    figure.update_layout(
        title={"text": view.objective.value.capitalize(), "x": 0.0, "font_size": 15},
        height=SURFACE_PX,
        margin={"l": 44, "r": 0, "t": 34, "b": 66},
        legend={"orientation": "h", "y": -0.13, "x": 0, "font_size": 12},
        uirevision="surface",
        hovermode="closest",
        hoverdistance=40,
    )
    return figure


def rows_figure(
    rows: list[list[SurfaceView]], titles: list[str], ends: list[Pair], chosen: Pair
) -> go.Figure:
    """Surfaces of several drawings in rows, one column for each objective."""
    n_columns = len(rows[0])
    figure = make_subplots(
        rows=len(rows),
        cols=n_columns,
        subplot_titles=[
            f"{title}: {view.objective.value}"
            for title, views in zip(titles, rows, strict=True)
            for view in views
        ],
        horizontal_spacing=COLUMN_GAP,
        vertical_spacing=ROW_GAP_PX / (ROW_PX * len(rows)),
    )
    for i, views in enumerate(rows, start=1):
        for j, view in enumerate(views, start=1):
            bar = _column_bar(view.unit, j, n_columns) if i == 1 else None
            at = {"row": i, "col": j}
            figure.add_trace(heatmap(view, ends[j - 1], bar), **at)
            for mark in pair_marks([], chosen):
                shown = mark.name != "" and i == j == 1
                figure.add_trace(mark.update(showlegend=shown), **at)
            half = (view.values[1] - view.values[0]) / 2
            low, high = LOW - half, HIGH + half
            figure.add_layout_image(hatch_image(low, high), **at)
            number = (i - 1) * n_columns + j
            anchor = "x" if number == 1 else f"x{number}"
            axes = {"constrain": "domain", "tickvals": TICKS[::3], "showgrid": False}
            axes["range"] = [low, high]
            figure.update_xaxes(**axes, **at)
            figure.update_yaxes(scaleanchor=anchor, **axes, **at)
    figure.update_xaxes(title_text=P_SPACE, row=len(rows))
    figure.update_yaxes(title_text=P_WALL, col=1)
    figure.update_annotations(font_size=12)
    figure.update_layout(
        height=ROW_PX * len(rows) + 160,
        margin={"l": 48, "r": 8, "t": 60, "b": 100},
        legend={"orientation": "h", "y": 1.0, "yanchor": "top", "yref": "container"},
        uirevision="rows",
        hovermode=False,
    )
    return figure


def _column_bar(unit: str, column: int, n_columns: int) -> dict:
    # Plotly places a colour bar by shares of the paper, not by its subplot.
    width = (1.0 - COLUMN_GAP * (n_columns - 1)) / n_columns
    centre = (column - 0.5) * width + (column - 1) * COLUMN_GAP
    return {
        "orientation": "h",
        "thickness": 10,
        "len": 0.8 * width,
        "ticksuffix": " %" if unit == "%" else "",
        "nticks": 4,
        "x": centre,
        "y": 0,
        "yanchor": "top",
        "ypad": 62,
    }


def pair_marks(best: list[Pair], chosen: Pair) -> list[go.Scatter]:
    """Marks of the best pairs, the source's and the chosen one."""
    dark = {"color": "black", "width": 1}
    marks = []
    if best:
        symbol = {"symbol": "triangle-up", "size": 9, "color": "white", "line": dark}
        marks.append(_mark(best, "maximum", symbol))
    star = {"symbol": "star", "size": 13, "color": "white", "line": dark}
    marks.append(_mark([SOURCE_PAIR], "source's", star))
    halo = {"symbol": "circle-open", "size": 17, "color": palette.HALO}
    ring = {"symbol": "circle-open", "size": 17, "color": palette.MARK}
    marks.append(
        _mark([chosen], "", {**halo, "line": {"width": 6}}).update(showlegend=False)
    )
    marks.append(_mark([chosen], "chosen", {**ring, "line": {"width": 3}}))
    return marks


def front_dots(front: list[Pair]) -> go.Scatter:
    """The pairs of the exact front, black as in the source's Fig. 4.6c."""
    line = {"color": "white", "width": 0.7}
    marker = {"size": 5, "color": "black", "line": line}
    return _mark(front, "exact front", marker)


def _mark(pairs: list[Pair], name: str, marker: dict) -> go.Scatter:
    return go.Scatter(
        x=[p_space for _, p_space in pairs],
        y=[p_wall for p_wall, _ in pairs],
        mode="markers",
        name=name,
        marker=marker,
        hoverinfo="skip",
        cliponaxis=False,
    )


def target_layer(view: SurfaceView) -> go.Scatter:
    """The points of a surface that react to pointer and click."""
    values, texts = view.targets()
    return pair_targets(values, [f"{view.objective.value} {text}" for text in texts])


def pair_targets(values: list[float], texts: list[str]) -> go.Scatter:
    """Invisible points over a heatmap, row by row: it cannot be clicked itself."""
    return go.Scatter(
        x=values * len(values),
        y=[p_wall for p_wall in values for _ in values],
        text=texts,
        mode="markers",
        marker={"opacity": 0, "size": 6},
        selected={"marker": {"opacity": 0}},
        unselected={"marker": {"opacity": 0}},
        hovertemplate=words.chart(
            "p_wall %{y:.2f}<br>p_space %{x:.2f}<br>%{text}<extra></extra>"
        ),
        showlegend=False,
    )


def square_axes(figure: go.Figure, view: SurfaceView) -> None:
    """The axes of a surface, and its background."""
    half = (view.values[1] - view.values[0]) / 2
    low, high = LOW - half, HIGH + half
    square_axes_of(figure, low, high)
    figure.update_layout(xaxis_showgrid=False, yaxis_showgrid=False)
    figure.add_layout_image(hatch_image(low, high))


def square_axes_of(figure: go.Figure, low: float, high: float) -> None:
    """p_space to the right and p_wall up, one as long as the other."""
    shared = {"constrain": "domain", "zeroline": False, "title_standoff": 4}
    shared |= {"range": [low, high], "fixedrange": True, "tickvals": TICKS, "ticks": ""}
    figure.update_xaxes(title_text=P_SPACE, constraintoward="left", **shared)
    figure.update_yaxes(
        title_text=P_WALL,
        constraintoward="top",
        scaleanchor="x",
        **shared,
    )


def hatch_image(low: float, high: float) -> dict:
    """The background of a surface."""
    size = {"x": low, "y": high, "sizex": high - low, "sizey": high - low}
    where = {"xref": "x", "yref": "y", "sizing": "stretch", "layer": "below"}
    return {"source": HATCH, **size, **where}
