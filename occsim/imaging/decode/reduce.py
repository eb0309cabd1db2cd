"""Reducing an image while it is decoded, so that memory holds it only once."""

from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt

Bytes = npt.NDArray[np.uint8]

INK_SHARE = 0.6
"""Where a drawing is reduced, each pixel is at least this share as dark as the darkest
of those it covers. The mean alone would leave a line of 1 px, in a drawing of 9500 px,
a sixth of its darkness, too little for any threshold."""

STRIP_PX = 1_000_000
"""Pixels decoded at a time, about."""


def reduced_size(width: int, height: int, max_side_px: int | None) -> tuple[int, int]:
    """Return width and height of an image whose longer side is to fit.

    Parameters
    ----------
    width, height : int
        Of the image, px.
    max_side_px : int or None
        Longer side allowed, px; None for any.

    Returns
    -------
    tuple of int
    """
    if max_side_px is None or max(width, height) <= max_side_px:
        return width, height
    scale = max_side_px / max(width, height)
    return max(1, round(width * scale)), max(1, round(height * scale))


def strips(
    rows: Callable[[int, int], Bytes],
    size: tuple[int, int],
    wanted: tuple[int, int],
    keep_dark: bool,
) -> Iterator[Bytes]:
    """Return an image from the top, some rows at a time.

    Parameters
    ----------
    rows : callable
        Gives the rows from one to before another, uint8 of shape (n, W, C).
    size, wanted : tuple of int
        Width and height of the image and of the result, px.
    keep_dark : bool
        Whether each new pixel is the darkest of those it covers.

    Yields
    ------
    ndarray of uint8, shape (m, w, 3)
    """
    (width, height), (new_width, new_height) = size, wanted
    step = max(1, STRIP_PX * new_height // (width * height))
    # Every pixel of the image belongs to exactly one of the result.
    edges = np.arange(new_height + 1) * height // new_height
    starts = np.arange(new_width) * width // new_width
    for top in range(0, new_height, step):
        inner = edges[top : top + step + 1]
        block = rows(int(inner[0]), int(inner[-1]))
        if wanted != size:
            block = _pooled(block, inner - inner[0], starts, keep_dark)
        yield np.repeat(block, 3, axis=2) if block.shape[2] == 1 else block


def _pooled(
    block: Bytes,
    edges: npt.NDArray[np.int64],
    starts: npt.NDArray[np.int64],
    dark: bool,
) -> Bytes:
    """Gather rows between the edges, then columns from each start to the next."""
    # Row by row: reduceat over whole blocks takes ten times as long.
    slices = [block[a:b] for a, b in zip(edges[:-1], edges[1:], strict=True)]
    rows = np.stack([part.min(axis=0) for part in slices])
    darkest: Bytes = np.minimum.reduceat(rows, starts, axis=1)
    if dark:
        return darkest
    total = np.stack([part.sum(axis=0, dtype=np.uint32) for part in slices])
    total = np.add.reduceat(total, starts, axis=1)
    widths = np.diff(np.append(starts, block.shape[1]))
    mean = total / (np.diff(edges)[:, None, None] * widths[None, :, None])
    lightest_allowed = 255.0 - INK_SHARE * (255.0 - darkest)
    return np.asarray(np.rint(np.minimum(mean, lightest_allowed)), np.uint8)
