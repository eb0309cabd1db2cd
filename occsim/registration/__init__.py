"""Registration of a drawing on a robot's map: by points, then by what the robot saw."""

from occsim.registration.agreement import Agreement, agreement
from occsim.registration.refine import refine_registration
from occsim.registration.similarity import (
    Registration,
    register_by_points,
    registered_walls,
)

__all__ = [
    "Agreement",
    "Registration",
    "agreement",
    "refine_registration",
    "register_by_points",
    "registered_walls",
]
