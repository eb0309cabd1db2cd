"""The list of kept mutations: what is changed, why it matters, who must notice."""

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


MUTATIONS: tuple[Mutation, ...] = (
    # --- Corrections, buildings, transforms, project files ---
    Mutation(
        "occsim/corrections.py",
        "np.asarray((mask | added) & ~erased)",
        "np.asarray(mask | added)",
        ("tests/test_corrections.py",),
        "an erased pixel is no wall",
    ),
    Mutation(
        "occsim/corrections.py",
        "from_masks(added, erased & ~added)",
        "from_masks(added & ~erased, erased)",
        ("tests/test_corrections.py",),
        "where both meet in a smaller pixel the wall stays",
    ),
    Mutation(
        "occsim/corrections.py",
        "or (chosen >= n_rows * n_cols).any()",
        "or False",
        ("tests/test_corrections.py",),
        "flags beyond the last tile are refused",
    ),
    Mutation(
        "occsim/corrections.py",
        "stream.decompress(packed, most + 1)",
        "stream.decompress(packed)",
        ("tests/test_corrections.py",),
        "packed pixels are not unpacked beyond their limit",
    ),
    Mutation(
        "occsim/corrections.py",
        "if stream.unused_data:",
        "if False:",
        ("tests/test_corrections.py",),
        "nothing follows packed pixels",
    ),
    Mutation(
        "occsim/corrections.py",
        "if not stream.eof:",
        "if False:",
        ("tests/test_corrections.py",),
        "packed pixels that are cut short are refused",
    ),
    Mutation(
        "occsim/imaging/transform.py",
        "np.stack([cols, rows], axis=1) + 0.5)",
        "np.stack([cols, rows], axis=1))",
        ("tests/test_imageops.py",),
        "a shrunk mask goes by the centres of its pixels",
    ),
    Mutation(
        "occsim/imaging/transform.py",
        "matrix[:, 2] += matrix[:, :2] @ (0.5, 0.5) - 0.5",
        "pass",
        ("tests/test_imageops.py",),
        "OpenCV counts from the centre of the first pixel",
    ),
    Mutation(
        "occsim/imaging/transform.py",
        "rows[:, 2] + turn]",
        "rows[:, 2] - turn]",
        ("tests/test_imageops.py",),
        "headings turn with the drawing",
    ),
    Mutation(
        "occsim/building.py",
        "if self.trajectory is not self.tour:",
        "if True:",
        ("tests/test_building.py",),
        "a planned tour is planned again after a crop",
    ),
    Mutation(
        "occsim/building.py",
        "(self.wall_mask, self.world.occupied, self.trajectory.poses)",
        "(self.walls_found, self.world.occupied, self.trajectory.poses)",
        ("tests/test_building.py",),
        "the digest follows the corrections",
    ),
    Mutation(
        "occsim/building.py",
        "self.metres_per_px / scale",
        "self.metres_per_px * scale",
        ("tests/test_building.py",),
        "a pixel of a smaller drawing is more metres",
    ),
    Mutation(
        "occsim/io/project/file.py",
        "zipfile.ZipInfo(name, _DATE)",
        "zipfile.ZipInfo(name, __import__('time').localtime()[:6])",
        ("tests/test_project.py",),
        "a project file holds no time of saving",
    ),
    Mutation(
        "occsim/io/project/file.py",
        "needed = WALLS if version == 1 else CORRECTIONS",
        "needed = CORRECTIONS",
        ("tests/test_project.py",),
        "project files of the first release open",
    ),
    Mutation(
        "occsim/io/project/archive.py",
        "if total > MAX_UNPACKED_BYTES:",
        "if False:",
        ("tests/test_project.py",),
        "the files of a project are bounded together",
    ),
    Mutation(
        "occsim/io/project/archive.py",
        "if n_entries > MAX_ENTRIES:",
        "if False:",
        ("tests/test_project.py",),
        "a long table of contents is not read",
    ),
    Mutation(
        "occsim/io/project/values.py",
        'return not any("\\ud800" <= character <= "\\udfff" for character in value)',
        "return True",
        ("tests/test_project.py",),
        "halves of characters are refused",
    ),
    Mutation(
        "pages/_ui/components/board/__init__.py",
        "len(encoded) > area // 2",
        "len(encoded) > 10**9",
        ("tests/test_board_document.py",),
        "a commit longer than its drawing allows is not decoded",
    ),
    Mutation(
        "pages/_ui/components/board/raster.js",
        "0.5 + 1 / 64",
        "0.5",
        ("tests/node/raster.test.mjs",),
        "a line of width 2 covers two rows",
    ),
    Mutation(
        "pages/_ui/components/board/raster.js",
        "? ERASED : ADDED",
        "? ADDED : ERASED",
        ("tests/node/raster.test.mjs",),
        "a brush adds and an eraser erases",
    ),
    Mutation(
        "pages/_ui/components/board/document.js",
        "isUndone ? before : patch.value",
        "isUndone ? 0 : patch.value",
        ("tests/node/document.test.mjs",),
        "undo brings back what was below a stroke",
    ),
    Mutation(
        "pages/_ui/components/board/document.js",
        "  touch(b, patch.box);\n",
        "",
        ("tests/node/document.test.mjs",),
        "what was undone is committed",
    ),
    Mutation(
        "pages/_ui/components/board/document.js",
        "if (turn === b.sending)",
        "if (turn)",
        ("tests/node/document.test.mjs",),
        "a commit that was overtaken is not sent",
    ),
    Mutation(
        "pages/_ui/components/board/document.js",
        "value === ERASED ? tile.side : 0",
        "value === ADDED ? tile.side : 0",
        ("tests/node/document.test.mjs",),
        "added pixels come before erased ones",
    ),
    Mutation(
        "pages/_ui/components/board/document.js",
        "    areEqual(doc.overlay, other.overlay) &&\n",
        "",
        ("tests/node/document.test.mjs",),
        "undo does not go on over other corrections",
    ),
)
