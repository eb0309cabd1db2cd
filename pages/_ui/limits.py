"""What a student sees and may move: one table of controls, and the limits on them.

A control that is hidden or locked keeps its value: `Limits.kept` puts it back wherever
settings are set, so that neither an edited link nor a component moves it. Nothing here
depends on Streamlit.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from occsim.exercises import CONTROLS, Exercise
from pages._ui.columns import Column
from pages._ui.finders import OF_ERRORS
from pages._ui.presets import PRESETS
from pages._ui.settings import TABLE, Settings

OUTPUTS = {
    "scores": "Scores below the maps",
    "ladder": "One cell, reading by reading",
}
"""What is seen, not set: it vanishes only where it is itself hidden."""
OTHERS = {
    "drawing": "Drawing",
    "model": "Cell model: log-odds, or gmapping's counts",
    "laps": "Laps of the same tour",
    "lens_cell_px": "Cell size of the lens",
    "sensor_errors": "Sensor's beams and errors",
    "log_maps": "Maps of a robot's log: one, or gmapping's beside it",
    "presets": "Conditions, and examples of several maps",
    "transport": "Transport of the replay",
}
"""Controls that set no setting, or several."""
GROUPS = {"sensor_errors": (*OF_ERRORS, "noise_seed")}
"""Controls that are hidden and locked together, in one row for the teacher."""
OF_LENS = (
    *("range_px", "fov_deg", "lens_cell_px", "behind_hit", "clear_no_hit", "rule"),
    "p_wall",
)
OF_ONE_MAP = (
    *("p_wall", "p_space", "uninformative", "rule", "overlay", "transport"),
    *OUTPUTS,
)
OF_SEVERAL = (
    *("prior_drawing", "p_wall", "p_space", "rule", "thickness_px", "behind_hit"),
    *("cell_px", "model", "laps", "overlay", "transport", "presets", "columns"),
    *OUTPUTS,
)
OF_LOG = (
    *("p_wall", "p_space", "rule", "model", "overlay", "transport", "columns"),
    "ladder",
)
"""What the lens has, and the player with one map, with several, and with a log."""
_MORE = ("range_px", "fov_deg", "wall_share", "truth_share")
_ERRORS = (
    *("prior_drawing", "thickness_px", "shift_x_px", "shift_y_px", "rotation_deg"),
    *("drawing_scale", "missing_share", "false_share"),
)
_OF_PRIORS = (
    *("drawing", "cell_px", *_ERRORS, "presets", "behind_hit", "region"),
    *(*_MORE, "rule", "p_wall", "p_space"),
)
OF_PAGES: Mapping[str, tuple[str, ...]] = {
    "pages/0_What_the_sensor_says.py": OF_LENS,
    "pages/1_Build_a_map.py": (
        *("drawing", "cell_px", *_ERRORS, *_MORE, "presets", "behind_hit"),
        *("clear_no_hit", "sensor_errors", *OF_ONE_MAP),
    ),
    "pages/3_Two_maps.py": (
        *("drawing", "range_px", "fov_deg", "sensor_errors", *OF_SEVERAL),
    ),
    "pages/5_Sweep_the_priors.py": (*_OF_PRIORS, "surface", "drawings", "fineness"),
    "pages/6_Pareto_explorer.py": (
        *(*_OF_PRIORS, "exploring", "axes", "picture", "min_recall", "tolerance"),
        *("objectives", "elitism", "pop_size", "n_gen", "seed"),
    ),
    "pages/7_Best_prior.py": (*_OF_PRIORS, "min_recall", "handover"),
    "pages/8_Study.py": (
        *("study_rule", "region", "behind_hit"),
        *("wall_share", "truth_share", "min_recall"),
    ),
    "pages/2_Your_building.py": ("drawing",),
    "pages/4_Robot_data.py": (
        *("drawing", "log_cell_m", "usable_range_m", "log_maps", "log_behind_hit"),
        *("log_clear_no_hit", "log_max_range_m", *OF_LOG),
    ),
}
"""What each page has, for a teacher to hide and lock."""
NAMES: Mapping[str, str] = {
    **OTHERS,
    **{name: one.label for name, one in TABLE.items()},
    **OUTPUTS,
}
"""Everything that can be hidden, and its words on the screen."""
OF_EXERCISES = {
    "errors": "overlay",
    "scale": "drawing_scale",
    "rotation_rad": "rotation_deg",
    "seed": "flaw_seed",
}
"""Names in the files of exercises that are others here."""
OF_FIELDS = {"flaw": ("thickness_px",), "calibrated": ("p_wall", "p_space")}
"""The controls that a field of a map stands for, where they have another name."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Limits:
    """What is hidden and locked, and the values that this holds.

    Parameters
    ----------
    hidden, locked : frozenset of str
        Names of `NAMES`; what is hidden need not be locked as well.
    settings : Settings
        The values of all that is held.
    drawing : str
        The drawing, if that is held; empty where it may be chosen.
    together : tuple of str
        Settings that always have the same value, that of the first.
    by : str
        Who set the limits, as the student reads it; empty if there are none.
    """

    hidden: frozenset[str] = frozenset()
    locked: frozenset[str] = frozenset()
    settings: Settings = Settings()
    drawing: str = ""
    together: tuple[str, ...] = ()
    by: str = ""

    @property
    def held(self) -> frozenset[str]:
        """The controls that keep their value."""
        return self.hidden | self.locked

    def hides(self, name: str) -> bool:
        """Whether a control is off the page; a preset goes with what it would tell."""
        told = self.hidden & PRESETS_TELL if name == "presets" else ()
        return name in self.hidden or bool(told)

    def kept(self, settings: Settings) -> Settings:
        """Return settings in which all that is held has its value."""
        if not self.held and not self.together:
            return settings
        names = self.held & (TABLE.keys() - {"columns"})
        values = {name: getattr(self.settings, name) for name in names}
        columns = self.columns_kept(settings.columns, self.settings.columns)
        kept = replace(settings, **values, columns=columns)
        return replace(kept, **self._level(kept))

    def _level(self, holder: Settings | Column) -> dict[str, Any]:
        """What is to be the same, as the first of it is."""
        return {name: getattr(holder, self.together[0]) for name in self.together}

    def columns_kept(
        self, columns: tuple[Column, ...], own: tuple[Column, ...]
    ) -> tuple[Column, ...]:
        """Return maps in which all that is held is as in those of one's own."""
        if "columns" in self.held and len(columns) != len(own):
            return own
        return tuple(
            self._column(column, own[min(i, len(own) - 1)])
            for i, column in enumerate(columns)
        )

    def _column(self, column: Column, own: Column) -> Column:
        values = {
            one.name: getattr(own, one.name)
            for one in fields(Column)
            if self.held.intersection(OF_FIELDS.get(one.name, (one.name,)))
        }
        kept = replace(column, **values)
        return replace(kept, **self._level(kept))


PRESETS_TELL = frozenset(name for preset in PRESETS.values() for name in preset)
"""The settings that the choice of a preset would tell."""
NONE = Limits()


def each(names: Iterable[str]) -> frozenset[str]:
    """Return the controls that some names stand for."""
    return frozenset(one for name in names for one in GROUPS.get(name, (name,)))


def of_exercise(
    exercise: Exercise, settings: Settings, of_class: Limits = NONE
) -> Limits:
    """Return the limits of an exercise that opens with some settings.

    Where the exercise needs a control, its file alone decides about it. On every other
    control the class's limits hold as well, at the value with which the exercise opens.
    """
    locked = _ours(exercise.lock)
    others = _OF_THE_MAP - _ours(exercise.show) - locked if exercise.show else set()
    needed, hidden = _ours(exercise.needs), told_by(exercise) | others
    also_hidden = of_class.hidden - needed - hidden
    by = [f"exercise {exercise.number}", of_class.by]
    hidden, locked = hidden | also_hidden, locked | (of_class.locked - needed)
    together = tuple(OF_EXERCISES.get(name, name) for name in exercise.together)
    if not hidden | locked and not together:
        return NONE
    is_held = "drawing" in hidden | locked
    return Limits(
        hidden=hidden,
        locked=locked,
        settings=settings,
        drawing=exercise.setup.drawing if is_held else "",
        together=together,
        by=" and ".join(by if also_hidden else by[:1]),
    )


def told_by(exercise: Exercise) -> frozenset[str]:
    """The controls whose values would tell what an exercise asks."""
    return _ours(exercise.hide)


def _ours(names: Iterable[str]) -> frozenset[str]:
    return frozenset(OF_EXERCISES.get(name, name) for name in names)


_OF_THE_MAP = (
    _ours(CONTROLS)
    .union(*(("presets", "columns", "model", "laps"), *GROUPS.values()))
    .difference(OUTPUTS)
)
"""What an exercise hides where it lists what it shows."""
