"""What the sensor's errors do: the sentence on the page, and its interval."""

import numpy as np
import pytest

from occsim import (
    MappingRun,
    MapSettings,
    ParameterError,
    Prior,
    ScanNoise,
    ScanSettings,
    load_sample,
    sample_names,
)
from occsim.run import NoiseEffect, noise_effect
from pages._ui import compute, noise_lesson
from pages._ui.settings import Settings
from tests.test_pages import launch

BLANK_GAINS = {"c", "e"}


@pytest.mark.parametrize("name", sample_names())
def test_the_sentence_on_noise_holds_on_every_reference_drawing(name):
    sample = compute.sample(name)
    settings = noise_lesson.chosen(Settings(range_px=round(sample.sensor.range_px)))
    blank, drawn = noise_lesson.effects(sample, settings)
    assert blank.noisy.size == drawn.noisy.size == 10
    # "by 2 to 7 points", and the interval tells it from nothing.
    assert 2 <= round(-100 * drawn.change) <= 7
    assert drawn.change + drawn.half_width < 0
    # "loses on a, b and d, and gains on c and e"
    sign = 1 if name in BLANK_GAINS else -1
    assert sign * blank.change > blank.half_width
    # "still the better one on all five"
    assert drawn.noisy.min() > blank.noisy.max()
    # "does not lose less everywhere": on c and e it loses more.
    assert (drawn.change < blank.change) == (name in BLANK_GAINS)


def test_the_interval_is_students_t():
    # Mean 3, standard deviation sqrt(2.5); t of 4 degrees at 97.5 % is 2.776445.
    effect = NoiseEffect(2.0, np.array([1.0, 2.0, 3.0, 4.0, 5.0]))
    assert effect.mean == 3.0
    assert effect.change == 1.0
    assert effect.half_width == pytest.approx(2.776445 * (2.5 / 5) ** 0.5, rel=1e-6)


def test_the_scores_are_those_of_the_seeds_runs():
    sample = load_sample("d")
    noise = ScanNoise(metres_per_px=1.0, dropout_share=0.3)

    def run(**scan):
        settings = ScanSettings(n_beams=9, **scan)
        return MappingRun(sample, MapSettings(sensor=sample.sensor, scan=settings))

    done = []
    [effect] = noise_effect(
        run(noise=noise, seed=77),
        [Prior()],
        n_seeds=3,
        on_progress=lambda *step: done.append(step),
    )
    assert effect.exact == run().scores(Prior()).f2
    expected = [run(noise=noise, seed=s).scores(Prior()).f2 for s in range(3)]
    assert effect.noisy.tolist() == expected
    assert done == [(1, 3), (2, 3), (3, 3)]


def test_without_errors_there_is_nothing_to_repeat():
    sample = load_sample("d")
    for scan in (None, ScanSettings(n_beams=9)):
        with pytest.raises(ParameterError, match="scan with noise"):
            noise_effect(MappingRun(sample, MapSettings(scan=scan)), [Prior()])


def test_the_page_computes_the_table_when_it_is_asked_to():
    app = launch("pages/3_Two_maps.py")
    assert not [one for one in app.markdown if "F2 without errors" in one.value]
    next(b for b in app.button if b.label.startswith("Compute it here")).click().run()
    assert not app.exception
    (table,) = (one for one in app.markdown if "F2 without errors" in one.value)
    assert table.value.count("±") == 2
