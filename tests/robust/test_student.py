"""A minute of two random students; `python -m tests.robust.student` for longer."""

import subprocess
import sys

import pytest

from tests.browser.running import ROOT


# Processes of their own: Playwright runs once in a process, and pytest's browser is
# open. They run at the same time, as most of a student's minute is waiting.
@pytest.mark.browser
def test_random_students_meet_no_failure():
    command = [sys.executable, "-m", "tests.robust.student", "--minutes", "1"]
    students = [
        subprocess.Popen(
            [*command, "--seed", str(seed)],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        for seed in (1, 2)
    ]
    said = [student.communicate()[0] for student in students]
    failed = [text for one, text in zip(students, said, strict=True) if one.returncode]
    assert not failed, failed[0]
