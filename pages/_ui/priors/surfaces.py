"""Precision, recall and bits over all prior pairs, as the pages draw them."""

from dataclasses import dataclass
from functools import cached_property

from occsim import Objective, PriorSweep, interpolate
from occsim._types import FloatArray
from occsim.prior import PRIOR_SCALE
from pages._ui.choices import Fineness, Surface
from pages._ui.priors import scores, solving
from pages._ui.runs import Run
from pages._ui.settings import Settings

UNDEFINED = "undefined: nothing declared occupied"
LOW, HIGH = 0.1, 1.0


def axis(step: float) -> list[float]:
    """Prior values from 0.1 to 1, as short decimals."""
    n_steps = round((HIGH - LOW) / step)
    return [round(LOW + i * step, 2) for i in range(n_steps + 1)]


TENTHS = axis(0.1)
TARGETS = axis(0.05)
"""Pairs closer than these cannot be pointed at separately on a small chart."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SurfaceView:
    """One score over a square of prior pairs.

    ``values`` is both axes; ``table`` has a row for each p_wall and a column for each
    p_space, NaN where undefined; ``targets`` is the same over `TARGETS`. ``blank`` is
    the blank map's value in the same unit, NaN where it is undefined or the surface
    shows differences.
    """

    name: str
    unit: str
    values: list[float]
    table: FloatArray
    targets: FloatArray
    blank: float = float("nan")
    is_difference: bool = False
    less_is_better: bool = False

    @cached_property
    def _all(self) -> list[float]:
        return [value for row in self.table.tolist() for value in row]

    @cached_property
    def range(self) -> tuple[float, float]:
        """Least and largest defined value; both 0 where there is none."""
        defined = [value for value in self._all if value == value]
        return (min(defined), max(defined)) if defined else (0.0, 0.0)

    @property
    def has_gaps(self) -> bool:
        """Whether the score is undefined somewhere."""
        return any(value != value for value in self._all)

    @property
    def share_above_blank(self) -> float:
        """Share of the pairs that are better than the blank map; NaN without one."""
        if self.blank != self.blank:
            return float("nan")
        sign = -1.0 if self.less_is_better else 1.0
        better = sum(sign * (value - self.blank) > 1e-9 for value in self._all)
        return better / len(self._all)

    def target_texts(self) -> list[str]:
        """The text of every point for the pointer, row by row."""
        return [self.text(value) for row in self.targets.tolist() for value in row]

    def text(self, value: float) -> str:
        """One value with its unit."""
        if value != value:
            return UNDEFINED
        sign = "+" if self.is_difference else ""
        digits = 3 if self.less_is_better else 1
        return f"{value:{sign}.{digits}f} {self.unit}"


def views(run: Run, settings: Settings) -> list[SurfaceView]:
    """The surfaces that the settings ask for, of one rule: two scores, and bits."""
    scored = [surface_view(run, settings, objective) for objective in Objective]
    return [*scored, bits_view(run, settings)]


def surface_view(run: Run, settings: Settings, objective: Objective) -> SurfaceView:
    """Precision or recall, in percent or, of a difference, in points."""
    kind, name, values = settings.surface, objective.value, _values(settings)
    is_difference = kind is Surface.DIFFERENCE
    blank = getattr(run.scores(scores.BLANK), name)
    return SurfaceView(
        name=name,
        unit="points" if is_difference else "%",
        values=values,
        table=_percent(run, kind, objective, values),
        targets=_percent(run, kind, objective, TARGETS),
        blank=float("nan") if is_difference else 100.0 * blank,
        is_difference=is_difference,
    )


def _percent(
    run: Run, kind: Surface, objective: Objective, values: list[float]
) -> FloatArray:
    if kind is Surface.SOURCE:
        return 100.0 * source_table(run, values, objective)
    exact = 100.0 * solving.sweep(run, values).values(objective)
    if kind is Surface.EXACT:
        return exact
    return 100.0 * source_table(run, values, objective) - exact


def bits_view(run: Run, settings: Settings) -> SurfaceView:
    """The log loss, always exact: it is smooth, so nothing is interpolated."""
    values, region = _values(settings), run.settings.region
    surface = run.mapped.loss_surface(run.settings.rule, region)
    fine, coarse = (
        [PRIOR_SCALE * value for value in axis] for axis in (values, TARGETS)
    )
    return SurfaceView(
        name="bits per cell",
        unit="bits",
        values=values,
        table=surface.bits(fine, fine),
        targets=surface.bits(coarse, coarse),
        blank=run.mapped.bits(scores.BLANK, run.settings.rule, region),
        less_is_better=True,
    )


def _values(settings: Settings) -> list[float]:
    source = settings.surface is Surface.SOURCE
    return axis(float((Fineness.FIFTIETH if source else settings.fineness).value))


def source_sweep(run: Run) -> PriorSweep:
    """The source's 10 x 10 pairs."""
    return solving.sweep(run, TENTHS)


def source_table(run: Run, values: list[float], objective: Objective) -> FloatArray:
    """The source's table, interpolated bilinearly at every pair of some values."""
    return interpolate(source_sweep(run), [[v] for v in values], [values], objective)
