"""Plotly figures of a search: its population over the exact front, by generation."""

from typing import Any

import plotly.graph_objects as go
from plotly.subplots import make_subplots

from occsim.priors import ParetoFront
from pages._ui import palette
from pages._ui.choices import FrontAxes
from pages._ui.priors.front_figures import (
    WORDS,
    Drawn,
    axis_ends,
    front_points,
    front_steps,
    place,
)
from pages._ui.priors.fronts import scores_at
from pages._ui.priors.solving import SearchStep

SEARCH_PX = 540
BELOW = -0.17
"""Position of the buttons below the plot, as a share of its height."""
FRAME_MS = 120
POPULATION = palette.SERIES[1]
# Traces that a frame replaces: scores used, real scores, and the mark on the curve.
MOVING = [2, 3, 5]


def still_figure(
    steps: list[SearchStep], front: ParetoFront, axes: FrontAxes
) -> go.Figure:
    """The last generation over the exact front, and the hypervolume so far.

    Before the first generation there is the exact front alone.
    """
    exact = Drawn("exact front", front)
    figure = make_subplots(
        rows=2 if steps else 1,
        row_heights=[0.72, 0.28] if steps else None,
        vertical_spacing=0.16,
    )
    dots = front_points(exact, axes, 0.0).update(hoverinfo="skip", hovertemplate=None)
    for trace in (front_steps(exact, axes), dots):
        figure.add_trace(trace, row=1, col=1)
    _frame(figure, steps, front, axes)
    if steps:
        for trace in _population(steps[-1], axes):
            figure.add_trace(trace, row=1, col=1)
        figure.add_trace(_curve(steps), row=2, col=1)
        figure.add_trace(_curve_mark(steps[-1]), row=2, col=1)
        _frame_curve(figure, steps)
    return figure


def replay_figure(
    steps: list[SearchStep], front: ParetoFront, axes: FrontAxes
) -> go.Figure:
    """The same with a frame for every generation, a slider and two buttons."""
    figure = still_figure(steps, front, axes)
    if not steps:
        return figure
    figure.frames = [
        go.Frame(
            name=str(step.number),
            data=[*_population(step, axes), _curve_mark(step)],
            traces=MOVING,
        )
        for step in steps
    ]
    figure.update_layout(updatemenus=[_buttons()], sliders=[_slider(steps)])
    return figure


def _population(step: SearchStep, axes: FrontAxes) -> list[go.Scatter]:
    """The scores that the search used, and the real scores of its pairs."""
    promised, real = step.seen, step.real
    traces = []
    for scores, symbol, name in (
        (promised, "triangle-up-open", "population, as the search sees it"),
        (real, "triangle-up", "population"),
    ):
        if scores is None:
            traces.append(go.Scatter(x=[], y=[], name=name, showlegend=False))
            continue
        x, y = place(axes, scores[:, 0], scores[:, 1])
        marker = {"symbol": symbol, "size": 7, "color": POPULATION, "opacity": 0.8}
        traces.append(
            go.Scatter(
                x=x.astype("float32"),
                y=y.astype("float32"),
                mode="markers",
                marker=marker,
                name=name,
                hoverinfo="skip",
            )
        )
    return traces


def _curve(steps: list[SearchStep]) -> go.Scatter:
    return go.Scatter(
        x=[step.number for step in steps],
        y=[100.0 * step.share for step in steps],
        mode="lines",
        line={"color": POPULATION, "width": 2},
        showlegend=False,
        hovertemplate="generation %{x}: %{y:.2f} %<extra></extra>",
    )


def _curve_mark(step: SearchStep) -> go.Scatter:
    return go.Scatter(
        x=[step.number],
        y=[100.0 * step.share],
        mode="markers",
        marker={"symbol": "triangle-up", "size": 11, "color": POPULATION},
        showlegend=False,
        hoverinfo="skip",
    )


def _frame(
    figure: go.Figure, steps: list[SearchStep], front: ParetoFront, axes: FrontAxes
) -> None:
    places = [place(axes, precision, recall) for precision, recall in scores_at(front)]
    for which, update in enumerate((figure.update_xaxes, figure.update_yaxes)):
        # The ends are the same for all generations: those of the exact front.
        ends = axis_ends(axes, [where[which] for where in places], 0.25)
        update(title_text=WORDS[axes][which], range=ends, row=1, zeroline=False)
    figure.update_layout(
        title={"text": "The population and the exact front", "x": 0.0, "font_size": 14},
        height=SEARCH_PX if steps else SEARCH_PX * 2 // 3,
        margin={"l": 56, "r": 8, "t": 64, "b": 8},
        legend={"orientation": "h", "y": 1.0, "yanchor": "bottom", "x": 0},
        uirevision="search",
        showlegend=True,
    )


def _frame_curve(figure: go.Figure, steps: list[SearchStep]) -> None:
    last = max(steps[-1].number, 2)
    figure.update_xaxes(title_text="generation", range=[0.5, last + 0.5], row=2)
    low = min([100.0 * step.share for step in steps if step.share == step.share] + [95])
    figure.update_yaxes(
        title_text="hypervolume, %", range=[low - 2, 100], row=2, zeroline=False
    )
    words = {"text": "exact front", "font_size": 11, "yanchor": "top"}
    line = {"dash": "dot", "width": 1, "color": palette.GUIDE}
    figure.add_hline(100, row=2, col=1, line=line, annotation=words)


def _buttons() -> dict[str, Any]:
    timing = {"frame": {"duration": FRAME_MS}, "transition": {"duration": 0}}
    play = {"args": [None, {**timing, "mode": "immediate"}]}
    pause = {"args": [[None], {"mode": "immediate", "frame": {"duration": 0}}]}
    return {
        "type": "buttons",
        "direction": "left",
        "showactive": False,
        "x": 0,
        "y": BELOW,
        "xanchor": "left",
        "yanchor": "top",
        "bgcolor": palette.UNSEEN,
        "font": {"color": "black"},
        "buttons": [
            {"label": "Play", "method": "animate", **play},
            {"label": "Pause", "method": "animate", **pause},
        ],
    }


def _slider(steps: list[SearchStep]) -> dict[str, Any]:
    jump = {"mode": "immediate", "frame": {"duration": 0}}
    return {
        "active": len(steps) - 1,
        "y": BELOW,
        "pad": {"t": 36},
        "ticklen": 0,
        "minorticklen": 0,
        # The labels of the steps appear only in the text above the slider.
        "font": {"size": 1, "color": "rgba(0,0,0,0)"},
        "currentvalue": {
            "prefix": "generation ",
            "xanchor": "right",
            "font": {"size": 13, "color": palette.GUIDE},
        },
        "steps": [
            {
                "label": str(step.number),
                "method": "animate",
                "args": [[str(step.number)], jump],
            }
            for step in steps
        ],
    }
