"""Drawings from the pages of a PDF."""

from pathlib import Path

from occsim.errors import DrawingError
from occsim.imaging.drawing import Drawing
from occsim.imaging.kinds import FileKind, kind_of_file
from occsim.imaging.pool import POOL
from occsim.imaging.source import checked_side, read_drawing_file

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
    data, name = _read_pdf(source, None)
    reply, _ = POOL.answer(data, name, task="count")
    return int(reply["n_pages"])


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
        The page on white, with what is filled into its forms.

    Raises
    ------
    DrawingError
        Where the file cannot be read as a PDF, has no such page, or the page is so
        long and narrow, or `long_side_px` such, that the size is not allowed; where it
        takes too much memory or time.
    ParameterError
        Where `long_side_px` lies outside `MIN_SIDE_PX` to `MAX_SIDE_PX`.
    """
    data, name = _read_pdf(source, name)
    long_side_px = checked_side("long_side_px", long_side_px)
    if not isinstance(page, int) or isinstance(page, bool):
        raise DrawingError(f"page must be a whole number from 1; got {page!r:.60}")
    _, rgb = POOL.answer(data, name, task="page", page=page, long_side_px=long_side_px)
    return Drawing.from_decoder(rgb, name)


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
    return kind_of_file(read_drawing_file(source)[0]) is FileKind.PDF


def _read_pdf(source: bytes | str | Path, name: str | None) -> tuple[bytes, str]:
    """Return the content and name of a file that has a PDF's signature."""
    data, name = read_drawing_file(source, name)
    kind = kind_of_file(data, name)
    if kind is not FileKind.PDF:
        raise DrawingError(f"{name} is not a PDF; got {kind.about}")
    return data, name
