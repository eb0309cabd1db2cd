"""How many beams are enough: the sentence on the page, and the curve beside it."""

from dataclasses import replace

import pytest

from occsim import BehindHit, sample_names
from pages._ui import beams_lesson, compute
from pages._ui.settings import Settings
from tests.test_pages import launch


def opening(name, behind_hit=BehindHit.OCCUPIED):
    range_px = round(compute.sample(name).sensor.range_px)
    column = replace(Settings().columns[0], behind_hit=behind_hit)
    return Settings(range_px=range_px, columns=(column,))


def by_number(name, settings):
    numbers = beams_lesson.tried(settings)
    far = beams_lesson.distances(compute.sample(name), settings)
    return dict(zip(numbers, far, strict=True))


@pytest.mark.parametrize("name", sample_names())
def test_the_sentence_holds_on_every_reference_drawing(name):
    settings = opening(name)
    rim_px = settings.dense_beams
    assert by_number(name, settings)[rim_px] < 0.005
    unseen = by_number(name, opening(name, BehindHit.UNSEEN))
    assert unseen[rim_px] > 0.01 > unseen[4 * rim_px]


@pytest.mark.parametrize("behind_hit", BehindHit)
@pytest.mark.parametrize("name", sample_names())
def test_the_curve_falls_to_the_exact_reading(name, behind_hit):
    """From a quarter of the rim's pixels to eight beams for each."""
    settings = opening(name, behind_hit)
    far = by_number(name, settings)
    few, many = far[round(settings.dense_beams / 4)], far[8 * settings.dense_beams]
    assert many < few / 6


def test_the_students_number_is_on_the_curve_and_marked():
    settings = replace(opening("d"), beams=7)
    numbers = beams_lesson.tried(settings)
    assert numbers == [1, 3, 6, 7, 11, 22, 44, 88]
    far = beams_lesson.distances(compute.sample("d"), settings)
    figure = beams_lesson.curve(numbers, far, settings)
    assert list(figure.data[0].y) == far
    said = dict(zip(figure.data[0].x, figure.data[0].text, strict=True))
    assert (said["7"], said["11"]) == ("yours", "one a pixel of the rim")


def test_the_curve_is_drawn_when_it_is_asked_for():
    app = launch("pages/3_Two_maps.py")
    assert not app.get("plotly_chart")
    next(b for b in app.button if b.label == "Compute it for this sensor").click().run()
    assert not app.exception
    assert app.get("plotly_chart")
    app.session_state["settings"] = replace(app.session_state["settings"], fov_deg=60)
    app.run()
    assert not app.get("plotly_chart")
