"""Numbers as the pages print them."""

import math

import pytest

from pages._ui import words


@pytest.mark.parametrize(
    ("value", "spec", "text"),
    [
        (11205, ",", "11,205"),
        (-1234.5, "+,.1f", "−1,234.5"),
        (0.5, "+.2f", "+0.50"),
        (-10.0, "g", "−10"),
        (2.5, "g", "2.5"),
        # As on the player: no minus where it rounds to zero.
        (-0.0004, ".3f", "0.000"),
        (math.nan, ".3f", "–"),
    ],
)
def test_a_number_has_a_true_minus_and_its_thousands_apart(value, spec, text):
    assert words.number(value, spec) == text


def test_a_count_needs_no_format():
    assert [words.number(n) for n in (0, 999, 1103)] == ["0", "999", "1,103"]
