"""The sensor's beams and errors on the pages: settings, presets, and the default."""

import math

import pytest

from occsim import BehindHit, ScanNoise
from occsim.scan import RANGE_FINDERS
from pages._ui import compute, finders, replays
from pages._ui.choices import CHOICES
from pages._ui.controls import _decimals
from pages._ui.settings import TABLE, Settings, decode, encode, with_changes
from tests.test_pages import control, launch

BUILD, TWO_MAPS = "pages/1_Build_a_map.py", "pages/3_Two_maps.py"
SCALE = 0.0225  # of sample a, m a px


def test_readings_are_exact_unless_beams_or_errors_are_asked_for():
    assert Settings().scan is None
    assert Settings(noise_seed=5).scan is None
    assert Settings(beams=9).scan.n_beams == 9
    assert Settings(beams=9).scan.noise is None


def test_errors_without_a_number_of_beams_take_them_a_pixel_apart():
    settings = Settings(range_px=40, fov_deg=30, dropout_share=0.1, noise_seed=3)
    # 40 px x pi / 6 = 20.9
    assert settings.scan.n_beams == 21
    assert settings.scan.noise.dropout_share == 0.1
    assert settings.scan.seed == 3
    most = Settings(range_px=300, fov_deg=360, dropout_share=0.1).scan.n_beams
    assert most == TABLE["beams"].high == 1081


def test_every_error_of_the_settings_reaches_the_noise():
    settings = Settings(
        sigma_0_m=0.1,
        sigma_2_per_m=0.002,
        sigma_from_m=1.0,
        dropout_share=0.1,
        short_share=0.2,
        glass_share=0.3,
        position_sigma_m=0.05,
        heading_sigma_deg=2.0,
        odometry_drift=0.01,
    )
    assert settings.noise == ScanNoise(
        metres_per_px=1.0,
        sigma_0_m=0.1,
        sigma_2_per_m=0.002,
        sigma_from_m=1.0,
        dropout_share=0.1,
        short_share=0.2,
        glass_share=0.3,
        position_sigma_m=0.05,
        heading_sigma_rad=math.radians(2.0),
        alpha_1=0.01,
        alpha_2=0.01,
        alpha_3=0.01,
        alpha_4=0.01,
    )
    assert decode(encode(settings)) == (settings, [])


@pytest.mark.parametrize("name", finders.NAMES)
def test_a_range_finder_is_recognised_once_it_is_set(name):
    opening = Settings(range_px=40)
    wanted = finders.changes(name, opening, SCALE)
    settings = with_changes(opening, wanted)
    assert finders.current(settings, opening, SCALE) == name
    moved = with_changes(settings, {"dropout_share": 0.25})
    assert finders.current(moved, opening, SCALE) is None
    assert with_changes(moved, finders.changes("exact", opening, SCALE)) == opening


def test_a_range_finder_has_the_figures_of_its_sheet():
    wanted = finders.changes("urg-04lx", Settings(), SCALE)
    finder = RANGE_FINDERS["urg-04lx"]
    assert wanted["beams"] == finder.n_beams
    assert wanted["range_px"] == round(4.095 / SCALE)
    assert wanted["fov_deg"] == 240
    assert wanted["behind_hit"] is BehindHit.UNSEEN
    assert finders.reach_note("urg-04lx", SCALE) == ""
    assert finders.reach_note("lms200", SCALE) == "It reaches 80 m; here, 6.8 m."
    assert finders.title("exact") not in CHOICES.values()


def test_the_map_is_that_of_the_errors_and_the_player_gets_the_beams():
    sample = compute.sample("c")
    exact, noisy = Settings(range_px=20), Settings(range_px=20, position_sigma_m=0.1)
    names = [
        [part.kind for part in replays.replay(sample, one).parts]
        for one in (exact, noisy)
    ]
    assert "beams" not in names[0]
    assert "beams" in names[1]
    one, other = (compute.run(sample, s).scores(s.prior) for s in (exact, noisy))
    assert one.f1 > other.f1


@pytest.mark.parametrize("page", [BUILD, TWO_MAPS])
def test_the_sliders_are_on_the_page(page):
    app = launch(page)
    app.slider(key=control(app, "dropout_share")).set_value(0.2).run()
    assert not app.exception
    assert not app.error
    assert app.session_state["settings"].scan is not None
    app.selectbox(key=control(app, "finder")).select("rplidar-a1").run()
    assert app.session_state["settings"].beams == 360
    next(b for b in app.button if b.label == "Exact readings").click().run()
    assert app.session_state["settings"].scan is None


def test_a_slider_shows_every_step():
    assert [_decimals(step) for step in (0.05, 0.01, 0.005, 0.0001)] == [2, 2, 3, 4]
