"""The settings of the map that a robot's log gives."""

from dataclasses import dataclass

from occsim import BehindHit
from pages._ui.settings.declared import setting


@dataclass(frozen=True, kw_only=True)
class LogSettings:
    """How a robot's log is mapped."""

    log_cell_m: float = setting(
        0.05,
        label="Cell size",
        unit="m",
        low=0.02,
        high=0.5,
        step=0.01,
        help="Side of a cell of the map that a robot's log gives.",
    )
    usable_range_m: int = setting(
        10,
        label="Usable range",
        unit="m",
        low=1,
        high=80,
        help="Nothing is mapped beyond it, and a hit beyond it clears as far as it.",
    )
    log_max_range_m: int = setting(
        0,
        label="Maximum range",
        unit="m",
        high=100,
        help="A reading at or beyond it is no return. 0: as the log says.",
    )
    log_behind_hit: BehindHit = setting(
        BehindHit.UNSEEN,
        label="Behind a hit",
        help="What a scan says of the pixels behind the end of a beam.",
    )
    log_clear_no_hit: bool = setting(
        False,
        label="A beam without return clears its sector",
        help="Off, it says nothing: black surfaces and mirrors give no return either.",
    )
