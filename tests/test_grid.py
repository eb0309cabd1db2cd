import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from occsim import Grid, ParameterError


def naive_share(mask, cell_px):
    """Share of true pixels per cell, one pixel at a time."""
    height, width = mask.shape
    rows, cols = -(-height // cell_px), -(-width // cell_px)
    hits, totals = np.zeros((rows, cols)), np.zeros((rows, cols))
    for row in range(height):
        for col in range(width):
            hits[row // cell_px, col // cell_px] += mask[row, col]
            totals[row // cell_px, col // cell_px] += 1
    return hits / totals


@given(
    height=st.integers(1, 17),
    width=st.integers(1, 17),
    cell_px=st.integers(1, 20),
    seed=st.integers(0, 2**32 - 1),
)
def test_share_counts_the_pixels_a_cell_really_has(height, width, cell_px, seed):
    mask = np.random.default_rng(seed).random((height, width)) < 0.4
    grid = Grid(height_px=height, width_px=width, cell_px=cell_px)
    np.testing.assert_allclose(grid.share(mask), naive_share(mask, cell_px))
    assert grid.pixels_per_cell().sum() == height * width


def test_partial_cells_at_the_edge_by_hand():
    # 3 x 5 px in cells of 2: two rows of cells, three columns; the corner cell is one
    # pixel, which is wall, so its share is 1 although three quarters of it are absent.
    mask = np.zeros((3, 5), dtype=bool)
    mask[2, 4] = mask[0, 0] = True
    grid = Grid(height_px=3, width_px=5, cell_px=2)
    assert grid.shape == (2, 3)
    np.testing.assert_array_equal(grid.share(mask), [[0.25, 0, 0], [0, 0, 1]])


def test_a_point_belongs_to_the_cell_by_floor():
    grid = Grid(height_px=4, width_px=6, cell_px=2)
    x = [0.0, 1.999, 2.0, 5.999, 6.0, -0.001, 0.0]
    y = [0.0, 1.999, 2.0, 3.999, 0.0, 0.0, 4.0]
    np.testing.assert_array_equal(grid.cell_index(x, y), [0, 0, 4, 5, -1, -1, -1])


def test_sizes_fit_into_an_int32():
    largest = Grid(height_px=3, width_px=4, cell_px=2**31 - 1)
    assert largest.share(np.ones((3, 4), dtype=bool)).tolist() == [[1.0]]
    with pytest.raises(
        ParameterError, match="cell_px must be a whole number, 1 to 2,147,4"
    ):
        Grid(height_px=3, width_px=4, cell_px=2**31)


@pytest.mark.parametrize("cell_px", [0, -1, 2.5, True, "3"])
def test_a_cell_is_a_whole_number_of_pixels(cell_px):
    with pytest.raises(ParameterError, match="cell_px must be a whole number"):
        Grid(height_px=4, width_px=4, cell_px=cell_px)


def test_a_mask_of_another_size_is_refused():
    grid = Grid(height_px=4, width_px=4, cell_px=2)
    with pytest.raises(
        ParameterError, match=r"shape \(4, 4\); got bool of shape \(4, 5\)"
    ):
        grid.share(np.zeros((4, 5), dtype=bool))


@pytest.mark.parametrize("dtype", [np.uint8, float])
def test_a_grey_image_is_no_mask(dtype):
    # White is not zero: taken for a mask, the paper would be wall.
    grid = Grid(height_px=4, width_px=4, cell_px=2)
    with pytest.raises(TypeError, match="mask must be an array of bool; got an array"):
        grid.share(np.full((4, 4), 255, dtype=dtype))


def test_equal_grids_are_interchangeable_keys():
    a = Grid(height_px=4, width_px=4, cell_px=2)
    b = Grid(height_px=np.int64(4), width_px=4, cell_px=np.int32(2))
    assert a == b
    assert hash(a) == hash(b)
