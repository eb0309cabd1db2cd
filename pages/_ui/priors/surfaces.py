"""Precision and recall over all prior pairs, as the pages draw them."""

from dataclasses import dataclass
from functools import cached_property

from occsim import Objective, PriorSweep, interpolate
from occsim._types import FloatArray
from pages._ui import compute
from pages._ui.choices import Surface
from pages._ui.runs import Run
from pages._ui.settings import Settings

UNDEFINED = "undefined: nothing declared occupied"
LOW, HIGH = 0.1, 1.0
FINEST_TARGET = 0.02
"""Pairs closer than this cannot be pointed at separately on a small chart."""


def axis(step: float) -> list[float]:
    """Prior values from 0.1 to 1, as short decimals."""
    n_steps = round((HIGH - LOW) / step)
    return [round(LOW + i * step, 2) for i in range(n_steps + 1)]


TENTHS = axis(0.1)


@dataclass(frozen=True, eq=False)
class SurfaceView:
    """One objective over a square of prior pairs, in percent.

    ``values`` is both axes; ``percent`` has a row for each p_wall and a column for
    each p_space, NaN where undefined.
    """

    objective: Objective
    kind: Surface
    values: list[float]
    percent: FloatArray

    @property
    def unit(self) -> str:
        """Differences of percentages are percentage points."""
        return "points" if self.kind is Surface.DIFFERENCE else "%"

    @cached_property
    def range(self) -> tuple[float, float]:
        """Least and largest defined value; both 0 where there is none."""
        defined = [v for row in self.percent.tolist() for v in row if v == v]
        return (min(defined), max(defined)) if defined else (0.0, 0.0)

    @property
    def has_gaps(self) -> bool:
        """Whether the objective is undefined somewhere."""
        return any(v != v for row in self.percent.tolist() for v in row)

    def targets(self) -> tuple[list[float], list[str]]:
        """Points for the pointer: both axes and, row by row, the text of each."""
        step = self.values[1] - self.values[0]
        every = max(1, round(FINEST_TARGET / step))
        rows = self.percent[::every, ::every].tolist()
        words = [self._words(value) for row in rows for value in row]
        return self.values[::every], words

    def _words(self, value: float) -> str:
        if value != value:
            return UNDEFINED
        sign = "+" if self.kind is Surface.DIFFERENCE else ""
        return f"{value:{sign}.1f} {self.unit}"


def surface_view(run: Run, settings: Settings, objective: Objective) -> SurfaceView:
    """The surface that the settings ask for."""
    kind = settings.surface
    step = 0.01 if kind is Surface.SOURCE else float(settings.fineness.value)
    values = axis(step)
    if kind is Surface.SOURCE:
        table = source_table(run, values, objective)
    else:
        table = compute.sweep(run, values).values(objective)
    if kind is Surface.DIFFERENCE:
        table = source_table(run, values, objective) - table
    return SurfaceView(objective, kind, values, 100.0 * table)


def source_sweep(run: Run) -> PriorSweep:
    """The source's 10 x 10 pairs."""
    return compute.sweep(run, TENTHS)


def source_table(run: Run, values: list[float], objective: Objective) -> FloatArray:
    """The source's table, interpolated bilinearly at every pair of some values."""
    return interpolate(source_sweep(run), [[v] for v in values], [values], objective)
