"""The library's requirements, read from pyproject.toml, one a line.

``python tests/library_requirements.py oldest`` pins each to its lower bound, ``newest``
leaves the ranges as they are. Both include the test tools.
"""

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def requirements(which: str) -> list[str]:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    project = tomllib.loads(text)["project"]
    extras = project["optional-dependencies"]
    needed = project["dependencies"] + extras["study"]
    if which == "oldest":
        needed = [re.sub(r">=([^,]+),.*", r"==\1", one) for one in needed]
    testing = [
        one for one in extras["dev"] if re.match("pytest|hypothesis|moocore", one)
    ]
    return needed + testing


if __name__ == "__main__":
    print("\n".join(requirements(sys.argv[1])))
