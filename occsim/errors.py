"""The few errors that the library raises on bad input.

Each message says what is wrong, what is allowed and what was got, so that an
application can show it as it stands.
"""


class OccsimError(ValueError):
    """Base of every error that bad input to :mod:`occsim` raises."""


class ParameterError(OccsimError):
    """A parameter, or the combination of several, lies outside its domain."""


class DrawingError(OccsimError):
    """An image cannot be used as a drawing."""


class TrajectoryError(OccsimError):
    """Poses, or the file they come from, cannot be used as a trajectory."""
