"""The page Robot data: one module for each of its sections."""

SECTIONS = ("A log of scans", "A drawing for the log", "A ROS map")
"""What the page can show."""
