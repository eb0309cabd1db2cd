"""What a student has set, pinned and answered: all that an exercise may judge."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from enum import Enum
from typing import Any

from occsim.errors import ParameterError, choice, real_number, shown, whole_number
from occsim.flaws import DrawingFlaws
from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.prior import SOURCE_PAIR, Prior
from occsim.samples import sample_names
from occsim.sensor import BehindHit, Sensor

END = "end"
"""Name of the last step."""

Numbers = Mapping[str, float | str]


@dataclass(frozen=True, kw_only=True, slots=True)
class ExerciseState:
    """The settings, the place in the replay and the answers of one student.

    Parameters
    ----------
    drawing : str
        Name of a sample.
    prior_drawing : str
        As in `occsim.prior_drawing`.
    flaws : DrawingFlaws
        What the drawing gets wrong.
    cell_px, range_px, fov_deg, behind_hit, clear_no_hit, wall_share, truth_share
        As in `occsim.MapSettings`; the range is the sample's own by default.
    p_wall, p_space : float
        The prior, unless it is `uninformative`.
    rule, region
        How a reading enters, and which cells are scored.
    step : int or "end"
        Readings in the map.
    cell : tuple of int or None
        Row and column of the pinned cell.
    lens_pose : tuple of float
        x_px, y_px and heading in degrees of the robot of the lens.
    lens_cell : tuple of int or None
        Row and column of the cell pinned in the lens.
    lens_cell_px : int
        Side of the cells of the lens, px.
    moved : mapping
        How far each prior was moved while the cell was pinned, and ``"any"``.
    answers : mapping
        What was answered, by name.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.
    """

    drawing: str = "b"
    prior_drawing: str = "own"
    flaws: DrawingFlaws = DrawingFlaws()
    cell_px: int = 3
    range_px: float | None = None
    fov_deg: float = 30.0
    behind_hit: BehindHit = BehindHit.OCCUPIED
    clear_no_hit: bool = True
    wall_share: float = 0.0
    truth_share: float = 0.0
    p_wall: float = SOURCE_PAIR[0]
    p_space: float = SOURCE_PAIR[1]
    uninformative: bool = False
    rule: UpdateRule = UpdateRule.PRIOR_ONCE
    region: Region = Region.EXPLORED
    step: int | str = END
    cell: tuple[int, int] | None = None
    lens_pose: tuple[float, float, float] = (8.5, 10.5, 0.0)
    lens_cell: tuple[int, int] | None = None
    lens_cell_px: int = 4
    moved: Numbers = field(default_factory=dict)
    answers: Numbers = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.drawing not in sample_names():
            raise ParameterError(
                f"drawing must be one of {', '.join(sample_names())}; got "
                f"{shown(self.drawing)}"
            )
        for name, kind in (
            ("behind_hit", BehindHit),
            ("rule", UpdateRule),
            ("region", Region),
        ):
            object.__setattr__(self, name, choice(name, getattr(self, name), kind))
        if self.step != END:
            whole_number("step", self.step, 0, 1_000_000)
        for name in ("cell", "lens_cell", "lens_pose"):
            object.__setattr__(self, name, _numbers(name, getattr(self, name)))
        whole_number("lens_cell_px", self.lens_cell_px, 1, 32)
        # They check their own values, those as well that are not in use.
        _ = Prior(p_wall=self.p_wall, p_space=self.p_space), self.sensor(20.0)

    @property
    def prior(self) -> Prior:
        """The prior."""
        if self.uninformative:
            return Prior.uninformative()
        return Prior(p_wall=self.p_wall, p_space=self.p_space)

    def sensor(self, range_px: float) -> Sensor:
        """Return the sensor, with a range where none is set."""
        given = self.range_px
        return Sensor(
            range_px=range_px if given is None else real_number("range_px", given),
            fov_rad=math.radians(real_number("fov_deg", self.fov_deg)),
            behind_hit=self.behind_hit,
            clear_no_hit=self.clear_no_hit,
        )


def _numbers(name: str, given: Any) -> tuple[float, ...] | None:
    if given is None:
        return None
    wanted = 3 if name == "lens_pose" else 2
    if not isinstance(given, (tuple, list)) or len(given) != wanted:
        raise ParameterError(f"{name} must be {wanted} numbers; got {shown(given)}")
    if wanted == 2:
        return tuple(whole_number(name, one, 0, 1_000_000) for one in given)
    return tuple(real_number(name, one) for one in given)


SETTINGS = tuple(
    one.name
    for one in fields(ExerciseState)
    if one.name not in ("flaws", "moved", "answers")
)
"""What a set-up and a witness can set, beside the fields of `DrawingFlaws`, ``moved``
and ``answer``."""
FLAWS = tuple(one.name for one in fields(DrawingFlaws))


def changed(state: ExerciseState, changes: Mapping[str, Any]) -> ExerciseState:
    """Return a state with some of its values replaced.

    Parameters
    ----------
    state : ExerciseState
        The state before.
    changes : mapping of str
        Values by name: settings, fields of `DrawingFlaws`, ``moved``, ``answer``.

    Returns
    -------
    ExerciseState

    Raises
    ------
    ParameterError
        Where there is no such setting, or a value lies outside its domain.
    """
    plain: dict[str, Any] = {}
    flaws: dict[str, Any] = {}
    for name, value in changes.items():
        if name in SETTINGS:
            plain[name] = value
        elif name in FLAWS:
            flaws[name] = value
        elif name in ("moved", "answer"):
            key = "answers" if name == "answer" else name
            plain[key] = {**getattr(state, key), **value}
        else:
            raise ParameterError(f"there is no setting called {shown(name)}")
    if flaws:
        plain["flaws"] = replace(state.flaws, **flaws)
    try:
        return replace(state, **plain)
    except TypeError as error:
        raise ParameterError(f"a setting is of a wrong type: {error}") from error


def setting_text(state: ExerciseState, name: str) -> float | bool | str:
    """Return a setting as a check compares it: a number, true or false, or a word."""
    value = getattr(state.flaws if name in FLAWS else state, name)
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, (bool, str)):
        return value
    return math.nan if value is None else float(value)
