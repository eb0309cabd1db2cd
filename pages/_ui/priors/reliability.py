"""Whether a map means what it says: stated against true shares of free cells."""

import plotly.graph_objects as go
import streamlit as st

from occsim import Prior, Reliability, reliability
from pages._ui import palette, words
from pages._ui.choices import CHOICES
from pages._ui.controls import chart
from pages._ui.priors.answers import Answer
from pages._ui.runs import Run

HEIGHT_PX = 320
SMALLEST_PX, LARGEST_PX = 5.0, 22.0


def diagram(run: Run, given: Answer) -> None:
    """The reliability diagram of an answer's map, and that of the blank map."""
    title = CHOICES[given.kind]
    series = {
        title: _of(run, given.prior or Prior.uninformative(), given),
        "blank map": _of(run, Prior.uninformative(), given),
    }
    st.plotly_chart(figure(series), config=chart("reliability"), key="reliability")
    errors = "; ".join(
        f"{name} {words.percent(one.expected_calibration_error)}"
        for name, one in series.items()
    )
    st.caption(
        "All cells, in ten bins by the probability of free that the map states. On the "
        "line, the map means what it says. Expected calibration error, the mean "
        f"distance from the line over all cells: {errors}."
    )


def _of(run: Run, prior: Prior, given: Answer) -> Reliability:
    return reliability(run.mapped.map(prior, given.rule), run.mapped.truth_cells)


def figure(series: dict[str, Reliability]) -> go.Figure:
    """Share of free cells over the stated probability; larger marks, more cells."""
    line = {"color": palette.GUIDE, "dash": "dash", "width": 1}
    drawn = go.Figure(
        go.Scatter(
            x=[0, 1],
            y=[0, 1],
            mode="lines",
            line=line,
            name="means what it says",
            hoverinfo="skip",
        )
    )
    for (name, one), color in zip(
        series.items(), (palette.SERIES[0], palette.GUIDE), strict=True
    ):
        drawn.add_trace(_marks(name, one, color))
    drawn.update_layout(
        height=HEIGHT_PX,
        margin={"l": 48, "r": 8, "t": 8, "b": 44},
        legend={"orientation": "h", "y": -0.32, "x": 0},
        xaxis={"title": "stated probability of free", "range": [-0.04, 1.04]},
        yaxis={"title": "share that is free", "range": [-0.04, 1.04]},
        uirevision="reliability",
    )
    return drawn


def _marks(name: str, one: Reliability, color: str) -> go.Scatter:
    bins = [
        (stated, free, count)
        for stated, free, count in zip(
            one.mean_p_free.tolist(),
            one.share_free.tolist(),
            one.count.tolist(),
            strict=True,
        )
        if count
    ]
    most = max((count for *_, count in bins), default=1)
    sizes = [
        SMALLEST_PX + (LARGEST_PX - SMALLEST_PX) * (count / most) ** 0.5
        for *_, count in bins
    ]
    return go.Scatter(
        x=[stated for stated, *_ in bins],
        y=[free for _, free, _ in bins],
        customdata=[count for *_, count in bins],
        mode="markers",
        marker={"size": sizes, "color": color, "opacity": 0.75},
        name=name,
        hovertemplate=(
            "stated %{x:.3f}, free %{y:.3f}<br>%{customdata:,} cells<extra></extra>"
        ),
    )
