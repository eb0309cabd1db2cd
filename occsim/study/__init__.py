"""Studies: drawings times cell sizes, as tables, fronts, files and pictures."""

from occsim.study.figures import fronts_picture, maps_picture
from occsim.study.files import case_path, case_settings, load_case, save_case
from occsim.study.run import (
    Pattern,
    StudyCase,
    StudyDrawing,
    StudySettings,
    pattern,
    run_case,
    run_study,
    study_drawing,
)
from occsim.study.tables import (
    FRONT_COLUMNS,
    MAXIMA_COLUMNS,
    front_rows,
    fronts_csv,
    maxima_csv,
    maxima_rows,
    maxima_text,
    pattern_text,
    sweeps_csv,
)

__all__ = [
    "FRONT_COLUMNS",
    "MAXIMA_COLUMNS",
    "Pattern",
    "StudyCase",
    "StudyDrawing",
    "StudySettings",
    "case_path",
    "case_settings",
    "front_rows",
    "fronts_csv",
    "fronts_picture",
    "load_case",
    "maps_picture",
    "maxima_csv",
    "maxima_rows",
    "maxima_text",
    "pattern",
    "pattern_text",
    "run_case",
    "run_study",
    "save_case",
    "study_drawing",
    "sweeps_csv",
]
