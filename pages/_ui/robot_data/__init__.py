"""The page Robot data: one module for each of its sections."""

SECTIONS = ("A log of scans",)
"""What the page can show."""
