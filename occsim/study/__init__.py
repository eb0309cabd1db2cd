"""Studies: drawings times cell sizes, as tables, fronts, files and pictures."""

from occsim.study.figures import fronts_figure, maps_figure, save_figures
from occsim.study.files import (
    StudyStep,
    case_path,
    case_settings,
    load_case,
    save_case,
    study_cases,
)
from occsim.study.run import (
    Pattern,
    StudyCase,
    StudySettings,
    is_reference,
    pattern,
    run_case,
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
    "StudySettings",
    "StudyStep",
    "case_path",
    "case_settings",
    "front_rows",
    "fronts_csv",
    "fronts_figure",
    "is_reference",
    "load_case",
    "maps_figure",
    "maxima_csv",
    "maxima_rows",
    "maxima_text",
    "pattern",
    "pattern_text",
    "run_case",
    "save_case",
    "save_figures",
    "study_cases",
    "study_drawing",
    "sweeps_csv",
]
