"""A class: what a teacher prepares, votes, and what students hand in."""
