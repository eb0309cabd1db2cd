"""Every colour of the app, once.

Three scales, never mixed: *belief* is grey with fixed ends, so that a map reads like a
drawing; *evidence* (log-odds, differences) diverges from zero, orange towards wall and
blue towards free; *correctness* keeps its two errors apart under protan, deutan and
tritan vision. What has a meaning here has it on every page and in every component.
"""

# Belief: p_free from 0 (occupied) over one half (unknown) to 1 (free).
BELIEF_OCCUPIED = "#000000"
BELIEF_FREE = "#ffffff"

# Evidence and differences: symmetric about zero.
EVIDENCE_WALL = "#e8871e"
EVIDENCE_ZERO = "#f5f5f2"
EVIDENCE_FREE = "#1f7fbf"
EVIDENCE_SCALE = [[0.0, EVIDENCE_WALL], [0.5, EVIDENCE_ZERO], [1.0, EVIDENCE_FREE]]

# Correctness of a finished map against the ground truth.
HIT = "#1a1a1a"
FALSE_WALL = "#D55E00"
MISSED_WALL = "#0072B2"
FREE = "#ffffff"
UNSEEN = "#c8c8c8"
UNSEEN_HATCH = "#8f8f8f"

# Hatching of cells that no reading has seen: one of the two shows on any grey.
HATCH_DARK = "#000000"
HATCH_LIGHT = "#ffffff"

# What one reading says of a pixel: empty; object, and it is wall; object, but only
# hidden behind a wall. Wall that is not read, and words on any of them.
READ_EMPTY = "#b9d7ef"
READ_OBJECT = "#b5541c"
READ_HIDDEN = "#f3b27a"
WALL = "#444444"
ON_PAPER = "#1a1a1a"

# Marks over a drawing or a map.
PAPER = "#ffffff"
WALL_MASK = "#aa4499"
DOUBTFUL = "#857000"
GROUND_TRUTH = "#117733"
PATH = "#00856a"
ROBOT = "#00856a"
SENSOR = "#00856a"
HALO = "#ffffff"
OUTLINE = "#000000"
CROSSHAIR = "#cc3377"
STROKE = "#aa4499"
ERASER = "#cc3377"

# Surfaces of precision and recall: perceptually even, safe without colour vision.
SCORE_SCALE = "cividis"

# The reference drawings a to e, and other series of one chart.
SERIES = ["#0072B2", "#D55E00", "#009E73", "#AA4499", "#8a7600", "#555555"]
# Maps A, B and C side by side: no colour of an error, readable on light and on dark.
COLUMNS = ["#8a5fd0", "#c47f00", "#1b8a7a"]
MARK = "#cc3377"
# The border of what beats the blank map, seen on both ends of the scores' colours.
BLANK_LINE = "#ff5ca8"
# The two update rules, where both are in one chart.
ONCE = SERIES[0]
SUBTRACT = SERIES[1]
# Auxiliary lines and labels, readable on light and on dark.
GUIDE = "#808495"
