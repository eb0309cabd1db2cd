"""Run the kept mutations: ``python -m tests.mutate [WORD ...]``; exit 1 if one
survives.

Each is put into a copy of the project, one at a time, and its tests are run there.
Words choose the mutations whose file or reason contains one of them.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.mutate.kept import MUTATIONS
from tests.mutate.mutation import Mutation

ROOT = Path(__file__).resolve().parents[2]
TIMEOUT_S = 600
"""Time limit, s: a mutation that makes a loop endless counts as noticed."""


def copy_of_project(folder: Path) -> None:
    """Copy the files that git tracks from the working tree."""
    names = subprocess.check_output(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        text=True,
    )
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


def applied(text: str, mutation: Mutation) -> str:
    """Return a file's text with the mutation in it."""
    if text.count(mutation.old) != 1:
        raise ValueError(
            f"{mutation.file} must hold {mutation.old!r} once; it holds it "
            f"{text.count(mutation.old)} times"
        )
    return text.replace(mutation.old, mutation.new)


def is_noticed(mutation: Mutation) -> bool:
    """Whether a test fails with the mutation in place."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copy_of_project(folder)
        path = folder / mutation.file
        path.write_text(applied(path.read_text("utf-8"), mutation), "utf-8")
        try:
            done = subprocess.run(
                mutation.command(),
                cwd=folder,
                env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=TIMEOUT_S,
            )
        except subprocess.TimeoutExpired:
            return True
    return done.returncode == 1


def main(words: list[str]) -> int:
    chosen = [
        one
        for one in MUTATIONS
        if not words or any(word in one.file + one.why for word in words)
    ]
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        alive = 0
        for one, noticed in zip(chosen, pool.map(is_noticed, chosen), strict=True):
            alive += not noticed
            state = "noticed" if noticed else "ALIVE  "
            print(f"{state} {one.file}: {one.why}", flush=True)
    print(f"{len(chosen)} mutations, {alive} alive")
    return 1 if alive else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
