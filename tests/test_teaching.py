"""The figures of the teacher's guides are those of the library.

``python -m tests.test_teaching`` writes the tables again.
"""

import math
import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import pytest

from occsim import (
    Grid,
    MappingRun,
    MapSettings,
    Prior,
    Region,
    Sensor,
    UpdateRule,
    coverage,
    lens_world,
    load_sample,
    one_reading,
    prior_drawing,
    sample_names,
)
from occsim.logodds import is_occupied, logit, p_free_from_log_odds
from occsim.priors import recommend
from occsim.samples import drawings_of_size
from pages._ui import outcomes, teaching
from pages._ui.components.lens.document import PARTS
from pages._ui.course import COURSE
from pages._ui.settings import TABLE

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
LOOKED, ALL = Region.EXPLORED, Region.ALL
BLANK, SOURCE = Prior.uninformative(), Prior()
CONTROL = Prior(p_wall=0.12, p_space=0.12)


@cache
def run(name: str, cell_px: int = 3) -> MappingRun:
    sample = load_sample(name)
    return MappingRun(sample, MapSettings(cell_px=cell_px, sensor=sample.sensor))


@cache
def other(name: str) -> MappingRun:
    """With the drawing of another sample of the size, else mirrored: as in lesson 5."""
    sample = load_sample(name)
    names = [n for n in drawings_of_size(sample.drawing.shape) if n != name]
    which = sorted(names)[0] if names else "mirrored"
    return run(name).with_prior_mask(prior_drawing(sample, which))


def f2(of: MappingRun, prior: Prior, rule=ONCE, region=LOOKED) -> str:
    return f"{100 * of.scores(prior, rule, region).f2:.1f}"


def differing(name: str) -> tuple[int, int, int]:
    once, off = (run(name).map(SOURCE, rule) for rule in (ONCE, SUBTRACT))
    walls = [is_occupied(one.log_odds) for one in (once, off)]
    differ = (walls[0] != walls[1]) & (once.n_updates > 0)
    right = [int((differ & (w == run(name).truth_cells)).sum()) for w in walls]
    return int(differ.sum()), *right


def best_pair(name: str, rule: UpdateRule, region: Region = LOOKED) -> str:
    front = run(name).front(rule, region)
    i = recommend(front)
    return f"({front.p_wall[i]:.3g}, {front.p_space[i]:.3g})"


def low_cases(name: str, rule: UpdateRule) -> str:
    sizes = (3, 5, 10)
    sweeps = [run(name, px).sweep(rule=rule) for px in sizes]
    low = sum(
        bool(s.recall[0].max() == s.recall[s.recall == s.recall].max()) for s in sweeps
    )
    return f"{low} of {len(sizes)}"


@cache
def best_control(name: str) -> Prior:
    return outcomes.best_control(run(name).sweep)


def first_walls(name: str) -> str:
    found = run(name).curves(BLANK).tp.tolist()
    return str(next(n for n, walls in enumerate(found) if walls))


SAMPLE_COLUMNS: dict[str, Callable[[str], str]] = {
    "blank map": lambda n: f2(run(n), BLANK),
    "looked at: blank map": lambda n: f2(run(n), BLANK),
    "own drawing, once": lambda n: f2(run(n), SOURCE),
    "looked at: own drawing": lambda n: f2(run(n), SOURCE),
    "own drawing, taken off": lambda n: f2(run(n), SOURCE, SUBTRACT),
    "other drawing, once": lambda n: f2(other(n), SOURCE),
    "other drawing, taken off": lambda n: f2(other(n), SOURCE, SUBTRACT),
    "control": lambda n: f2(run(n), CONTROL),
    "all cells: blank map": lambda n: f2(run(n), BLANK, region=ALL),
    "all cells: own drawing": lambda n: f2(run(n), SOURCE, region=ALL),
    "all cells: control": lambda n: f2(run(n), CONTROL, region=ALL),
    "best control": lambda n: f"{best_control(n).p_wall:.2f}",
    "looked at: control": lambda n: f2(run(n), best_control(n)),
    "all cells: best control": lambda n: f2(run(n), best_control(n), region=ALL),
    "first walls after reading": first_walls,
    "walls missed": lambda n: str(run(n).scores(BLANK).fn),
    "precision": lambda n: f"{100 * run(n).scores(BLANK).precision:.1f}",
    "recall": lambda n: f"{100 * run(n).scores(BLANK).recall:.1f}",
    "recall in cells of 1 px": lambda n: f"{100 * run(n, 1).scores(BLANK).recall:.1f}",
    "judged differently": lambda n: str(differing(n)[0]),
    "once is right": lambda n: str(differing(n)[1]),
    "taken off is right": lambda n: str(differing(n)[2]),
    "best pair, once": lambda n: best_pair(n, ONCE),
    "best pair, taken off": lambda n: best_pair(n, SUBTRACT),
    "best pair, taken off, all cells": lambda n: best_pair(n, SUBTRACT, ALL),
    "cases, once": lambda n: low_cases(n, ONCE),
    "cases, taken off": lambda n: low_cases(n, SUBTRACT),
}
"""What stands in each column of a table whose rows are the reference drawings."""


def sample_rows(heads: list[str]) -> Iterator[list[str]]:
    for name in sample_names():
        yield [name, *(SAMPLE_COLUMNS[head](name) for head in heads[1:])]


def lens_rows(_: list[str]) -> Iterator[list[str]]:
    """The mixed cells where lesson 1 opens, and the silent one of exercise 1."""
    world = lens_world()
    grid = Grid(height_px=world.shape[0], width_px=world.shape[1], cell_px=4)
    for y, wanted in ((16.5, None), (28.5, (6, 9))):
        sensor = Sensor(range_px=36.0, fov_rad=math.pi / 6)
        seen = one_reading(world, (8.5, y, 0.0), sensor, grid)
        mixed = (seen.n_empty > 0) & (seen.n_object > 0)
        for row, col in zip(*mixed.nonzero(), strict=True):
            if wanted in (None, (row, col)):
                counts = seen.n_empty[row, col], seen.n_object[row, col]
                l_k = seen.log_odds[row, col]
                said = f"{l_k:+.2f}".replace("-", "−") if l_k else "0.00"
                yield [f"(8.5, {y})", f"{row}, {col}", *map(str, counts), said]


def sum_rows(_: list[str]) -> Iterator[list[str]]:
    prior = float(logit(0.18))
    said = {"empty": float(logit(0.9)), "object": float(logit(0.1))}
    for names in (["empty"], ["empty"] * 2, ["empty", "object"], ["object"] * 2):
        total = sum(said[name] for name in names)
        rules = prior + total, prior + total - len(names) * prior
        shown = [f"{float(p_free_from_log_odds(l_k)):.3f}" for l_k in rules]
        yield [", ".join(names), *shown]


def view_rows(_: list[str]) -> Iterator[list[str]]:
    sample = load_sample("d")
    for degrees, range_px in ((30, 20), (90, 20), (60, 22), (30, 24), (30, 40)):
        sensor = Sensor(range_px=range_px, fov_rad=math.radians(degrees))
        of = MappingRun(sample, MapSettings(cell_px=3, sensor=sensor))
        scores = of.scores(BLANK)
        shares = coverage(of.map(BLANK)), scores.precision, scores.recall
        shown = [f"{100 * share:.1f}" for share in shares]
        yield [f"{degrees} degrees, {range_px} px", *shown]


TABLES = {
    "sample": sample_rows,
    "pose": lens_rows,
    "readings": sum_rows,
    "view": view_rows,
}
"""Who writes the rows of a table, by the first word of its head."""
_TABLE = re.compile(r"^(\| (\w+) \|?.*\|)\n(\|[-:|]+\|)\n((?:\|.*\|\n)*)", re.MULTILINE)
LINK_NAMES = {*TABLE, "step", "section", "drawing", *(f"lens_{name}" for name in PARTS)}
PLAIN_NUMBERS = {"4.22", "9.1", "0.9", "0.1", "0.2", "0.12", "0.18"}
"""Numbers that the model or an exercise sets; they are not results."""


def filled(text: str) -> str:
    """A guide with its tables computed."""

    def fill(found: re.Match[str]) -> str:
        head, first, line, rows = found.groups()
        if first not in TABLES:
            return found.group()
        heads = [cell.strip() for cell in head.strip("|").split("|")]
        computed = [f"| {' | '.join(row)} |\n" for row in TABLES[first](heads)]
        return f"{head}\n{line}\n{''.join(computed)}"

    return _TABLE.sub(fill, text)


@pytest.mark.parametrize("lesson", COURSE, ids=lambda one: one.title)
def test_the_tables_of_a_guide_are_what_the_library_computes(lesson):
    text = teaching.guide(lesson)
    assert text == filled(text)
    assert any(f"| {first} |" in text for first in TABLES)


@pytest.mark.parametrize("lesson", COURSE, ids=lambda one: one.title)
def test_a_guide_has_its_parts_and_no_result_outside_its_tables(lesson):
    text = teaching.guide(lesson)
    assert text.startswith(f"# Lesson {lesson.number}. {lesson.title}\n")
    for part in (
        "What students think first",
        "The question that moves them",
        "What the model leaves out",
        "Numbers",
    ):
        assert f"**{part}.**" in text
    prose = _TABLE.sub("", text)
    assert set(re.findall(r"\d+\.\d+", prose)) <= PLAIN_NUMBERS


@pytest.mark.parametrize("lesson", COURSE[1:], ids=lambda one: one.title)
def test_a_guide_names_controls_by_their_names_in_a_link(lesson):
    names = re.findall(r"`(\w+)`", teaching.guide(lesson))
    assert names
    assert set(names) <= LINK_NAMES


if __name__ == "__main__":
    for one in COURSE:
        (path,) = Path(teaching.FOLDER).glob(f"{one.number:02d}_*.md")
        path.write_text(filled(path.read_text(encoding="utf-8")), encoding="utf-8")
