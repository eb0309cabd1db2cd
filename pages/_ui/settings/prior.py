"""The settings of the prior, of the drawing behind it, and of how a map is scored."""

import math
from dataclasses import dataclass

from occsim import DrawingFlaws, Prior, Region, UpdateRule
from occsim.prior import SOURCE_PAIR
from pages._ui.choices import PriorDrawing
from pages._ui.settings.declared import flaw, setting


@dataclass(frozen=True, kw_only=True)
class PriorSettings:
    """What a map starts from, how it is updated and scored."""

    wall_share: float = setting(
        0.0,
        label="Wall share of the prior",
        low=0.0,
        high=0.95,
        step=0.05,
        help="A cell is a wall cell of the prior where more than this share of its "
        "pixels is wall. At 0 a single wall pixel is enough.",
    )
    truth_share: float = setting(
        0.0,
        label="Wall share of the ground truth",
        low=0.0,
        high=0.95,
        step=0.05,
        help="The same threshold for the ground truth against which the map is scored.",
    )
    p_wall: float = setting(
        SOURCE_PAIR[0],
        label="p_wall",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of wall cells: p_free = 0.9 × p_wall where the drawing shows a "
        "wall.",
    )
    p_space: float = setting(
        SOURCE_PAIR[1],
        label="p_space",
        low=0.05,
        high=1.0,
        step=0.01,
        help="Prior of all other cells: p_free = 0.9 × p_space where the drawing shows "
        "none.",
    )
    uninformative: bool = setting(
        False,
        label="Uninformative prior",
        help="Start every cell at p_free = 0.5, as if there were no drawing.",
    )
    rule: UpdateRule = setting(
        UpdateRule.PRIOR_ONCE,
        label="Update rule",
        help="How a reading enters the map.",
    )
    study_rule: UpdateRule = setting(
        UpdateRule.SUBTRACT_PRIOR,
        label="Update rule of the study",
        help="The study repeats what the source did, so it opens with the rule that "
        "the source used, as we reconstruct it.",
    )
    region: Region = setting(
        Region.EXPLORED,
        label="Scored region",
        help="Score only cells that some reading has updated, or all cells.",
    )
    prior_drawing: PriorDrawing = setting(
        PriorDrawing.OWN,
        label="Drawing for the prior",
        help="Which drawing the prior is made from. The building that the robot "
        "drives through stays the same.",
    )
    thickness_px: int = flaw(
        "thickness_px",
        label="Wall thickness",
        unit="px",
        help="Thins or thickens the drawing's walls from both sides. What would vanish "
        "stays as a line of one pixel.",
    )
    shift_x_px: int = flaw(
        "shift_x_px",
        label="Shift to the right",
        unit="px",
        help="The drawing is shifted this far to the right of the building.",
    )
    shift_y_px: int = flaw(
        "shift_y_px",
        label="Shift down",
        unit="px",
        help="The drawing is shifted this far down from the building.",
    )
    rotation_deg: float = setting(
        0.0,
        label="Rotation",
        unit="degrees",
        low=round(math.degrees(DrawingFlaws.bounds("rotation_rad").low)),
        high=round(math.degrees(DrawingFlaws.bounds("rotation_rad").high)),
        step=0.5,
        help="The drawing is turned about the middle of the sheet, clockwise.",
    )
    drawing_scale: float = flaw(
        "scale",
        label="Scale",
        help="The drawing is larger than the building, about the middle of the sheet.",
    )
    missing_share: float = flaw(
        "missing_share",
        label="Missing walls",
        help="Share of the length of the walls that the drawing leaves out, in pieces.",
    )
    false_share: float = flaw(
        "false_share",
        label="False walls",
        help="Walls that the building does not have, as a share of the length of its "
        "walls.",
    )
    flaw_seed: int = setting(
        0,
        label="Seed of missing and false walls",
        high=9999,
        help="Another seed puts them elsewhere.",
    )

    @property
    def flaws(self) -> DrawingFlaws:
        """What the drawing gets wrong; the walls of the prior alone suffer it."""
        return DrawingFlaws(
            thickness_px=self.thickness_px,
            shift_x_px=self.shift_x_px,
            shift_y_px=self.shift_y_px,
            rotation_rad=math.radians(self.rotation_deg),
            scale=self.drawing_scale,
            missing_share=self.missing_share,
            false_share=self.false_share,
            seed=self.flaw_seed,
        )

    @property
    def prior(self) -> Prior:
        """The prior of these settings."""
        if self.uninformative:
            return Prior.uninformative()
        return Prior(p_wall=self.p_wall, p_space=self.p_space)
