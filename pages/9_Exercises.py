"""Exercises: what to find out, judged on what the student has set."""

from pages._ui import exercising, shell

with shell.page("pages/9_Exercises.py") as lesson:
    shell.heading(lesson)
    exercising.all_exercises()
