"""Wall detection: its time, and how well it finds the walls of the samples."""

from collections.abc import Iterator

import cv2

from occsim.imaging import Drawing
from occsim.samples import load_sample, sample_names
from occsim.walls import compare_masks, detect_walls
from tests.benchmarks.table import Row, median_ms, timed_row

LARGE_PX = 1500, 1000
AIM_F1 = 0.80


def rows() -> Iterator[Row]:
    small = load_sample("b").drawing
    large = Drawing(rgb=cv2.resize(small.rgb, LARGE_PX, interpolation=cv2.INTER_CUBIC))
    for drawing, aim_ms in ((small, 200.0), (large, 500.0)):
        height, width = drawing.shape
        ms = median_ms(lambda drawing=drawing: detect_walls(drawing))
        about = f"detect walls, {width} x {height} px, furnished"
        yield timed_row(about, ms, aim_ms)
    for name in sample_names():
        sample = load_sample(name)
        mask = detect_walls(sample.drawing).mask
        found = compare_masks(mask, sample.world.occupied)
        beside = f"precision {found.precision:.3f}, recall {found.recall:.3f}"
        yield Row(
            f"F1 of the walls of {name}, 2 px tolerance",
            f"{found.f1:.3f}",
            f">= {AIM_F1}",
            beside,
            found.f1 >= AIM_F1,
        )
