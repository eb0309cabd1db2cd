"""Exercises: what to find out, judged on what the student has set."""

from pages._ui import exercising, shell

with shell.page("pages/9_Exercises.py") as here:
    shell.heading(here)
    exercising.all_exercises()
