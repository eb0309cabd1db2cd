"""Kept mutations of wall detection."""

from tests.mutate.mutation import Mutation

TESTS = ("tests/test_walls_kinds.py", "tests/test_walls.py")

WALLS: tuple[Mutation, ...] = (
    Mutation(
        "occsim/walls/text.py",
        "((size >= WORD) & (2 * piers < size))",
        "(size >= WORD)",
        TESTS,
        "a row of piers is no word",
    ),
    Mutation(
        "occsim/walls/groups.py",
        "np.concatenate(faced).mean() > PART",
        "np.concatenate(faced).mean() > 2",
        TESTS,
        "the outer face of a hollow wall is no frame",
    ),
    Mutation(
        "occsim/walls/detect.py",
        "if 2 * np.count_nonzero(every) > every.size:",
        "if np.count_nonzero(every) > every.size:",
        TESTS,
        "a sheet that is nearly all ink has no walls",
    ),
    Mutation(
        "occsim/walls/sheet.py",
        "WINDOW_SHARE = 1 / 8",
        "WINDOW_SHARE = 1 / 60",
        TESTS,
        "the paper is followed over a wide window",
    ),
    Mutation(
        "occsim/walls/sheet.py",
        "WORKING_PIXELS = 1_500_000",
        "WORKING_PIXELS = 300_000",
        TESTS,
        "the working copy is large enough for thin lines",
    ),
    Mutation(
        "occsim/walls/strokes.py",
        "between.sum() >= PART * alike",
        "between.sum() >= 0.9 * alike",
        TESTS,
        "hollow walls are a style of their own",
    ),
    Mutation(
        "occsim/walls/strokes.py",
        "COMMON_SHARE = 0.2",
        "COMMON_SHARE = 0.9",
        TESTS,
        "what is common is a share of what is commonest",
    ),
    Mutation(
        "occsim/walls/hollow.py",
        "SEED_LENGTH = 6.0",
        "SEED_LENGTH = 20.0",
        TESTS,
        "a short hollow wall is a wall",
    ),
    Mutation(
        "occsim/walls/hollow.py",
        "s.sure >= PART",
        "s.sure >= 0.95",
        TESTS,
        "a hollow wall needs both of its lines for a part only",
    ),
    Mutation(
        "occsim/walls/doors.py",
        "ON_ARC = 0.7",
        "ON_ARC = 1.1",
        TESTS,
        "door swings are found",
    ),
    Mutation(
        "occsim/walls/doors.py",
        "LEAF_COVER = 0.8",
        "LEAF_COVER = 2.0",
        TESTS,
        "leaves are taken away",
    ),
    Mutation(
        "occsim/walls/groups.py",
        "runs.length <= 2 * DOOR * m.wall",
        "runs.length <= 0.5 * m.wall",
        TESTS,
        "walls that face each other across a doorway belong together",
    ),
    Mutation(
        "occsim/walls/groups.py",
        "groups.longest > 2 * DOOR * m.wall",
        "groups.longest > 200 * m.wall",
        TESTS,
        "a free-standing core is kept",
    ),
    Mutation(
        "occsim/walls/groups.py",
        "FRAME_MARGIN = 0.06",
        "FRAME_MARGIN = 0.0",
        TESTS,
        "the frame of a sheet is no wall",
    ),
    Mutation(
        "occsim/walls/hollow.py",
        "thin[first] | thin[last]",
        "thin[first] & thin[last]",
        TESTS,
        "furniture against a hollow wall hides one face only",
    ),
    Mutation(
        "occsim/walls/strokes.py",
        "DOOR = 4.0",
        "DOOR = 8.0",
        TESTS,
        "a door is four walls long",
    ),
    Mutation(
        "occsim/walls/scale.py",
        "SPREAD = 0.15",
        "SPREAD = 0.9",
        TESTS,
        "doors of one building agree in length",
    ),
)
