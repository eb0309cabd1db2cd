"""Wall detection: a small floor plan, and one of 1500 x 1000 px."""

from collections.abc import Iterator

import cv2

from occsim.drawing import Drawing
from occsim.samples import load_sample
from occsim.walls import detect_walls
from tests.benchmarks.table import Row, median_ms, timed_row

LARGE_PX = 1500, 1000


def rows() -> Iterator[Row]:
    small = load_sample("b").drawing
    large = Drawing(rgb=cv2.resize(small.rgb, LARGE_PX, interpolation=cv2.INTER_CUBIC))
    for drawing, aim_ms in ((small, 200.0), (large, 500.0)):
        height, width = drawing.shape
        ms = median_ms(lambda drawing=drawing: detect_walls(drawing))
        about = f"detect walls, {width} x {height} px, furnished"
        yield timed_row(about, ms, aim_ms)
