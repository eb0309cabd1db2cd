"""Names for the array types and callbacks that the library's signatures share."""

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import numpy.typing as npt

BoolArray = npt.NDArray[np.bool_]
ByteArray = npt.NDArray[np.uint8]
FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

Progress = Callable[[int, int], None]
"""Called as ``on_progress(done, total)`` from time to time during a long call."""


class ShortRepr:
    """Result classes with arrays, printed in one line: types and shapes, no numbers.

    For dataclasses made with ``repr=False``.
    """

    def __repr__(self) -> str:
        shown = ", ".join(
            f"{field.name}={_shown(getattr(self, field.name))}"
            for field in fields(self)  # type: ignore[arg-type]  # of the subclass
        )
        return f"{type(self).__name__}({shown})"


def _shown(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{list(value.shape)}"
    return repr(value)
