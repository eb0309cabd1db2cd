"""Drawings from the pages of a PDF, rendered by PDFium."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from occsim.errors import DrawingError
from occsim.imaging.drawing import Drawing
from occsim.imaging.source import (
    check_size,
    decoding,
    guess,
    has_pdf_mark,
    read_drawing_file,
)

DEFAULT_PDF_SIDE_PX = 2000
"""Longer side of a rendered PDF page, px: thin walls stay two or more px wide."""


def pdf_page_count(source: bytes | str | Path) -> int:
    """Return the number of pages of a PDF.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.

    Returns
    -------
    int

    Raises
    ------
    DrawingError
        Where the file cannot be read as a PDF.
    """
    data, name = read_drawing_file(source)
    with decoding(), _pdf(data, name) as document:
        return len(document)


def load_pdf_page(
    source: bytes | str | Path,
    page: int = 1,
    *,
    long_side_px: int = DEFAULT_PDF_SIDE_PX,
    name: str | None = None,
) -> Drawing:
    """Return a page of a PDF as a drawing.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.
    page : int, default 1
        Page number, from 1.
    long_side_px : int, default 2000
        Longer side of the drawing, px.
    name : str, optional
        What to call the drawing; by default the file's name, or "drawing".

    Returns
    -------
    Drawing
        The page on white.

    Raises
    ------
    DrawingError
        Where the file cannot be read as a PDF, has no such page, or the page is so
        long and narrow, or `long_side_px` such, that the size is not allowed.
    """
    data, file_name = read_drawing_file(source)
    name = name or file_name
    with decoding(), _pdf(data, name) as document:
        if not 1 <= page <= len(document):
            raise DrawingError(
                f"page must lie between 1 and {len(document)}, the last page of "
                f"{name}; got {page!r}"
            )
        sheet = document[page - 1]
        width_pt, height_pt = sheet.get_size()
        scale = long_side_px / max(width_pt, height_pt, 1e-6)
        check_size(math.ceil(width_pt * scale), math.ceil(height_pt * scale))
        rgb = sheet.render(scale=scale, rev_byteorder=True).to_numpy()[:, :, :3]
        return Drawing(rgb=rgb.copy(), name=name)


def is_pdf(source: bytes | str | Path) -> bool:
    """Return whether a file is a PDF by its first bytes, whatever its name says.

    Parameters
    ----------
    source : bytes, str or Path
        The file's content, or where it is.

    Returns
    -------
    bool

    Raises
    ------
    DrawingError
        Where the file cannot be opened, is empty or too large.
    """
    return has_pdf_mark(read_drawing_file(source)[0])


@contextmanager
def _pdf(data: bytes, name: str) -> Iterator[Any]:
    """Open a PDF; anything that PDFium cannot do becomes a `DrawingError`."""
    # Here, because few drawings are PDFs; the library carries no types.
    import pypdfium2  # type: ignore[import-untyped]

    if not has_pdf_mark(data):
        raise DrawingError(f"{name} is not a PDF; got {guess(data)}")
    try:
        document = pypdfium2.PdfDocument(data)
        try:
            yield document
        finally:
            document.close()
    except pypdfium2.PdfiumError as error:
        reason = str(error).split("PDFium: ")[-1].rstrip(").")
        raise DrawingError(
            f"{name} cannot be read as a PDF ({reason}); "
            "an undamaged PDF without password is needed"
        ) from None
