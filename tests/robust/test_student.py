"""Two minutes of a random student; `python -m tests.robust.student` for longer."""

import pytest

from tests.robust.student import study


@pytest.mark.browser
@pytest.mark.parametrize("seed", [1, 2])
def test_a_random_student_meets_no_failure(seed, tmp_path):
    assert study(1.0, seed, tmp_path / "server.log") > 10
