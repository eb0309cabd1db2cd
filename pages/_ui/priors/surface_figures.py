"""Plotly figures of surfaces over prior pairs: arrays in, figure out."""

import base64

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from pages._ui import palette, words
from pages._ui.priors.marks import MarkedPrior
from pages._ui.priors.surfaces import HIGH, LOW, TARGETS, SurfaceView

Pair = tuple[float, float]
P_WALL, P_SPACE = words.chart("p_wall"), words.chart("p_space")
SURFACE_PX = 330
ROW_PX = 250
ROW_GAP_PX = 56
COLUMN_GAP = 0.1
TICKS = [0.1, 0.4, 0.7, 1.0]
TITLE = {"x": 0.0, "y": 1.0, "yanchor": "top", "font": {"size": 14}}
TEN_PERCENT = 10.0
MOST_BITS = 2.0
"""End of the scale of bits, twice the loss of knowing nothing: a few confident and
wrong pairs lose far more, and would make all others look alike."""

# Shown where a score is undefined: the heatmap is transparent there.
_HATCH = f"""<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400">
<defs><pattern id="h" width="10" height="10" patternUnits="userSpaceOnUse">
<rect width="10" height="10" fill="{palette.UNSEEN}"/>
<path d="M0 10L10 0" stroke="{palette.UNSEEN_HATCH}"/></pattern></defs>
<rect width="400" height="400" fill="url(#h)"/></svg>"""
HATCH = "data:image/svg+xml;base64," + base64.b64encode(_HATCH.encode()).decode()


def colour_range(views: list[SurfaceView]) -> Pair:
    """Ends of a colour scale shared by some surfaces of one score."""
    low = min(view.range[0] for view in views)
    high = max(view.range[1] for view in views)
    if views[0].is_difference:
        limit = max(-low, high, 1.0)
        return -limit, limit
    if views[0].less_is_better:
        return 0.0, max(min(high, MOST_BITS), 0.1)
    return TEN_PERCENT * min(low // TEN_PERCENT, 9.0), 100.0


def heatmap(view: SurfaceView, ends: Pair, bar: dict | None) -> go.Heatmap:
    """One surface in colours; ``bar`` describes its colour bar, None leaves it out."""
    colours = palette.EVIDENCE_SCALE if view.is_difference else palette.SCORE_SCALE
    return go.Heatmap(
        x=view.values,
        y=view.values,
        z=view.table.astype("float32"),
        zmin=ends[0],
        zmax=ends[1],
        colorscale=colours,
        reversescale=view.less_is_better,
        showscale=bar is not None,
        colorbar=bar,
        hoverinfo="skip",
    )


def blank_contour(view: SurfaceView) -> list[go.Contour]:
    """The border of the pairs that are better than the blank map."""
    if view.blank != view.blank:
        return []
    # Just beyond the blank map's value, which a whole step of the surface may have.
    level = view.blank + (-1e-4 if view.less_is_better else 1e-4)
    return [
        go.Contour(
            x=view.values,
            y=view.values,
            z=view.table.astype("float32"),
            contours={"start": level, "end": level, "size": 1, "coloring": "none"},
            line={"color": palette.BLANK_LINE, "width": 2, "smoothing": 0},
            showlegend=False,
            showscale=False,
            hoverinfo="skip",
        )
    ]


def surface_figure(
    view: SurfaceView,
    *,
    ends: Pair,
    chosen: Pair,
    marked: list[MarkedPrior],
    dots: list[Pair],
) -> go.Figure:
    """One surface with its marks and some dots: a click on it chooses a pair."""
    bar = {"thickness": 10, "len": 1.0, "nticks": 5, "xpad": 4}
    half = (view.values[1] - view.values[0]) / 2
    low, high = LOW - half, HIGH + half
    about = f"<span style='font-size:11px;font-weight:400'>{against_blank(view)}</span>"
    return go.Figure(
        data=[
            heatmap(view, ends, bar),
            *blank_contour(view),
            *([pair_dots(dots)] if dots else []),
            *pair_marks(marked, chosen),
            target_layer(view),
        ],
        layout={
            "title": {**TITLE, "text": f"{title(view)}<br>{about}", "pad": {"t": 16}},
            "images": [hatch_image(low, high)] if view.has_gaps else [],
            "height": SURFACE_PX,
            "margin": {"l": 40, "r": 0, "t": 50, "b": 34},
            "showlegend": False,
            "uirevision": "surface",
            "hovermode": "closest",
            "hoverdistance": 40,
            **pair_axes(low, high, showgrid=False),
        },
    )


def title(view: SurfaceView) -> str:
    """The score of a surface and its unit."""
    if view.is_difference:
        return f"{view.name.capitalize()}: interpolated less exact, points"
    if view.less_is_better:
        return "Bits per cell (log loss)"
    return f"{view.name.capitalize()}, {view.unit}"


def against_blank(view: SurfaceView) -> str:
    """How many pairs are better than the blank map."""
    if view.blank != view.blank:
        return "" if view.is_difference else "blank map: undefined"
    value, share = view.text(view.blank), 100.0 * view.share_above_blank
    return f"blank map {value}; better: {share:.0f} % of the pairs"


def rows_figure(
    rows: list[list[SurfaceView]],
    titles: list[str],
    ends: list[Pair],
    marked: list[list[MarkedPrior]],
    chosen: Pair,
) -> go.Figure:
    """Surfaces of several drawings in rows, one column for each score."""
    n_columns = len(rows[0])
    figure = make_subplots(
        rows=len(rows),
        cols=n_columns,
        subplot_titles=[
            f"{name}: {view.name}"
            for name, row in zip(titles, rows, strict=True)
            for view in row
        ],
        horizontal_spacing=COLUMN_GAP,
        vertical_spacing=ROW_GAP_PX / (ROW_PX * len(rows)),
    )
    for i, (row, marks) in enumerate(zip(rows, marked, strict=True), start=1):
        for j, view in enumerate(row, start=1):
            bar = _column_bar(view.unit, j, n_columns) if i == 1 else None
            layers = [heatmap(view, ends[j - 1], bar), *blank_contour(view)]
            _subplot(figure, [*layers, *pair_marks(marks, chosen)], view, i, j)
    figure.update_xaxes(title_text=P_SPACE, row=len(rows))
    figure.update_yaxes(title_text=P_WALL, col=1)
    figure.update_annotations(font_size=12)
    figure.update_layout(
        height=ROW_PX * len(rows) + 130,
        margin={"l": 48, "r": 8, "t": 30, "b": 100},
        showlegend=False,
        uirevision="rows",
        hovermode=False,
    )
    return figure


def _subplot(
    figure: go.Figure, traces: list, view: SurfaceView, row: int, col: int
) -> None:
    """Fill one place of a grid of surfaces."""
    at = {"row": row, "col": col}
    for trace in traces:
        figure.add_trace(trace, **at)
    half = (view.values[1] - view.values[0]) / 2
    low, high = LOW - half, HIGH + half
    if view.has_gaps:
        figure.add_layout_image(hatch_image(low, high), **at)
    axes = {"tickvals": TICKS, "showgrid": False, "range": [low, high]}
    figure.update_xaxes(**axes, **at)
    figure.update_yaxes(**axes, **at)


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


def pair_marks(marked: list[MarkedPrior], chosen: Pair) -> list[go.Scatter]:
    """The marked priors, and a ring round the chosen pair."""
    dark = {"color": palette.OUTLINE, "width": 1}
    look = {"symbol": [one.symbol for one in marked], "size": 11, "line": dark}
    texts = [words.chart(one.text) for one in marked]
    marks = _points([one.pair for one in marked], {**look, "color": palette.HALO})
    # One ring within the other: a halo on any ground.
    widths = {"line": {"width": [6, 3]}, "color": [palette.HALO, palette.MARK]}
    ring = {"symbol": "circle-open", "size": 17, **widths}
    return [
        marks.update(hoverinfo="text", hovertext=texts),
        _points([chosen, chosen], ring),
    ]


def pair_dots(pairs: list[Pair]) -> go.Scatter:
    """Pairs of the exact front, or of the table's maximum: black, as in Fig. 4.6c."""
    line = {"color": palette.HALO, "width": 0.7}
    return _points(pairs, {"size": 5, "color": palette.OUTLINE, "line": line})


def _points(pairs: list[Pair], marker: dict) -> go.Scatter:
    return go.Scatter(
        x=[p_space for _, p_space in pairs],
        y=[p_wall for p_wall, _ in pairs],
        mode="markers",
        marker=marker,
        hoverinfo="skip",
        cliponaxis=False,
        selected={"marker": {"opacity": 1}},
        unselected={"marker": {"opacity": 1}},
        showlegend=False,
    )


def target_layer(view: SurfaceView) -> go.Scatter:
    """The points of a surface that react to pointer and click."""
    return pair_targets(TARGETS, view.target_texts(), f"{view.name} %{{text}}")


def pair_targets(
    values: list[float], texts: list[str], about: str = "%{text}"
) -> go.Scatter:
    """Invisible points over a heatmap, row by row: it cannot be clicked itself."""
    return go.Scatter(
        x=values * len(values),
        y=[p_wall for p_wall in values for _ in values],
        text=texts,
        mode="markers",
        marker={"opacity": 0, "size": 6},
        selected={"marker": {"opacity": 0}},
        unselected={"marker": {"opacity": 0}},
        hovertemplate=words.chart("p_wall %{y:.2f}<br>p_space %{x:.2f}<br>")
        + f"{about}<extra></extra>",
        showlegend=False,
    )


def pair_axes(low: float, high: float, *, showgrid: bool = True) -> dict:
    """p_space to the right and p_wall up."""
    shared = {"range": [low, high], "fixedrange": True, "tickvals": TICKS, "ticks": ""}
    shared |= {"zeroline": False, "showgrid": showgrid}
    return {
        f"{axis}axis": {**shared, "title": {"text": name, "standoff": 2}}
        for axis, name in (("x", P_SPACE), ("y", P_WALL))
    }


def hatch_image(low: float, high: float) -> dict:
    """The background of a surface."""
    size = {"x": low, "y": high, "sizex": high - low, "sizey": high - low}
    where = {"xref": "x", "yref": "y", "sizing": "stretch", "layer": "below"}
    return {"source": HATCH, **size, **where}
