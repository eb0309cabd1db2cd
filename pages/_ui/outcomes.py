"""What comes out of each lesson's prediction, computed from what the page shows."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from occsim import (
    Grid,
    Prior,
    Region,
    Sensor,
    UpdateRule,
    coverage,
    lens_world,
    one_reading,
    sample_names,
)
from occsim.building import Building
from occsim.logodds import logit, p_free_from_log_odds
from occsim.run import MappingRun
from occsim.run.laps import lap_scores
from occsim.sensor import P_FREE_MAX
from occsim.study import StudySettings
from occsim.study.published import SOURCE_CELLS_PX
from pages._ui import compute, state, words
from pages._ui.choices import CHOICES, PriorDrawing
from pages._ui.columns import Column
from pages._ui.course import COURSE
from pages._ui.examples import others
from pages._ui.priors import maps, solving
from pages._ui.priors.answers import best_f2
from pages._ui.priors.scores import BLANK
from pages._ui.runs import Run
from pages._ui.settings import Settings

ONCE, SUBTRACT = UpdateRule.PRIOR_ONCE, UpdateRule.SUBTRACT_PRIOR
SOURCE = Prior()
AS_GOOD = 0.02
"""F2 by which a control may be worse and still do as well."""
LAPS = 3
LITTLE = 0.05
"""Precision whose loss is called up to 5 points."""
LOW, HIGH = 0.1, 0.7
"""p_wall up to which a peak is at the lowest, and from which it is at a high one."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came out, and which answer says so; empty where it is not known yet."""

    text: str
    answer: str = ""


# --- 1, 2: the lens -------------------------------------------------------------------


def silent() -> Outcome:
    """Whether a cell that holds both says nothing, from where the robot stands."""
    seen = state.take_from_lens()
    world = lens_world()
    height, width = world.shape
    sensor = Sensor(
        range_px=float(seen.range_px),
        fov_rad=math.radians(seen.fov_deg),
        behind_hit=seen.behind_hit,
        clear_no_hit=seen.clear_no_hit,
    )
    pose = (seen.x_px, seen.y_px, math.radians(seen.heading_deg))
    grid = Grid(height_px=height, width_px=width, cell_px=seen.cell_px)
    reading = one_reading(world, pose, sensor, grid)
    both = (reading.n_empty > 0) & (reading.n_object > 0)
    rows, cols = (both & (reading.log_odds == 0.0)).nonzero()
    if not len(rows):
        return Outcome(
            "From here no cell that holds both says nothing: move or turn the robot "
            "until one does."
        )
    row, col = int(rows[0]), int(cols[0])
    n = int(reading.n_empty[row, col])
    more = f", as do {len(rows) - 1} more" if len(rows) > 1 else ""
    return Outcome(
        f"It can: from here the cell in row {row}, column {col} says nothing{more}. It "
        f"has {n} empty and {n} object pixels.",
        "yes",
    )


def second() -> Outcome:
    """What the first and the second of two equal readings are worth, in p and in l."""
    seen = state.take_from_lens()
    prior = float(logit(seen.p_free))
    # Where the drawing is taken off, a reading adds something else, but again the same.
    step = float(logit(P_FREE_MAX)) - (prior if seen.rule is SUBTRACT else 0.0)
    p = [float(p_free_from_log_odds(prior + k * step)) for k in range(3)]
    first, then = p[1] - p[0], p[2] - p[1]
    said = f"From the prior {seen.p_free:.2f}, two empty readings "
    said += f"move l by {words.number(step, '+.2f')}"
    at_first = words.number(first, "+.3f")
    if abs(first - then) < 0.0005:
        return Outcome(
            f"{said} each, and p by {at_first} each: from this prior they happen to be "
            "equal in p as well.",
            "both",
        )
    after = words.number(then, "+.3f")
    return Outcome(f"{said} each, but p by {at_first} and then by {after}.", "l")


# --- 3 to 6: maps ---------------------------------------------------------------------


def first_wall() -> Outcome:
    """After which reading a map without a drawing has its first walls."""
    run = compute.mapped(state.building(), state.settings().mapping)
    found = run.curves(BLANK).tp.tolist()
    n = next((n for n, walls in enumerate(found) if walls), None)
    if n is None:
        return Outcome("This robot meets no wall on its tour.")
    return Outcome(
        f"The first are there after reading {n} of {len(found) - 1}: {found[n]} wall "
        f"cell{'s' * (found[n] != 1)}, met by the cone of that reading. Of all other "
        "walls the map knows nothing yet.",
        "cone",
    )


def caught_up() -> Outcome:
    """When a map without a drawing has found as many walls as one with it."""
    building = state.building()
    run = compute.mapped(building, state.settings().mapping_of(Column()))
    own, blank = (
        run.curves(prior, region=Region.ALL).tp.tolist() for prior in (SOURCE, BLANK)
    )
    last = len(own) - 1
    ends = f"{blank[-1]} wall cells are found without the drawing, {own[-1]} with it"
    n = next((n for n in range(1, last + 1) if blank[n] >= own[n]), None)
    if n is None:
        return Outcome(f"Never: after all {last} readings {ends}.", "never")
    shares = {"quarter": 0.25, "half": 0.5, "all": 1.0}
    answer = next(name for name, share in shares.items() if n <= share * last)
    return Outcome(f"After {n} of {last} readings; at the end {ends}.", answer)


def whose_drawing() -> Outcome:
    """With which drawing the map is better, by each rule."""
    building, settings = state.building(), state.settings()
    other = others(tuple(compute.prior_drawings(building)))[0]
    own, wrong = (
        {
            rule: final_f2(building, settings, Column(prior_drawing=one, rule=rule))
            for rule in UpdateRule
        }
        for one in (PriorDrawing.OWN, other)
    )
    blank = final_f2(building, settings, Column(uninformative=True))
    name = CHOICES[other][0].lower() + CHOICES[other][1:]
    text = (
        f"F2 on the cells looked at, taken off: {words.percent(own[SUBTRACT])} with "
        f"its own drawing, {words.percent(wrong[SUBTRACT])} with {name}, "
        f"{words.percent(blank)} with none. Counted once: {words.percent(own[ONCE])} "
        f"and {words.percent(wrong[ONCE])}."
    )
    gain = own[SUBTRACT] - wrong[SUBTRACT]
    answer = "alike" if abs(gain) < 0.01 else "own" if gain > 0 else "other"
    asks = _asked_by()
    if asks:
        text = f"{WHOSE[answer]} {asks}"
    return Outcome(f"{text}{_vote()}", answer)


LINE_UP = "line_up"
"""The exercise that asks for the scores of this lesson."""
WHOSE = {
    "own": "With this building's drawing, taken off at every reading, the map is the "
    "better one.",
    "other": "With another building's drawing, taken off at every reading, the map is "
    "the better one.",
    "alike": "Taken off at every reading, both drawings give as good a map.",
}


def _asked_by() -> str:
    """Who asks for the scores of this building; empty once that was attempted."""
    asking = next(one for one in compute.exercises() if one.id == LINE_UP)
    if state.choice() != asking.setup.drawing or state.was_tried(asking):
        return ""
    return (
        f"Exercise {asking.number} asks for the scores; they stand here once it was "
        "attempted."
    )


def _vote() -> str:
    """What was voted on the home page, where this began."""
    said = state.prediction(0)
    if not said:
        return ""
    return f" On the first page you voted for {COURSE[0].options[said]}."


def final_f2(building: Building, settings: Settings, column: Column) -> float:
    """F2 of the cells looked at after the last reading of one map among several."""
    drawn = compute.fitting(building, column.prior_drawing, settings.flaws)
    run = compute.drawn_run(building, settings.mapping_of(column), drawn)
    pair = Prior(p_wall=column.p_wall, p_space=column.p_space)
    prior = BLANK if column.uninformative else pair
    return run.scores(prior, column.rule).f2


def seen_more() -> Outcome:
    """What it cost in precision to look at more cells."""
    prior, now = state.settings().prior, _with(state.settings())
    share = coverage(now.map(prior))
    seen = words.percent(share)
    if share < target():
        return Outcome(
            f"It has looked at {seen} so far: widen the view or lengthen the range."
        )
    was, is_now = (run.scores(prior).precision for run in (_opened(), now))
    lost = round(was - is_now, 3)
    answer = "none" if lost <= 0 else "little" if lost <= LITTLE else "much"
    return Outcome(
        f"It has looked at {seen}, and precision went from {words.percent(was)} to "
        f"{words.percent(is_now)}. Another way to look at as much may cost another "
        "price.",
        answer,
    )


def _opened() -> Run:
    """The run of these settings with the sensor that the drawing opens with."""
    opening = state.defaults(state.choice())
    names = ("range_px", "fov_deg")
    return _with(
        replace(state.settings(), **{name: getattr(opening, name) for name in names})
    )


def _with(settings: Settings) -> Run:
    building = state.building()
    return Run(building, settings, compute.mapped(building, settings.mapping))


def target() -> float:
    """The share of cells to look at: the next five per cent, if two away or more."""
    seen = coverage(_opened().map(BLANK))
    return math.ceil((seen + 0.02) * 20) / 20


# --- 7 to 9: priors -------------------------------------------------------------------


def moved_front() -> Outcome:
    """Where the best pair of a front lies under each rule."""
    run = compute.run(state.building(), state.settings())
    best = [best_f2(run, rule) for rule in (ONCE, SUBTRACT)]
    if None in best:
        return Outcome("One of the fronts has no point to recommend.")
    once, other = best
    said = [
        f"{maps.pair_text(prior.p_wall, prior.p_space)} with F2 "
        f"{words.percent(run.under(rule).scores(prior).f2)}"
        for rule, prior in zip((ONCE, SUBTRACT), best, strict=True)
    ]
    answer = "agrees" if other.p_wall < other.p_space else "negative"
    if once == other:
        answer = "same"
    opposite = ": p_wall above p_space, the drawing's opposite" * (answer == "negative")
    return Outcome(
        f"Counted once, the best pair of the front is {said[0]}; taken off at every "
        f"reading, it is {said[1]}{opposite}.",
        answer,
    )


def peak_of_recall() -> Outcome:
    """At which p_wall recall is highest in the cases of the study, counted once."""
    chosen = state.settings()
    study = StudySettings(
        rule=ONCE,
        region=chosen.region,
        behind_hit=chosen.behind_hit,
        wall_share=chosen.wall_share,
        truth_share=chosen.truth_share,
    )
    cases = [
        solving.study_case(compute.sample(name), cell_px, study)
        for name in sample_names()
        for cell_px in SOURCE_CELLS_PX
    ]
    peaks = [min(case.recall.p_wall.tolist(), default=math.nan) for case in cases]
    counts = {
        "low": sum(p <= LOW + 1e-9 for p in peaks),
        "middle": sum(LOW + 1e-9 < p < HIGH - 1e-9 for p in peaks),
        "high": sum(p >= HIGH - 1e-9 for p in peaks),
    }
    return Outcome(
        f"Counted once, recall is highest at p_wall = {LOW:g}, the lowest value, in "
        f"{counts['low']} of {len(cases)} cases, and at {HIGH:g} or more in "
        f"{counts['high']}.",
        max(counts, key=counts.__getitem__),
    )


def control() -> Outcome:
    """Whether a prior that knows no drawing does as well as the source's pair."""
    run = compute.run(state.building(), state.settings()).under(ONCE).mapped
    best = best_control(run.sweep)
    pairs = {
        region: (
            run.scores(SOURCE, region=region).f2,
            run.scores(best, region=region).f2,
        )
        for region in (Region.EXPLORED, Region.ALL)
    }
    if any(math.isnan(value) for pair in pairs.values() for value in pair):
        return Outcome("There is no wall to map in this building yet.")
    looked, everywhere = (own - other <= AS_GOOD for own, other in pairs.values())
    said = [
        f"{words.percent(own)} with the drawing, {words.percent(other)} with the "
        "control"
        for own, other in pairs.values()
    ]
    answer = ("everywhere" if everywhere else "looked") if looked else "no"
    return Outcome(
        f"The control is {best.p_wall:.2f} on every cell. F2 on the cells looked at: "
        f"{said[0]}; over all cells: {said[1]}. {_laps(run)}",
        answer,
    )


def _laps(run: MappingRun) -> str:
    """What the drawing is still worth where the same tour is driven again."""
    recalls = [
        [words.percent(lap_scores(run, prior, n).recall) for prior in (SOURCE, BLANK)]
        for n in range(1, LAPS + 1)
    ]
    shown = "; ".join(
        f"{n}: {own} and {blank}" for n, (own, blank) in enumerate(recalls, start=1)
    )
    return (
        "Recall on the cells looked at after laps of the same tour, with the drawing "
        f"and without: {shown}."
    )


def best_control(sweep: Callable[..., object]) -> Prior:
    """The value that serves every cell best, by F2 on the cells looked at."""
    values = [round(0.01 * n, 2) for n in range(5, 101)]
    f2 = sweep(values, values, ONCE).f2.tolist()
    best = max(range(len(values)), key=lambda i: (f2[i][i] == f2[i][i], f2[i][i]))
    return Prior(p_wall=values[best], p_space=values[best])


OUTCOMES: Mapping[int, Callable[[], Outcome]] = {
    1: silent,
    2: second,
    3: first_wall,
    4: caught_up,
    5: whose_drawing,
    6: seen_more,
    7: moved_front,
    8: peak_of_recall,
    9: control,
}
"""By the lesson's number; the home page's maps say their own."""


def filled(number: int, text: str) -> str:
    """A lesson's question with what it takes from the page."""
    if number != 6:
        return text
    seen = words.percent(coverage(_opened().map(BLANK)))
    return text.format(coverage=seen, target=f"{100 * target():.0f} %")
