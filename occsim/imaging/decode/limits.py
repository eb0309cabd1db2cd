"""Limits of a drawing, checked before decoding where the header is enough."""

MIN_SIDE_PX = 8
"""Smallest side, px: nothing narrower holds two walls and a passage between them."""

MAX_SIDE_PX = 30_000
"""Longest side, px: OpenCV warps no image longer than 32,767 px."""

MAX_ASPECT = 50
"""Longer side by shorter side: at a working size of 1500 px, 30 px are left."""

MAX_PIXELS = 80_000_000
"""Largest drawing, px: 240 MB of colours; 9500 x 6714 px have 64 million."""

MAX_DECODED_BYTES = 400_000_000
"""Most that an image may hold in the decoder: four bytes a px in colour, one in grey
or black and white. So a colour scan may have 100 million px, an A0 sheet at 400 dots an
inch in grey its 248 million, where it is asked for at a smaller size."""

MAX_MEMORY_BYTES = 580_000_000
"""Address space of a decoder: the image, its file, and 120 MB for the program, of which
at most 40 MB are in memory. A decoder was measured to stay below 500 MB."""

MAX_SECONDS = 5
"""Most processor time for one file, s; a plan of 300,000 lines takes 1.5 s."""

MAX_WALL_SECONDS = 9.5
"""Most elapsed time for one file, s, on a busy machine."""


class Refused(ValueError):
    """A file is refused; the text is one sentence for the user."""


def check_size(
    name: str, width: int, height: int, max_pixels: int | None = MAX_PIXELS
) -> None:
    """Refuse sizes that are too small, too large or too narrow.

    Parameters
    ----------
    name : str
        What to call the drawing.
    width, height : int
        Its size, px.
    max_pixels : int or None, default MAX_PIXELS
        Most that it may have; None for any number.

    Raises
    ------
    Refused
    """
    if min(width, height) < MIN_SIDE_PX or max(width, height) > MAX_SIDE_PX:
        raise Refused(
            f"each side of {name} must lie between {MIN_SIDE_PX} and "
            f"{MAX_SIDE_PX:,} px; got {width:,} x {height:,} px"
        )
    if max(width, height) > MAX_ASPECT * min(width, height):
        raise Refused(
            f"{name} may be at most {MAX_ASPECT} times as long as it is wide; "
            f"got {width:,} x {height:,} px"
        )
    if max_pixels is not None and width * height > max_pixels:
        raise Refused(
            f"{name} may have at most {max_pixels / 1e6:.0f} megapixels; "
            f"got {width:,} x {height:,} px, {width * height / 1e6:.1f} megapixels"
        )
