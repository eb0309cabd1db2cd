"""The commits of the drawing board's script, for tests without a browser."""

import base64
import zlib

import numpy as np

from occsim.corrections import TILE_PX


def tiles(before, after):
    """The tiles in which two `Corrections` differ, by a loop over all of them."""
    height, width = before.shape
    flags, changed = [], []
    for top in range(0, height, TILE_PX):
        for left in range(0, width, TILE_PX):
            part = np.s_[:, top : top + TILE_PX, left : left + TILE_PX]
            old, new = before.planes[part], after.planes[part]
            flags.append(bool((old != new).any()))
            if flags[-1]:
                tile = np.zeros((2, TILE_PX, TILE_PX), dtype=bool)
                tile[:, : new.shape[1], : new.shape[2]] = new
                changed.append(tile)
    content = np.packbits(flags).tobytes()
    content += b"".join(np.packbits(tile).tobytes() for tile in changed)
    return zlib.compress(content)


def committed_tiles(before, after):
    return base64.b64encode(tiles(before, after)).decode()
