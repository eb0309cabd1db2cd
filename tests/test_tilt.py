"""The tilt of scanned and photographed drawings."""

import cv2
import numpy as np
import pytest

from occsim.imaging import Drawing, load_drawing
from occsim.imaging.tilt import estimate_tilt
from occsim.imaging.transform import Transform
from occsim.samples import FOLDER


def blank(height: int, width: int) -> np.ndarray:
    return np.full((height, width, 3), 255, np.uint8)


def straightened(drawing: Drawing, tilt_rad: float) -> Drawing:
    return Transform.straighten(drawing.shape, tilt_rad).drawing(drawing)


@pytest.mark.parametrize("name", ["a", "b", "c", "d", "e"])
@pytest.mark.parametrize("tilt_deg", [-8.0, -4.3, -1.1, 0.0, 0.4, 2.9, 6.6, 8.0])
def test_tilt_is_found_within_a_sixth_of_a_degree(name, tilt_deg):
    drawing = load_drawing(FOLDER / f"{name}_drawing.png")
    turned = straightened(drawing, -np.radians(tilt_deg))
    found = estimate_tilt(turned)
    assert found is not None
    assert abs(np.degrees(found) - tilt_deg) <= 1 / 6


def test_tilt_of_a_photograph_with_shadow_and_noise_is_found():
    drawing = load_drawing(FOLDER / "b_drawing.png")
    turned = straightened(drawing, -np.radians(3.0)).rgb.astype(float)
    height, width, _ = turned.shape
    shadow = np.linspace(1.0, 0.5, width)[None, :, None]
    noise = np.random.default_rng(2).normal(0.0, 8.0, turned.shape)
    photograph = np.clip(turned * shadow + noise, 0, 255).astype(np.uint8)
    found = estimate_tilt(Drawing(rgb=cv2.GaussianBlur(photograph, (3, 3), 0)))
    assert found is not None
    assert abs(np.degrees(found) - 3.0) <= 0.3


def test_drawing_without_lines_has_no_tilt():
    assert estimate_tilt(Drawing(rgb=blank(100, 100))) is None
    noise = np.random.default_rng(1).integers(0, 256, (300, 300, 1), np.uint8)
    assert estimate_tilt(Drawing(rgb=np.repeat(noise, 3, axis=2))) is None
    rgb = blank(400, 400)
    cv2.circle(rgb, (200, 200), 150, (0, 0, 0), 3)
    assert estimate_tilt(Drawing(rgb=rgb)) is None
