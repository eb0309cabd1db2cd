"""Two minutes of a random student; `python -m tests.robust.student` for longer."""

import subprocess
import sys

import pytest

from tests.browser.running import ROOT


# A process of its own: Playwright runs once in a process, and pytest's browser is open.
@pytest.mark.browser
@pytest.mark.parametrize("seed", [1, 2])
def test_a_random_student_meets_no_failure(seed):
    command = [sys.executable, "-m", "tests.robust.student", "--seed", str(seed)]
    student = subprocess.run(
        [*command, "--minutes", "1"], cwd=ROOT, capture_output=True, text=True
    )
    assert student.returncode == 0, student.stdout + student.stderr
