"""A drawing: the image an architect gives, and its safe loading from a file.

Files are not trusted: only the formats of a short list are tried, sizes are read from
the header before any pixel is decoded, decoding happens in a process of its own with
limits of memory and time, and every failure becomes a `DrawingError` of one sentence.
"""

from occsim.imaging.drawing import Drawing
from occsim.imaging.image import load_drawing
from occsim.imaging.kinds import FileKind, kind_of_file, png_size
from occsim.imaging.pdf import is_pdf, load_pdf_page, pdf_page_count
from occsim.imaging.source import MAX_FILE_BYTES, MAX_PIXELS, MAX_SIDE_PX, MIN_SIDE_PX

__all__ = [
    "MAX_FILE_BYTES",
    "MAX_PIXELS",
    "MAX_SIDE_PX",
    "MIN_SIDE_PX",
    "Drawing",
    "FileKind",
    "is_pdf",
    "kind_of_file",
    "load_drawing",
    "load_pdf_page",
    "pdf_page_count",
    "png_size",
]
