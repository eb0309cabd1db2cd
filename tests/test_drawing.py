"""Loading a drawing: every kind of image that is allowed, every kind that is not."""

import io
import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image, ImageOps

from occsim.errors import DrawingError, ParameterError
from occsim.imaging import (
    MAX_PIXELS,
    Drawing,
    is_pdf,
    load_drawing,
    load_pdf_page,
    pdf_page_count,
)
from tests.robust import hostile

# An odd, asymmetric picture: a turned, mirrored or colour-swapped one differs.
PICTURE = np.full((20, 30, 3), 255, np.uint8)
PICTURE[2:5, 3:20] = (200, 30, 30)
PICTURE[10:18, 5:9] = (0, 0, 0)


def encoded(image: np.ndarray | Image.Image, kind: str, **options) -> bytes:
    if not isinstance(image, Image.Image):
        image = Image.fromarray(image)
    out = io.BytesIO()
    image.save(out, kind, **options)
    return out.getvalue()


def png_header(width: int, height: int) -> bytes:
    """A PNG that claims a size and holds no pixel."""
    body = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    start = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + body
    empty = b"IDAT" + zlib.compress(b"")
    data = struct.pack(">I", len(empty) - 4) + empty
    return (
        start
        + struct.pack(">I", zlib.crc32(body))
        + data
        + struct.pack(">I", zlib.crc32(empty))
    )


def pdf(*sizes_pt: tuple[int, int]) -> bytes:
    """A PDF of white pages, each with a black square in its lower left quarter."""
    import pypdfium2

    document = pypdfium2.PdfDocument.new()
    for width, height in sizes_pt:
        page = document.new_page(width, height)
        square = pypdfium2.raw.FPDFPageObj_CreateNewRect(0, 0, width / 2, height / 2)
        pypdfium2.raw.FPDFPath_SetDrawMode(
            square, pypdfium2.raw.FPDF_FILLMODE_WINDING, 0
        )
        pypdfium2.raw.FPDFPage_InsertObject(page.raw, square)
        page.gen_content()
    out = io.BytesIO()
    document.save(out)
    document.close()
    return out.getvalue()


@pytest.mark.parametrize("kind", ["PNG", "TIFF", "BMP", "PPM"])
def test_lossless_colour_comes_back_exactly(kind):
    assert np.array_equal(load_drawing(encoded(PICTURE, kind)).rgb, PICTURE)


@pytest.mark.parametrize("kind", ["JPEG", "WEBP"])
def test_lossy_colour_comes_back_nearly(kind):
    options = {"quality": 95} if kind == "JPEG" else {"lossless": True}
    loaded = load_drawing(encoded(PICTURE, kind, **options)).rgb.astype(int)
    assert np.abs(loaded - PICTURE).mean() < 6


def test_grey_file_has_three_equal_colours():
    gray = PICTURE[:, :, 1]
    drawing = load_drawing(encoded(gray, "PPM"))  # a PGM, as map servers use
    assert np.array_equal(drawing.rgb, np.repeat(gray[:, :, None], 3, axis=2))
    assert np.array_equal(drawing.gray, gray)


def test_black_and_white_and_palette_images():
    bits = PICTURE[:, :, 1] > 100
    assert np.array_equal(
        load_drawing(encoded(bits, "PNG")).gray, bits.astype(np.uint8) * 255
    )
    palette = Image.fromarray(PICTURE).convert("P", palette=Image.Palette.ADAPTIVE)
    assert np.array_equal(load_drawing(encoded(palette, "PNG")).rgb, PICTURE)


def test_sixteen_bits_are_scaled_and_not_clipped():
    # 257 * v is the sixteen-bit level of the eight-bit level v.
    ramp = np.tile(np.arange(0, 256, 8, dtype=np.uint16), (20, 1)) * 257
    expected = np.tile(np.arange(0, 256, 8), (20, 1))
    for kind in ("PNG", "TIFF"):
        assert np.array_equal(load_drawing(encoded(ramp, kind)).gray, expected)
    pgm = b"P5 32 20 65535\n" + ramp.astype(">u2").tobytes()
    assert np.array_equal(load_drawing(pgm).gray, expected)
    colour = cv2.imencode(".png", np.repeat(ramp[:, :, None], 3, axis=2))[1].tobytes()
    assert np.abs(load_drawing(colour).gray.astype(int) - expected).max() <= 1


def tiff(pixels: bytes, width: int, height: int, bits: int, photometric: int) -> bytes:
    """A TIFF of grey in one strip, written after TIFF 6.0, big-endian."""
    entries = [
        *[(256, 4, width), (257, 4, height), (258, 3, bits << 16), (259, 3, 1 << 16)],
        *[(262, 3, photometric << 16), (273, 4, 8), (277, 3, 1 << 16)],
        *[(278, 4, height), (279, 4, len(pixels))],
    ]
    table = b"".join(struct.pack(">HHII", tag, kind, 1, v) for tag, kind, v in entries)
    start = struct.pack(">2sHI", b"MM", 42, 8 + len(pixels))
    return start + pixels + struct.pack(">H", len(entries)) + table + bytes(4)


@pytest.mark.parametrize("photometric", [0, 1])
def test_twelve_and_sixteen_bits_are_read_with_white_where_the_file_says(photometric):
    """Levels 0, 1/4, 1/2 and all of the span; photometric 0: zero is white."""
    expected = [0, 64, 128, 255] if photometric else [255, 191, 127, 0]
    deep = np.tile(np.array([0, 16384, 32768, 65535], ">u2"), (8, 3)).tobytes()
    gray = load_drawing(tiff(deep, 12, 8, 16, photometric)).gray
    assert np.abs(gray[0, :4].astype(int) - expected).max() <= 1
    # Two levels in three bytes: 0x000, 0x400; 0x800, 0xFFF.
    packed = (bytes([0x00, 0x04, 0x00]) + bytes([0x80, 0x0F, 0xFF])) * 3
    gray = load_drawing(tiff(packed * 8, 12, 8, 12, photometric)).gray
    assert gray.shape == (8, 12)
    assert np.abs(gray[0, :4].astype(int) - expected).max() <= 1


def test_floating_point_image_spans_zero_to_one():
    half = np.full((10, 10), 0.5, np.float32)
    half[0] = np.nan
    gray = load_drawing(encoded(half, "TIFF")).gray
    assert (gray[1:] == 128).all()
    assert (gray[0] == 0).all()


def test_transparency_is_laid_on_white_paper():
    rgba = np.zeros((10, 10, 4), np.uint8)  # black, and invisible
    rgba[:5, :, 3] = 255
    rgba[5, :, 3] = 51  # a fifth opaque: 255 * 0.8 = 204
    gray = load_drawing(encoded(rgba, "PNG")).gray
    assert (gray[:5] == 0).all()
    assert (gray[5] == 204).all()
    assert (gray[6:] == 255).all()


def test_transparent_palette_entry_is_white():
    index = np.zeros((10, 10), np.uint8)
    index[:5] = 1
    image = Image.fromarray(index, "P")
    image.putpalette([0, 0, 0, 10, 20, 30])
    loaded = load_drawing(encoded(image, "PNG", transparency=0)).rgb
    assert (loaded[5:] == 255).all()
    assert (loaded[:5] == (10, 20, 30)).all()


def test_print_colours_become_screen_colours():
    cmyk = Image.new("CMYK", (16, 16), (0, 255, 255, 0))
    red = load_drawing(encoded(cmyk, "JPEG", quality=95)).rgb[8, 8]
    assert red[0] > 200
    assert max(red[1], red[2]) < 60


def test_camera_orientation_is_applied():
    exif = Image.Exif()
    exif[0x0112] = 6  # the camera was held with its top to the right
    stored = np.rot90(PICTURE)  # what its sensor stored
    loaded = load_drawing(encoded(stored, "PNG", exif=exif)).rgb
    assert np.array_equal(loaded, PICTURE)


@pytest.mark.parametrize("orientation", range(1, 9))
def test_every_orientation_is_what_pillow_makes_of_it(orientation):
    exif = Image.Exif()
    exif[0x0112] = orientation
    data = encoded(PICTURE, "PNG", exif=exif)
    expected = np.asarray(ImageOps.exif_transpose(Image.open(io.BytesIO(data))))
    assert np.array_equal(load_drawing(data).rgb, expected)


def sheet() -> np.ndarray:
    """White, 900 x 1300 px, with black lines of 1 px across and down."""
    gray = np.full((900, 1300), 255, np.uint8)
    gray[123] = gray[:, 457] = 0
    return gray


@pytest.mark.parametrize("kind", ["PNG", "TIFF", "JPEG", "GIF"])
def test_large_image_is_reduced_and_thin_lines_stay_ink(kind):
    """At a fifth, a line of 1 px covers a fifth of its pixels: as their mean, it would
    have 204; it has at least 0.6 of its ink, 102."""
    data = encoded(sheet(), kind, **({"quality": 100} if kind == "JPEG" else {}))
    drawing = load_drawing(data, max_side_px=260)
    assert drawing.shape == (180, 260)
    gray = drawing.gray.astype(int)
    rows, columns = gray[:, 10], gray[10]
    assert rows.argmin() == 123 // 5
    assert columns.argmin() == 457 // 5
    assert abs(rows.min() - 102) < 4
    assert abs(columns.min() - 102) < 4
    assert gray.max() == 255
    dark = load_drawing(data, max_side_px=260, keep_dark=True).gray.astype(int)
    assert dark[:, 10].min() < 8
    assert dark[10].min() < 8


def test_reduction_covers_every_pixel_once_at_any_size():
    """A black pixel anywhere leaves one dark pixel, where it lies in proportion."""
    for x, y, side in [(0, 0, 97), (1299, 899, 97), (641, 333, 613), (77, 801, 41)]:
        gray = np.full((900, 1300), 255, np.uint8)
        gray[y, x] = 0
        dark = load_drawing(encoded(gray, "PNG"), max_side_px=side, keep_dark=True).gray
        assert dark.shape == (round(900 * side / 1300), side)
        assert np.argwhere(dark < 128).tolist() == [
            [int((y + 0.5) * dark.shape[0] / 900), int((x + 0.5) * side / 1300)]
        ]


def test_small_image_keeps_its_size_and_its_pixels():
    assert np.array_equal(
        load_drawing(encoded(PICTURE, "PNG"), max_side_px=30).rgb, PICTURE
    )
    with pytest.raises(DrawingError, match="between 8 and"):
        load_drawing(encoded(sheet()[:100], "PNG"), max_side_px=60)
    for wrong in (7, 30_001, 99.5, True, "1500"):
        with pytest.raises(ParameterError, match="max_side_px must be a whole number"):
            load_drawing(encoded(PICTURE, "PNG"), max_side_px=wrong)


def test_first_frame_of_an_animation_is_taken():
    frames = [Image.new("L", (12, 9), level) for level in (10, 200)]
    data = encoded(frames[0], "GIF", save_all=True, append_images=frames[1:])
    drawing = load_drawing(data)
    assert drawing.shape == (9, 12)
    assert (drawing.gray == 10).all()


def test_name_is_the_files_own_unless_given(tmp_path):
    path = tmp_path / "ground floor.png"
    path.write_bytes(encoded(PICTURE, "PNG"))
    assert load_drawing(path).name == "ground floor.png"
    assert load_drawing(str(path), name="x").name == "x"
    assert load_drawing(path.read_bytes()).name == "drawing"
    assert load_drawing(path).digest == load_drawing(path.read_bytes()).digest


def test_jpeg_called_png_is_still_read():
    data = encoded(PICTURE, "JPEG")
    assert load_drawing(data, name="photo.png").shape == (20, 30)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "empty"),
        (b"x,y,theta\n1,2,3\n", "plain text"),
        (b"PK\x03\x04" + bytes(100), "zip archive"),
        (bytes(range(256)), "not an image"),
        (encoded(PICTURE, "PNG")[:-40], "damaged or cut short"),
        (encoded(PICTURE, "PNG")[:30], "damaged|not an image"),
        (encoded(PICTURE, "TIFF")[:-900], "damaged or cut short"),
        (b"%PDF-1.7\nnothing", "cannot be read as a PDF"),
        (encoded(PICTURE[:7], "PNG"), "between 8 and 30,000 px; got 30 x 7"),
        (png_header(10_000, 8001), "at most 80 megapixels; got 10,000 x 8,001"),
        (png_header(12000, 10000), "120.0 megapixels"),
        (png_header(29000, 29000), "at most 80 megapixels; got .* 841.0 megapixels"),
        (png_header(2_000_000, 10), "between 8 and 30,000 px"),
        (png_header(30_000, 8), "at most 50 times as long as it is wide"),
    ],
)
def test_bad_file_is_refused_in_one_sentence(data, said):
    with pytest.raises(DrawingError, match=said) as caught:
        load_drawing(data, name="plan.png")
    assert "\n" not in str(caught.value)


def test_missing_file_and_folder_are_refused(tmp_path):
    with pytest.raises(DrawingError, match="none.png cannot be opened"):
        load_drawing(tmp_path / "none.png")
    with pytest.raises(DrawingError, match="cannot be opened"):
        load_drawing(tmp_path)


def test_size_is_checked_before_a_pixel_is_decoded():
    """82 megapixels whose pixels are missing: the size is what is complained of."""
    side = int((MAX_PIXELS * 1.03) ** 0.5)
    with pytest.raises(DrawingError, match="megapixels"):
        load_drawing(png_header(side, side))


GOOD_FILES = [
    encoded(PICTURE, kind) for kind in ("PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP")
]


@settings(deadline=None)
@given(
    data=st.sampled_from(GOOD_FILES),
    flips=st.lists(
        st.tuples(st.integers(0, 600), st.integers(0, 255)), min_size=1, max_size=8
    ),
)
def test_damaged_bytes_load_or_are_refused_but_never_crash(data, flips):
    damaged = bytearray(data)
    for position, value in flips:
        damaged[position % len(damaged)] = value
    message = ""
    try:
        load_drawing(bytes(damaged))
    except DrawingError as error:  # any other error fails the test
        message = str(error)
    assert len(message) < 300


def test_pdf_page_is_rendered_at_the_size_asked_for():
    data = pdf((300, 200), (100, 400))
    assert is_pdf(data)
    assert pdf_page_count(data) == 2
    first = load_pdf_page(data, long_side_px=600)
    assert first.shape == (400, 600)
    # PDF counts upwards: the square of the lower left quarter is at the bottom.
    assert (first.gray[210:390, 10:290] == 0).all()
    assert (first.gray[:190] == 255).all()
    assert load_pdf_page(data, 2, long_side_px=400).shape == (400, 100)
    assert load_drawing(data, name="plan.pdf").shape == (1334, 2000)
    assert load_drawing(data, max_side_px=1500).shape == (1000, 1500)


def test_what_is_filled_into_a_pdf_form_is_drawn():
    """A text field without a page content beside it, its look a black square."""
    look = hostile.stream(b"0 0 300 200 re f", hostile.FORM)
    field = (
        b"<< /Type /Annot /Subtype /Widget /FT /Tx /T (a) /Rect [0 0 600 400] /F 4 "
        b"/P 3 0 R /AP << /N 6 0 R >> >>"
    )
    plain = hostile.page(b"", b"", field, look)
    form = plain.replace(
        b"/Pages 2 0 R", b"/Pages 2 0 R /AcroForm << /Fields [5 0 R] >>"
    )
    form = form.replace(b"/Contents 4 0 R", b"/Contents 4 0 R /Annots [5 0 R]")
    gray = load_pdf_page(form, long_side_px=600).gray  # PDFium mends the offsets
    assert (gray[210:390, 10:290] == 0).all()
    assert (gray[:190] == 255).all()


def test_bad_pdf_requests_are_refused():
    data = pdf((300, 200))
    with pytest.raises(DrawingError, match="page must lie between 1 and 1"):
        load_pdf_page(data, 2)
    with pytest.raises(DrawingError, match="is not a PDF; got plain text"):
        pdf_page_count(b"hello")
    with pytest.raises(DrawingError, match="megapixels"):
        load_pdf_page(data, long_side_px=20_000)
    with pytest.raises(
        DrawingError, match="page must be a whole number from 1; got 1.0"
    ):
        load_pdf_page(data, 1.0)
    assert not is_pdf(encoded(PICTURE, "PNG"))


def test_drawing_is_not_writable_and_its_digest_tells_pixels_apart():
    drawing = Drawing(rgb=PICTURE.copy())
    with pytest.raises(ValueError, match="read-only"):
        drawing.rgb[0, 0] = 0
    other = PICTURE.copy()
    other[0, 0] = 0
    assert Drawing(rgb=other).digest != drawing.digest
    with pytest.raises(DrawingError, match="uint8"):
        Drawing(rgb=PICTURE.astype(float))
    with pytest.raises(DrawingError, match="at least one pixel"):
        Drawing(rgb=np.zeros((0, 5, 3), np.uint8))
