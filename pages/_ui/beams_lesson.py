"""How many beams come as near to the exact reading as a map needs."""

import plotly.graph_objects as go
import streamlit as st

from occsim import MapSettings, Sensor, Trajectory, beam_distances
from occsim.building import Building
from pages._ui import compute, palette, state
from pages._ui.choices import CHOICES
from pages._ui.controls import chart
from pages._ui.settings import Settings
from pages._ui.shared import shared

SHARES = (1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8)
"""Numbers of beams that are tried, for each pixel of the view's rim."""
SOME_POSES = 60
"""Most poses of the tour that are tried: the distance is a mean over cells."""
WIDTH_PX, HEIGHT_PX = 640, 280
TRIED = "beams_tried"
FINDING = (
    "By default every pixel in view is read by a ray of its own. A range finder has "
    "beams, and each stands for the sector half-way to its neighbours. On all five "
    "reference drawings, as they open, one beam for each pixel of the view's rim is "
    "within 0.005 nats of the exact reading of a cell, on average. Where nothing is "
    "said behind a hit, a wall's surface is all that is read: four times as many "
    "beams are needed to come within 0.01 nats."
)


def section() -> None:
    """Draw the finding, and a button that computes the curve for what is chosen."""
    with st.expander("How many beams are enough?"):
        st.markdown(FINDING)
        building, settings = state.building(), state.settings()
        mapping = _of_map_a(settings)
        key = repr((building.digest, mapping.sensor, mapping.cell_px))
        if st.button("Compute it for this sensor"):
            state.set_view(TRIED, key)
        if state.view(TRIED, None) == key:
            numbers = tried(settings)
            figure = curve(numbers, distances(building, settings), settings)
            with st.container(width=WIDTH_PX):
                st.plotly_chart(figure, config=chart("beams"), key="beams_curve")
            st.caption(
                f"Cells of {mapping.cell_px} px; behind a hit: "
                f"{CHOICES[mapping.sensor.behind_hit].lower()}, as in map A. 0 is the "
                "exact reading. Nats: the log-odds of one clear reading are 2.2."
            )


def tried(settings: Settings) -> list[int]:
    """Numbers of beams, from far too few to more than enough, and the student's."""
    rim_px = settings.dense_beams
    numbers = {max(1, round(rim_px * share)) for share in SHARES}
    return sorted(numbers | ({settings.beams} - {0}))


def distances(building: Building, settings: Settings) -> list[float]:
    """How far each of these numbers is from exact readings, nats."""
    mapping, numbers = _of_map_a(settings), tuple(tried(settings))
    return _distances(
        building.digest, mapping.sensor, mapping.cell_px, numbers, building
    )


def _of_map_a(settings: Settings) -> MapSettings:
    return settings.mapping_of(settings.columns[0])


@shared("Trying numbers of beams")
def _distances(
    digest: str,
    sensor: Sensor,
    cell_px: int,
    numbers: tuple[int, ...],
    _building: Building,
) -> list[float]:
    poses = _building.trajectory.poses
    some = Trajectory(poses[:: -(-len(poses) // SOME_POSES)])
    world = _building.world
    with compute.core():
        found = beam_distances(world, some, sensor, world.grid(cell_px), numbers)
        return [float(one) for one in found]


def curve(numbers: list[int], far: list[float], settings: Settings) -> go.Figure:
    """The distance by the number of beams; the student's number is marked."""
    marks = {settings.dense_beams: "one a pixel of the rim", settings.beams: "yours"}
    figure = go.Figure(
        go.Scatter(
            x=[str(number) for number in numbers],
            y=far,
            mode="lines+markers+text",
            text=[marks.get(number, "") for number in numbers],
            textposition="top right",
            line={"color": palette.SERIES[0], "width": 2},
            hovertemplate="%{x} beams: %{y:.4f} nats<extra></extra>",
        )
    )
    figure.update_xaxes(title_text="beams", type="category")
    figure.update_yaxes(title_text="from exact, nats", rangemode="tozero")
    figure.update_layout(
        height=HEIGHT_PX,
        margin={"l": 8, "r": 8, "t": 24, "b": 8},
        uirevision="beams",
        showlegend=False,
    )
    return figure
