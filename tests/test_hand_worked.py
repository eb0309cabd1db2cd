"""A world of 6 x 6 px in cells of 2 px, two readings, worked out by hand.

The world (# wall), the two robots (>, heading right, and ^, heading up) and the nine
cells::

      col 0 1   2 3   4 5
    row
     0    . . | . . | . .
     1    . . | . . | . .
         -----+-----+-----
     2    > . | . . | # .
     3    . . | . . | # .
         -----+-----+-----
     4    . . | . . | . .
     5    . . | . . | . ^

Both stand on a pixel's centre, look 90 degrees wide (both sides included) and 5.5 px
far (squared: 30.25). L stands for ln 9, the log-odds of 0.9.

**First reading**, from (0.5, 2.5) to the right. A pixel centre is (dx, dy) from the
robot; in view are |dy| <= dx and dx^2 + dy^2 <= 30.25. The wall's face is the line dx
= 3.5 from dy = -0.5 to 1.5, so a centre at dx = 4 or 5 is object if its ray is there,
at 3.5 dy / dx, within that.

- Column 0: only the robot's own pixel. Column 1: rows 1 to 3. Column 2: rows 0 to 4.
  Column 3: rows 0 to 5 (dy = 3: 18 in reach, exactly on the side of the cone). All
  empty.
- Column 4: rows 0 to 5 (dy = 3: 25). dy = 0 and 1 cross the face at 0 and 0.875:
  object, they are the wall. dy = -2, -1, 2, 3 miss it (-1.75, -0.875, 1.75, 2.625):
  empty.
- Column 5: rows 0 to 4 (dy = 2: 29; dy = 3: 34 is too far). dy = 0, 1, 2 cross it at
  0, 0.7, 1.4: object. dy = -2, -1 miss it: empty.

Cell by cell, empty + object pixels: (0,0) 1+0; (0,1) 4+0; (0,2) 4+0; (1,0) 3+0; (1,1)
4+0; (1,2) 0+4; (2,0) none; (2,1) 3+0; (2,2) 2+1, hence q = 2/3 and ln 2.

**Second reading**, from (5.5, 5.5) upwards. In view are |dx| <= -dy. The wall shows
its lower face, dy = -1.5 from dx = -1.5 to -0.5, and its right face, dx = -0.5 from
dy = -3.5 to -1.5.

- Row 5: the own pixel. Row 4: columns 4, 5, nearer than the wall. Column 5: all rows
  (25 at row 0), beside the wall. All empty.
- Row 3: (3,4) is wall. (3,3) has the ray (-2, -2), which passes exactly through the
  corner (-1.5, -1.5) of the wall: a ray that touches is stopped. Both object.
- Row 2: columns 2 to 4 cross dy = -1.5 at -1.5 (corner), -1 and -0.5 (corner):
  object.
- Row 1: columns 2 to 4 (column 1: 32 is too far): -1.125 and -0.75 on the lower face;
  (1,4) meets the right face at dy = -2. Object.
- Row 0: columns 3, 4 (column 2: 34): -0.6 on the lower face; (0,4) meets the right
  face at dy = -2.5. Object.

Cell by cell: (0,0) none; (0,1) 0+3; (0,2) 2+2, hence 0; (1,0) none; (1,1) 0+3; (1,2)
2+2, hence 0; (2,0) none; (2,1) none; (2,2) 3+0.

**With BehindHit.UNSEEN** only wall pixels at most 1.5 px beyond the hit are object.
First reading: (2,4) is 4 - 3.5 = 0.5 beyond, (3,4) 0.52; the rest of column 5 and
(4,5) are nothing, so (1,2) has 0+2 and (2,2) 2+0. Second: (3,4) is 2.236 - 1.677 =
0.56 beyond; (2,4) is 3.162 - 1.581 = 1.58 beyond the corner that its ray touches,
which is too deep. So (0,1) and (1,1) have none, (0,2) 2+0, (1,2) 2+1, (2,2) 3+0.

**The map.** The wall mask is the world: (1,2) is a wall cell, with l_0 = ln(0.18 /
0.82) = ln(9/41); all others have l_0 = ln(0.81 / 0.19) = ln(81/19).

SUBTRACT_PRIOR, l = S + (1 - k) l_0: one reading cancels the prior: (0,0), (1,0),
(2,1) are L. Two readings push away from it: (0,1) and (1,1) have S = 0, so
-ln(81/19); (0,2) ln 9 - ln(81/19) = ln(19/9); (1,2) -ln 9 - ln(9/41) = ln(41/81);
(2,2) ln 2 + ln 9 - ln(81/19) = ln(38/9). (2,0) keeps its prior.

PRIOR_ONCE, l = S + l_0: (0,0), (0,2), (1,0), (2,1) ln 9 + ln(81/19) = ln(729/19);
(0,1), (1,1), (2,0) ln(81/19); (1,2) -ln 9 + ln(9/41) = -ln 41; (2,2) ln 18 +
ln(81/19) = ln(1458/19).
"""

import numpy as np
import pytest

from occsim import (
    BehindHit,
    Prior,
    Sensor,
    Trajectory,
    UpdateRule,
    World,
    build_prior,
    collect_evidence,
    fuse,
)

L = np.log(9)
NONE = np.nan

OCCUPIED = np.zeros((6, 6), dtype=bool)
OCCUPIED[2:4, 4] = True
WORLD = World(occupied=OCCUPIED)
GRID = WORLD.grid(2)
POSES = Trajectory(poses=[(0.5, 2.5, 0.0), (5.5, 5.5, 1.5 * np.pi)])

READINGS = {
    BehindHit.OCCUPIED: (
        [[L, L, L], [L, L, -L], [NONE, L, np.log(2)]],
        [[NONE, -L, 0], [NONE, -L, 0], [NONE, NONE, L]],
    ),
    BehindHit.UNSEEN: (
        [[L, L, L], [L, L, -L], [NONE, L, L]],
        [[NONE, NONE, L], [NONE, NONE, np.log(2)], [NONE, NONE, L]],
    ),
}


def evidence_of(behind_hit):
    sensor = Sensor(range_px=5.5, fov_rad=np.pi / 2, behind_hit=behind_hit)
    return collect_evidence(WORLD, POSES, sensor, GRID)


def dense(evidence, reading):
    """One reading as an array of cells, NaN where it has no entry."""
    cells = np.full(evidence.grid.n_cells, np.nan)
    own = slice(*evidence.indptr[reading : reading + 2])
    cells[evidence.cell[own]] = evidence.log_odds[own]
    return cells.reshape(evidence.grid.shape)


@pytest.mark.parametrize("reading", [0, 1])
@pytest.mark.parametrize("behind_hit", BehindHit)
def test_log_odds_of_every_cell_and_reading(behind_hit, reading):
    np.testing.assert_allclose(
        dense(evidence_of(behind_hit), reading),
        READINGS[behind_hit][reading],
        atol=1e-11,
    )


def test_map_with_the_prior_subtracted_at_each_reading():
    prior = build_prior(OCCUPIED, GRID, Prior(p_wall=0.2, p_space=0.9))
    result = fuse(evidence_of(BehindHit.OCCUPIED), prior, UpdateRule.SUBTRACT_PRIOR)
    expected = [[9, 19 / 81, 19 / 9], [9, 19 / 81, 41 / 81], [81 / 19, 9, 38 / 9]]
    np.testing.assert_allclose(result.log_odds, np.log(expected))
    np.testing.assert_array_equal(result.n_updates, [[1, 2, 2], [1, 2, 2], [0, 1, 2]])


def test_map_with_the_prior_entering_once():
    prior = build_prior(OCCUPIED, GRID, Prior(p_wall=0.2, p_space=0.9))
    result = fuse(evidence_of(BehindHit.OCCUPIED), prior, UpdateRule.PRIOR_ONCE)
    both, one = 729 / 19, 81 / 19
    expected = [[both, one, both], [both, one, 1 / 41], [one, both, 1458 / 19]]
    np.testing.assert_allclose(result.log_odds, np.log(expected))


def test_map_after_the_first_reading_alone():
    # Subtracted, one reading cancels the prior; only cell (2, 0) is still unexplored.
    prior = build_prior(OCCUPIED, GRID, Prior(p_wall=0.2, p_space=0.9))
    evidence = evidence_of(BehindHit.OCCUPIED)
    result = fuse(evidence, prior, UpdateRule.SUBTRACT_PRIOR, n_readings=1)
    expected = [[9, 9, 9], [9, 9, 1 / 9], [81 / 19, 9, 2]]
    np.testing.assert_allclose(result.log_odds, np.log(expected))
