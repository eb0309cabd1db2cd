"""What can be adjusted in wall detection, and the named pictures of its stages."""

from dataclasses import dataclass
from typing import NamedTuple

from occsim._types import BoolArray, ByteArray
from occsim.errors import ParameterError


@dataclass(frozen=True, kw_only=True, slots=True)
class WallParams:
    """Settings of :func:`occsim.walls.detect_walls`; zero means estimated.

    Lengths are px of the drawing as given.

    Parameters
    ----------
    ink_level : float, default 0
        Darkness, as a share of the paper's brightness, from which a pixel is ink, in
        [0, 1). Estimated: half of Otsu's threshold, so that hairlines count.
    shadow_window_px : float, default 0
        Window over which the paper's brightness is followed, at least 0. Estimated:
        an eighth of the shorter side.
    fill_level : float, default 0
        Darkness from which an area is a grey or coloured fill, in [0, 1).
    max_symbol_px : float, default 0
        Longest side of ink that is taken for text or a symbol, at least 0.
    door_fit : float, default 0.04
        How far, as a share of its radius, an arc may stray from a circle to be taken
        for a door's swing, in [0, 0.2]; 0 looks for no doors.
    min_wall_px, max_wall_px : float, default 0
        Thinnest and thickest wall, at least 0.
    max_gap_px : float, default 0
        Widest clear gap between the two lines of a hollow wall, at least 0.
    min_slenderness : float, default 3
        Length over width from which a gap between lines is a wall's, in [1, 20].
    min_piece_px : float, default 0
        Shortest group of connected walls that is kept, at least 0.
    straighten : bool, default True
        Whether a tilted drawing is turned upright while its walls are looked for.

    Raises
    ------
    ParameterError
        Where a value lies outside its domain.
    """

    ink_level: float = 0.0
    shadow_window_px: float = 0.0
    fill_level: float = 0.0
    max_symbol_px: float = 0.0
    door_fit: float = 0.04
    min_wall_px: float = 0.0
    max_wall_px: float = 0.0
    max_gap_px: float = 0.0
    min_slenderness: float = 3.0
    min_piece_px: float = 0.0
    straighten: bool = True

    def __post_init__(self) -> None:
        for name in ("ink_level", "fill_level"):
            self._check(name, 0.0, 1.0, "[0, 1)", below=True)
        self._check("door_fit", 0.0, 0.2, "[0, 0.2]")
        self._check("min_slenderness", 1.0, 20.0, "[1, 20]")
        for name in LENGTHS:
            self._check(name, 0.0, MAX_LENGTH_PX, f"[0, {MAX_LENGTH_PX:g}] px")
        if 0 < self.max_wall_px < self.min_wall_px:
            raise ParameterError(
                f"min_wall_px must not exceed max_wall_px = {self.max_wall_px!r}; "
                f"got {self.min_wall_px!r}"
            )

    def _check(
        self, name: str, low: float, high: float, domain: str, below: bool = False
    ) -> None:
        value = getattr(self, name)
        inside = low <= value < high if below else low <= value <= high
        if not inside:
            raise ParameterError(f"{name} must lie in {domain}; got {value!r}")


MAX_LENGTH_PX = 10_000.0
"""Largest length that a parameter takes, px; longer than any working drawing."""

LENGTHS = (
    "shadow_window_px",
    "max_symbol_px",
    "min_wall_px",
    "max_wall_px",
    "max_gap_px",
    "min_piece_px",
)


class Stage(NamedTuple):
    """What one step of wall detection left.

    Parameters
    ----------
    title : str
        Its name; a key of :data:`occsim.walls.STAGE_NOTES`.
    image : ndarray of uint8, shape (H, W)
        Black (0) on white (255), or grey levels.
    """

    title: str
    image: ByteArray


class Slider(NamedTuple):
    """A parameter that steers a stage: field of `WallParams`, words and bounds."""

    field: str
    label: str
    low: float
    high: float
    step: float


class StageNote(NamedTuple):
    """A sentence for students about a stage, and the parameters that steer it."""

    sentence: str
    sliders: tuple[Slider, ...]


@dataclass(frozen=True, eq=False)
class WallDetection:
    """Walls found in a drawing.

    Parameters
    ----------
    mask : ndarray of bool, shape (H, W)
        Wall pixels.
    stages : tuple of Stage
        Pictures of the steps, in order; each unpacks as (title, image).
    """

    mask: BoolArray
    stages: tuple[Stage, ...]
