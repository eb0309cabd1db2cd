"""A drawing as pixels."""

import hashlib
from dataclasses import dataclass, field
from functools import cached_property

import cv2
import numpy as np

from occsim._types import ByteArray
from occsim.errors import DrawingError


@dataclass(frozen=True, eq=False)
class Drawing:
    """An architectural drawing as pixels.

    Parameters
    ----------
    rgb : ndarray of uint8, shape (H, W, 3)
        Colours, red first. A private copy is kept, never written to.
    name : str
        What to call it on screen.
    digest : str
        Identifies the pixels: equal digests mean equal images.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Drawing
    >>> sheet = np.full((20, 30, 3), 255, dtype=np.uint8)
    >>> sheet[5:8] = 0
    >>> drawing = Drawing(sheet, name="one wall")
    >>> drawing.shape, int(drawing.gray[6, 0])
    ((20, 30), 0)
    """

    rgb: ByteArray
    name: str = "drawing"
    digest: str = field(default="")

    def __post_init__(self) -> None:
        rgb = np.ascontiguousarray(self.rgb)
        if rgb.flags.writeable:
            # The caller's own array stays writeable; a decoder's, read-only and
            # perhaps of 120 MB, is kept as it is.
            rgb = rgb.copy()
        if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3:
            raise DrawingError(
                "rgb must be uint8 of shape (H, W, 3); "
                f"got {rgb.dtype} of shape {rgb.shape}"
            )
        if not rgb.size:
            raise DrawingError(f"rgb must hold at least one pixel; got {rgb.shape}")
        if not self.digest:
            content = hashlib.sha256(repr(rgb.shape).encode())
            content.update(rgb.data)
            object.__setattr__(self, "digest", content.hexdigest())
        rgb.setflags(write=False)
        object.__setattr__(self, "rgb", rgb)

    @classmethod
    def from_decoder(cls, rgb: ByteArray, name: str) -> "Drawing":
        """Return a drawing that takes over an array without copying it.

        Parameters
        ----------
        rgb : ndarray of uint8, shape (H, W, 3)
            The caller must not write to it afterwards.
        name : str
            What to call it.

        Returns
        -------
        Drawing
        """
        rgb.setflags(write=False)
        return cls(rgb=rgb, name=name)

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, px."""
        height, width, _ = self.rgb.shape
        return height, width

    @cached_property
    def gray(self) -> ByteArray:
        """Brightness (0 black, 255 white), ndarray of uint8 of shape (H, W)."""
        return np.asarray(cv2.cvtColor(self.rgb, cv2.COLOR_RGB2GRAY), dtype=np.uint8)
