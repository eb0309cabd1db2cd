"""A QR code is read back by OpenCV's reader, which shares nothing with its writer."""

import re
from xml.etree import ElementTree

import cv2
import numpy as np
import pytest

from pages._ui.qr import MAX_CHARACTERS, qr_svg

LINK = "http://192.168.1.20:8501/Two_maps?drawing=c&columns=ftrue--rsubtract&step=42"


def painted(svg, module_px=4):
    """The picture that an SVG of horizontal strokes shows, white where nothing is."""
    root = ElementTree.fromstring(svg)
    side = int(root.attrib["viewBox"].split()[2])
    dark = np.zeros((side, side), bool)
    x = y = 0.0
    strokes = next(path.attrib["d"] for path in root if "stroke" in path.attrib)
    for command, numbers in re.findall(r"([Mmh])([^Mmh]*)", strokes):
        at = [float(one) for one in re.findall(r"-?[\d.]+", numbers)]
        if command == "M":
            x, y = at
        elif command == "m":
            x, y = x + at[0], y + at[1]
        else:
            dark[int(y), int(x) : int(x + at[0])] = True
            x += at[0]
    picture = np.where(dark, 0, 255).astype(np.uint8)
    return np.kron(picture, np.ones((module_px, module_px), np.uint8))


@pytest.mark.parametrize("text", [LINK, "a", LINK + "&x=" + "y1-" * 300])
def test_a_code_is_read_as_the_text_it_was_made_from(text):
    read, *_ = cv2.QRCodeDetector().detectAndDecode(painted(qr_svg(text)))
    assert read == text


def test_a_code_has_the_quiet_border_that_readers_need():
    picture = painted(qr_svg(LINK), module_px=1)
    inked = np.argwhere(picture == 0)
    # ISO/IEC 18004: four modules on each side.
    assert inked.min() == 4
    assert inked.max() == len(picture) - 5


@pytest.mark.parametrize("text", ["", "a" * (MAX_CHARACTERS + 1)])
def test_a_text_that_no_reader_could_take_is_refused(text):
    with pytest.raises(ValueError, match=f"1 to {MAX_CHARACTERS} characters; got"):
        qr_svg(text)


def test_no_text_is_part_of_the_picture():
    assert "script" not in qr_svg("<script>alert(1)</script>")
