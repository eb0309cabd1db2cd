"""What a kept mutation is."""

import sys
from typing import NamedTuple


class Mutation(NamedTuple):
    """A text of a file that is replaced by another, and the tests that must fail."""

    file: str
    old: str
    new: str
    tests: tuple[str, ...]
    why: str

    def command(self) -> list[str]:
        """The command that must end in status 1."""
        if self.tests[0].endswith(".mjs"):
            return ["node", "--test", *self.tests]
        return [sys.executable, "-m", "pytest", "-x", "-q", *self.tests]
