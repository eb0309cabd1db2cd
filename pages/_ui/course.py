"""The ten lessons: each one's question, words, prediction, and how it opens.

Nothing here depends on Streamlit.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from occsim import UpdateRule
from pages._ui.columns import OPENING_COLUMNS, Column

BLANK = Column(uninformative=True)


@dataclass(frozen=True, kw_only=True, slots=True)
class Lesson:
    """One lesson.

    Parameters
    ----------
    number : int
        Its place in the course; a link gives it.
    title, question : str
        What it is called, and the one question that it asks.
    path : str
        The page on which it is.
    see, why : str
        What there is to see and to do, and why it is so: three sentences at most.
    predict : str
        What is asked before; names in braces are filled in from what the page shows.
    options : mapping of str to str
        The answers on screen, by the name that is stored.
    drawing : str
        The reference drawing that it opens with; empty leaves the student's.
    settings, lens : mapping
        What it sets; settings that it does not name are the drawing's own.
    further : tuple of str
        Other pages on which it goes on.
    """

    number: int
    title: str
    question: str
    path: str
    see: str = ""
    why: str = ""
    predict: str = ""
    options: Mapping[str, str] = field(default_factory=dict)
    drawing: str = ""
    settings: Mapping[str, Any] = field(default_factory=dict)
    lens: Mapping[str, Any] = field(default_factory=dict)
    further: tuple[str, ...] = ()

    @property
    def full_title(self) -> str:
        """Its number, title and question."""
        colon = "" if self.title.endswith("?") else ":"
        return f"{self.number}. {self.title}{colon} {self.question}"

    @property
    def asked(self) -> str:
        """What is asked before, where no page fills in its numbers."""
        return self.predict.format(coverage="part", target="more")


COURSE = (
    Lesson(
        number=0,
        title="Hand the robot a drawing",
        question="Who is right, the drawing or the robot?",
        path="app.py",
        predict="Which will be best when it has seen every room?",
        options={
            "none": "no drawing",
            "own": "its own drawing",
            "other": "the wrong drawing",
        },
    ),
    Lesson(
        number=1,
        title="What the sensor says",
        question="What does one reading say of one cell?",
        path="pages/0_What_the_sensor_says.py",
        see="Blue pixels lie before the wall that their ray meets, orange ones at it "
        "or behind it; q is the blue share of a cell's pixels in view. Drag the robot, "
        "turn it by its handle, select a cell.",
        why="Where a cell holds both, Eq. 4.22 takes q itself as p_free, and at q = "
        "1/2 its log-odds are 0: in such cells a prior will matter.",
        predict="Can the robot look at a cell, see both wall and floor in it, and "
        "learn nothing?",
        options={"yes": "yes, it can", "no": "no, it cannot"},
        # No cell in view says nothing from here: it has to be looked for.
        lens={"y_px": 16.5},
    ),
    Lesson(
        number=2,
        title="Readings add up",
        question="Why log-odds?",
        path="pages/0_What_the_sensor_says.py",
        see="The bars start at the prior, and each reading adds its log-odds; in "
        "another order the bars change, the sum does not. A step of l is as long "
        "everywhere on its scale, a step of p is not.",
        why="Counting cells needs no formula, and counting the drawing once gives what "
        "was counted.",
        predict="A cell is read empty, then again. In which of p and l is the second "
        "reading worth as much as the first?",
        options={
            "both": "in both",
            "p": "only in p",
            "l": "only in l",
            "neither": "in neither",
        },
    ),
    Lesson(
        number=3,
        title="A map from nothing",
        question="What does a robot without a drawing miss?",
        path="pages/1_Build_a_map.py",
        see="Without a drawing the map starts at one half everywhere; a reading "
        "darkens the cells that it takes for wall. At the end show *Errors*: blue "
        "walls are missed, and those that are not hatched were looked at.",
        why="The walls that the robot looks at and misses lie across an edge: part of "
        "such a cell is space, and the readings see mostly that part.",
        predict="It sets out without a drawing. Which wall will be on its map first?",
        options={
            "cone": "one that its cone meets",
            "room": "all walls of its room",
            "outer": "the outer walls",
        },
        drawing="c",
        settings={"uninformative": True},
    ),
    Lesson(
        number=4,
        title="A head start",
        question="Where does a drawing help?",
        path="pages/3_Two_maps.py",
        see="Both maps take the same readings; A starts from the drawing, B from one "
        "half everywhere. Compare *looked at* with *not looked at* while they play.",
        why="Where nobody has looked, only the drawing says anything; where the robot "
        "has looked, the drawing tips the cells that the readings leave open.",
        predict="Count all cells. After how many readings will the map without a "
        "drawing have found as many walls as the map with it?",
        options={
            "quarter": "a quarter of them",
            "half": "half of them",
            "all": "all of them",
            "never": "never on this tour",
        },
        drawing="a",
        settings={"columns": (Column(), BLANK)},
    ),
    Lesson(
        number=5,
        title="Count it once",
        question="What does the book's l₀ stand for?",
        path="pages/3_Two_maps.py",
        see="Both maps start from the same drawing; B takes it off again at every "
        "reading. Pin a cell with two readings and follow its two ladders.",
        why="The readings were set for a cell about which nothing is known, so nothing "
        "of the drawing is in them to take off.",
        predict="The drawing is taken off at every reading. With which drawing will "
        "the map be better on the cells looked at, this building's or another's?",
        options={
            "own": "this building's",
            "other": "another building's",
            "alike": "no difference",
        },
        drawing="c",
        settings={"columns": OPENING_COLUMNS},
    ),
    Lesson(
        number=6,
        title="What is a good map?",
        question="Good for what?",
        path="pages/4_What_is_a_good_map.py",
        see="A cell is declared wall where p_free is below 1/2, and four counts say "
        "how good that is: click one to see its cells. Precision and recall are two "
        "shares of these counts.",
        why="Almost every setting trades one count for another, and the picture alone "
        "does not tell what was given for what.",
        predict="The robot has looked at {coverage} of the cells. Widen its view or "
        "lengthen its range until it has looked at {target}: will that cost precision?",
        options={
            "none": "no",
            "little": "yes, up to 5 points",
            "much": "yes, more than 5 points",
        },
        drawing="d",
        settings={"uninformative": True},
    ),
    Lesson(
        number=7,
        title="Which prior?",
        question="Is there a best one?",
        path="pages/6_Pareto_explorer.py",
        see="Each point is a pair that no other beats in both scores; the square is "
        "the map without a drawing. Click a point, or move the slider along a front, "
        "and watch what the map gains and loses.",
        why="What is best depends on the rule and on the cells that count: *Best "
        "prior* shows three answers for one house.",
        predict="Take the front of a drawing that is counted once. Where it is taken "
        "off at every reading, will the best pair be another one?",
        options={
            "same": "no, the same",
            "agrees": "yes, one that agrees with it",
            "negative": "yes, its opposite",
        },
        further=("pages/5_Sweep_the_priors.py", "pages/7_Best_prior.py"),
    ),
    Lesson(
        number=8,
        title="Reproduce and doubt",
        question="What does agreement with a paper show?",
        path="pages/8_Study.py",
        see="Our maxima stand beside the published ones, under the rule that we "
        "reconstruct for the source. Switch the rule above the tables.",
        why="That a pattern appears tells what was done, not that it was right: it "
        "comes and goes with the conditions.",
        predict="Under this rule recall is highest where p_wall is high: drawn walls "
        "are called free. Count the drawing once; where will recall be highest?",
        options={
            "high": "at a high p_wall again",
            "middle": "near the middle",
            "low": "at the lowest p_wall",
        },
        settings={"study_rule": UpdateRule.SUBTRACT_PRIOR},
    ),
    Lesson(
        number=9,
        title="Yours",
        question="Does it hold for your building?",
        path="pages/2_Your_building.py",
        see="Upload a drawing, correct its walls, give the ground truth and a path. "
        "Then compare the drawing with a control: one value for every cell.",
        why="A low prior alone finds walls in cells that the readings leave open, so "
        "what a drawing is worth shows only beside such a control.",
        predict="The control knows no drawing; it is the one value that does best on "
        "the cells looked at. Will it do as well as (0.2, 0.9) with the drawing, "
        "within two points of F2?",
        options={
            "everywhere": "yes, everywhere",
            "looked": "only where the robot looked",
            "no": "no",
        },
    ),
)


def lessons_on(path: str) -> tuple[Lesson, ...]:
    """Return the lessons of a page, in order."""
    return tuple(one for one in COURSE if one.path == path)


def lesson_in(text: str, path: str) -> Lesson | None:
    """Return the lesson that a link to a page names; None where it names none of it."""
    return next((one for one in lessons_on(path) if str(one.number) == text), None)


# --- What was predicted, in a progress ------------------------------------------------


def lessons_of(given: object) -> dict[int, str]:
    """Return the lessons of a progress; what cannot be read is left out."""
    if not isinstance(given, Mapping):
        return {}
    return {
        one.number: _answer(given[str(one.number)], one)
        for one in COURSE
        if str(one.number) in given
    }


def _answer(row: Any, one: Lesson) -> str:
    said = row.get("predicted") if isinstance(row, Mapping) else None
    return said if isinstance(said, str) and said in one.options else ""
