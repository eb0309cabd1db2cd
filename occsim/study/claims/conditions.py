"""The conditions under which the source's claims are judged."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from enum import Enum
from itertools import product

from occsim.mapping import UpdateRule
from occsim.metrics import Region
from occsim.sensor import BehindHit


class Walls(Enum):
    """Which walls the prior is made from."""

    FOUND = "as found"
    THINNED_1 = "thinned by 1 px"
    THINNED_2 = "thinned by 2 px"
    THINNED_3 = "thinned by 3 px"
    TRUE = "the true walls"

    @property
    def thinned_px(self) -> int:
        """By how much the walls found are thinned from each side, px."""
        return {"THINNED_1": 1, "THINNED_2": 2, "THINNED_3": 3}.get(self.name, 0)


class Readings(Enum):
    """How often the cells are read along the trajectory."""

    TOUR = "the tour"
    SECOND = "every 2nd reading"
    FOURTH = "every 4th reading"
    LAPS = "three laps"


class Reach(Enum):
    """The sensor's range."""

    GIVEN = "as given"
    DOUBLED = "doubled"

    @property
    def factor(self) -> float:
        """Factor on the building's own range."""
        return 2.0 if self is Reach.DOUBLED else 1.0


@dataclass(frozen=True, kw_only=True, slots=True)
class Condition:
    """One set of conditions; by default the source's, as we reconstruct it.

    Parameters
    ----------
    rule : UpdateRule
        How a reading enters the map.
    behind_hit : BehindHit
        What a reading says of pixels behind a wall.
    region : Region
        Which cells are scored.
    walls : Walls
        Which walls the prior is made from.
    readings : Readings
        How often the cells are read.
    reach : Reach
        The sensor's range.
    """

    rule: UpdateRule = UpdateRule.SUBTRACT_PRIOR
    behind_hit: BehindHit = BehindHit.OCCUPIED
    region: Region = Region.EXPLORED
    walls: Walls = Walls.FOUND
    readings: Readings = Readings.TOUR
    reach: Reach = Reach.GIVEN

    @property
    def words(self) -> tuple[str, ...]:
        """The values of the fields, in their order."""
        return tuple(getattr(self, one.name).value for one in fields(self))


CHOICES: dict[str, tuple[Enum, ...]] = {
    "rule": (UpdateRule.SUBTRACT_PRIOR, UpdateRule.PRIOR_ONCE),
    "behind_hit": tuple(BehindHit),
    "region": (Region.EXPLORED, Region.ALL),
    "walls": tuple(Walls),
    "readings": tuple(Readings),
    "reach": tuple(Reach),
}
"""What each field of a condition may be, the source's first."""


def _conditions() -> Iterator[Condition]:
    for values in product(*CHOICES.values()):
        yield Condition(**dict(zip(CHOICES, values, strict=True)))  # type: ignore[arg-type]


CONDITIONS = tuple(_conditions())
"""All of them, the source's first."""

SOURCE_CONDITION = Condition()


def departures() -> list[Condition]:
    """Return the source's condition, and those that differ from it in one field.

    Returns
    -------
    list of Condition

    Examples
    --------
    >>> from occsim.study.claims import departures
    >>> len(departures())
    12
    """
    others = [
        replace(SOURCE_CONDITION, **{name: value})  # type: ignore[arg-type]
        for name, values in CHOICES.items()
        for value in values[1:]
    ]
    return [SOURCE_CONDITION, *others]


def matching(chosen: Mapping[str, Enum | None]) -> tuple[Condition, ...]:
    """Return the conditions that have some values.

    Parameters
    ----------
    chosen : dict
        Fields of a condition, and the value of each; None allows any.

    Returns
    -------
    tuple of Condition

    Examples
    --------
    >>> from occsim import UpdateRule
    >>> from occsim.study.claims import matching
    >>> len(matching({"rule": UpdateRule.PRIOR_ONCE, "walls": None}))
    160
    """
    wanted = {name: value for name, value in chosen.items() if value is not None}
    return tuple(
        condition
        for condition in CONDITIONS
        if all(getattr(condition, name) is value for name, value in wanted.items())
    )
