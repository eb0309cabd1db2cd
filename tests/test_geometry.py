import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from occsim.geometry import CARDINAL_HEADINGS_RAD, snap_heading, wrap_angle

ANGLES = st.floats(-100, 100)


@given(ANGLES)
def test_wrapping_keeps_the_direction(angle):
    wrapped = wrap_angle(angle)
    assert -np.pi <= wrapped < np.pi
    np.testing.assert_allclose(
        [np.cos(wrapped), np.sin(wrapped)], [np.cos(angle), np.sin(angle)], atol=1e-9
    )


@given(st.floats(allow_nan=False, allow_infinity=False))
@example(np.nextafter(-np.pi, -4.0))
@example(np.nextafter(np.pi, 0.0))
@example(-np.pi)
@example(np.pi)
def test_a_wrapped_angle_lies_in_one_turn_that_begins_at_minus_pi(angle):
    assert -np.pi <= wrap_angle(angle) < np.pi


@given(ANGLES)
def test_snapping_gives_the_nearest_cardinal_heading(angle):
    snapped = float(snap_heading(angle))
    distance = np.abs(wrap_angle(np.asarray(CARDINAL_HEADINGS_RAD) - angle))
    assert any(np.isclose(snapped, heading) for heading in CARDINAL_HEADINGS_RAD)
    np.testing.assert_allclose(
        np.abs(wrap_angle(snapped - angle)), distance.min(), atol=1e-9
    )
