"""Files made to crash or block a program that opens them, or to exhaust its memory.

Each is written by hand after its format's description; none is a virus.
"""

import io
import struct
import zlib

import numpy as np
from PIL import Image


def pdf(*objects: bytes) -> bytes:
    """A PDF of these objects, numbered from 1; the first is the catalogue."""
    out, offsets = b"%PDF-1.7\n", []
    for number, body in enumerate(objects, start=1):
        offsets.append(len(out))
        out += b"%d 0 obj\n" % number + body + b"\nendobj\n"
    rows = b"".join(b"%010d 00000 n \n" % offset for offset in offsets)
    n = len(objects) + 1
    return (
        out
        + b"xref\n0 %d\n0000000000 65535 f \n" % n
        + rows
        + b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n"
        % (n, len(out))
    )


def stream(content: bytes, entries: bytes = b"", packed: bool = False) -> bytes:
    """A stream object, with more entries in its dictionary."""
    if packed:
        content, entries = zlib.compress(content), entries + b" /Filter /FlateDecode"
    return b"<< /Length %d %s >>\nstream\n%s\nendstream" % (
        len(content),
        entries,
        content,
    )


def page(
    content: bytes, resources: bytes, *others: bytes, packed: bool = False
) -> bytes:
    """A PDF of one page of 600 x 400 pt; other objects are numbered from 5."""
    return pdf(
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 600 400] /Contents 4 0 R "
        b"/Resources << %s >> >>" % resources,
        stream(content, packed=packed),
        *others,
    )


FORM = b"/Type /XObject /Subtype /Form /BBox [0 0 600 400]"


def form_that_draws_itself() -> bytes:
    """PDFium follows it until memory is exhausted."""
    inner = b"q /A Do Q q /A Do Q"
    resources = b"/XObject << /A 5 0 R >>"
    return page(
        b"/A Do", resources, stream(inner, FORM + b" /Resources << %s >>" % resources)
    )


def tiling_pattern(step: float = 0.0001) -> bytes:
    """A page filled with tiles that lie closer together than any pixel."""
    tile = stream(
        b"0 0 1 1 re f",
        b"/Type /Pattern /PatternType 1 /PaintType 1 /TilingType 1 /BBox [0 0 1 1] "
        b"/XStep %g /YStep %g /Resources << >>" % (step, step),
    )
    return page(
        b"/Pattern cs /P scn 0 0 600 400 re f", b"/Pattern << /P 5 0 R >>", tile
    )


def nested_forms(n_each: int = 8, depth: int = 7) -> bytes:
    """Forms that draw the next one several times: 8^7 drawings of one line."""
    forms = []
    for level in range(depth):
        number = 6 + level
        is_last = level == depth - 1
        content = b"0 0 m 600 400 l S" if is_last else b"/N Do " * n_each
        resources = b"" if is_last else b"/XObject << /N %d 0 R >>" % number
        forms.append(stream(content, FORM + b" /Resources << %s >>" % resources))
    return page(b"/N Do " * n_each, b"/XObject << /N 5 0 R >>", *forms)


def shading_of_triangles(n: int = 300_000) -> bytes:
    """A Type 4 shading whose triangles each cover the page."""
    corners = np.zeros((n * 3, 6), np.uint8)  # flag 0, x, y in 8 bits, colour
    corners[:, 1] = np.tile([0, 255, 0], n)
    corners[:, 2] = np.tile([0, 0, 255], n)
    shading = stream(
        corners.tobytes(),
        b"/ShadingType 4 /ColorSpace /DeviceRGB /BitsPerCoordinate 8 "
        b"/BitsPerComponent 8 /BitsPerFlag 8 /Decode [0 600 0 400 0 1 0 1 0 1]",
        packed=True,
    )
    return page(b"/S sh", b"/Shading << /S 5 0 R >>", shading)


def one_long_path(n: int = 2_000_000) -> bytes:
    """One path of many segments across the page, stroked."""
    points = b"".join(
        b"%d %d l\n" % (600 * (k & 1), k * 7 % 400) for k in range(1000)
    ) * (n // 1000)
    return page(b"0 0 m\n" + points + b"S", b"", packed=True)


def cad_sheet(n: int = 300_000) -> bytes:
    """What a CAD program exports: short lines, each its own path. Not hostile."""
    rng = np.random.default_rng(7)
    at = rng.integers(0, (590, 390), (n, 2))
    step = rng.integers(-9, 10, (n, 2))
    lines = b"".join(
        b"%d %d m %d %d l S\n" % (x, y, x + dx, y + dy)
        for (x, y), (dx, dy) in zip(at.tolist(), step.tolist(), strict=True)
    )
    return page(b"0.5 w\n" + lines, b"", packed=True)


def image_in_pdf(side_px: int = 25_000) -> bytes:
    """A page with one image that unpacks to 1.9 GB."""
    row = bytes(3 * side_px)
    packer = zlib.compressobj(9)
    content = b"".join(packer.compress(row) for _ in range(side_px)) + packer.flush()
    image = (
        b"<< /Type /XObject /Subtype /Image /Width %d /Height %d /BitsPerComponent 8 "
        b"/ColorSpace /DeviceRGB /Filter /FlateDecode /Length %d >>\nstream\n%s\n"
        b"endstream" % (side_px, side_px, len(content), content)
    )
    return page(b"600 0 0 400 0 0 cm /I Do", b"/XObject << /I 5 0 R >>", image)


def jpeg_of_many_scans(n_scans: int = 3000, side_px: int = 4000) -> bytes:
    """A progressive JPEG whose last scan is repeated many times."""
    out = io.BytesIO()
    Image.new("L", (side_px, side_px), 128).save(out, "JPEG", progressive=True)
    data = out.getvalue()
    last = data.rindex(b"\xff\xda")
    return data[:last] + data[last:-2] * n_scans + b"\xff\xd9"


def chunk(kind: bytes, body: bytes) -> bytes:
    """A chunk of a PNG."""
    return (
        struct.pack(">I", len(body))
        + kind
        + body
        + struct.pack(">I", zlib.crc32(kind + body))
    )


def png_bomb(side_px: int = 30_000, n_rows: int = 2000) -> bytes:
    """A PNG of colours whose pixels take a thousand times its size, and are cut off."""
    packer = zlib.compressobj(1)
    row = bytes(1 + 3 * side_px)
    body = b"".join(packer.compress(row) for _ in range(n_rows)) + packer.flush()
    header = struct.pack(">IIBBBBB", side_px, side_px, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", body)
        + chunk(b"IEND", b"")
    )


def image_bomb(kind: str, width: int = 16_000, height: int = 16_000) -> bytes:
    """A white picture in colour that takes 1 GB decoded; less where a format ends."""
    image = Image.new("1" if kind in ("TIFF", "GIF") else "RGB", (width, height), 1)
    options = {
        "TIFF": {"compression": "group4"},
        "WEBP": {"lossless": True, "method": 0},
    }
    out = io.BytesIO()
    image.save(out, kind, **options.get(kind, {}))
    return out.getvalue()


def tiff_of_a_claimed_size(side_px: int = 29_000) -> bytes:
    """A TIFF of colours, LZW, that has one strip and claims all rows."""
    out = io.BytesIO()
    Image.new("RGB", (64, 64), "white").save(out, "TIFF", compression="tiff_lzw")
    data = bytearray(out.getvalue())
    (start,) = struct.unpack_from("<I", data, 4)
    (count,) = struct.unpack_from("<H", data, start)
    for k in range(count):
        at = start + 2 + 12 * k
        tag, kind = struct.unpack_from("<HH", data, at)
        if tag in (256, 257, 278):  # width, height, rows in a strip
            struct.pack_into("<I" if kind == 4 else "<H", data, at + 8, side_px)
    return bytes(data)


def bmp_of_a_claimed_size(side_px: int) -> bytes:
    """A BMP of colours, run-length coded, that ends after its header."""
    info = struct.pack("<IiiHHIIiiII", 40, side_px, side_px, 1, 24, 0, 0, 0, 0, 0, 0)
    return struct.pack("<2sIHHI", b"BM", 54, 0, 0, 54) + info


def gif_of_a_claimed_size(side_px: int) -> bytes:
    """A GIF that ends after the description of its first picture."""
    size = struct.pack("<HH", side_px, side_px)
    return (
        b"GIF89a" + size + b"\x80\0\0" + bytes(6) + b",\0\0\0\0" + size + b"\0\x02\0;"
    )


def jpeg_of_a_claimed_size(side_px: int) -> bytes:
    """A JPEG whose frame is larger than its scan."""
    out = io.BytesIO()
    Image.new("RGB", (64, 64), "white").save(out, "JPEG", progressive=True)
    data = out.getvalue()
    at = data.index(b"\xff\xc2") + 5
    return data[:at] + struct.pack(">HH", side_px, side_px) + data[at + 4 :]
