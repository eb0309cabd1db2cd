"""Pages of a PDF, rendered by PDFium."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from occsim.imaging.decode.images import Picture
from occsim.imaging.decode.limits import Refused, check_size


def count_pages(data: bytes, name: str) -> int:
    """Return the number of pages of a PDF.

    Parameters
    ----------
    data : bytes
        The file's content.
    name : str
        What to call it.

    Returns
    -------
    int

    Raises
    ------
    Refused
    """
    with _opened(data, name) as document:
        return len(document)


def render_page(data: bytes, name: str, page: int, long_side_px: int) -> Picture:
    """Return a page of a PDF, on white.

    Parameters
    ----------
    data : bytes
        The file's content.
    name : str
        What to call it.
    page : int
        From 1.
    long_side_px : int
        Longer side of the picture, px.

    Returns
    -------
    Picture

    Raises
    ------
    Refused
    """
    with _opened(data, name) as document:
        if not 1 <= page <= len(document):
            raise Refused(
                f"page must lie between 1 and {len(document)}, the last page of "
                f"{name}; got {page!r}"
            )
        sheet = document[page - 1]
        width_pt, height_pt = sheet.get_size()
        scale = long_side_px / max(width_pt, height_pt, 1e-6)
        check_size(name, math.ceil(width_pt * scale), math.ceil(height_pt * scale))
        # Three bytes a px from the start: nothing is converted or copied.
        rgb = sheet.render(scale=scale, rev_byteorder=True).to_numpy()[:, :, :3]
        height, width, _ = rgb.shape
        return Picture(width=width, height=height, strips=iter([rgb.copy()]))


@contextmanager
def _opened(data: bytes, name: str) -> Iterator[Any]:
    """Open a PDF; anything that PDFium cannot do becomes `Refused`."""
    # Here, because few drawings are PDFs; the library carries no types.
    import pypdfium2  # type: ignore[import-untyped]

    try:
        document = pypdfium2.PdfDocument(data)
        try:
            document.init_forms()  # before a page is loaded, or its fields stay blank
            yield document
        finally:
            document.close()
    except pypdfium2.PdfiumError as error:
        reason = str(error).split("PDFium: ")[-1].rstrip(").")
        raise Refused(
            f"{name} cannot be read as a PDF ({reason}); "
            "an undamaged PDF without password is needed"
        ) from None
