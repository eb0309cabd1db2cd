"""The release, where modules can read it while the package is imported."""

__version__ = "0.1.0"
