"""Make the reference drawings: python -m assets.samples.make."""

from .build import build

build()
