"""Numbers as this page writes them: lengths with metres, shares, counts."""

from pages._ui import state


def length(length_px: float) -> str:
    """A length in pixels, and in metres where the scale is known."""
    metres_per_px = state.building().metres_per_px
    if metres_per_px is None:
        return f"{length_px:.4g} px"
    return f"{length_px:.4g} px ({length_px * metres_per_px:.2f} m)"


def size() -> str:
    """Width and height of the drawing, in metres as well where the scale is known."""
    height, width = state.building().drawing.shape
    metres_per_px = state.building().metres_per_px
    text = f"{width} × {height} px"
    if metres_per_px is None:
        return text
    return f"{text} ({width * metres_per_px:.1f} × {height * metres_per_px:.1f} m)"


def count(n: int, thing: str) -> str:
    """A number of things."""
    return f"{n:,} {thing}{'' if n == 1 else 's'}"
