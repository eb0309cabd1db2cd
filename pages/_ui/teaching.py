"""What a teacher gets: a guide to each lesson, plans, and worksheets to print."""

import html
import re
from dataclasses import dataclass
from pathlib import Path

from pages._ui.course import COURSE, Lesson

FOLDER = Path(__file__).resolve().parents[2] / "assets" / "docs" / "teaching"
PLANS = (45, 90)
"""The plans that there are, by their minutes."""
_STEP = re.compile(r"^\| (\d+) \| (\d) \| ([\d, ]*) \| (.+) \| (.*) \|$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a plan; ``note`` is what a student writes down."""

    minutes: int
    lesson: int
    exercises: tuple[int, ...]
    what: str
    note: str


def guide(lesson: Lesson) -> str:
    """The teacher's guide to a lesson, as Markdown."""
    (found,) = FOLDER.glob(f"{lesson.number:02d}_*.md")
    return found.read_text(encoding="utf-8")


def plan(minutes: int) -> str:
    """A plan, as Markdown."""
    return (FOLDER / f"plan_{minutes}.md").read_text(encoding="utf-8")


def steps(minutes: int) -> list[Step]:
    """The steps of a plan: the rows of its table."""
    return [
        Step(
            int(time),
            int(lesson),
            tuple(map(int, re.findall(r"\d+", exercises))),
            what,
            note,
        )
        for time, lesson, exercises, what, note in _STEP.findall(plan(minutes))
    ]


# --- The worksheet --------------------------------------------------------------------

STYLE = """
@page { size: A4; margin: 10mm 14mm; }
body { font: 9.5pt/1.28 sans-serif; color: #000; max-width: 182mm; margin: 0 auto; }
h1 { font-size: 14pt; margin: 0 0 2mm; }
h2 { font-size: 11pt; margin: 2.6mm 0 0.6mm; break-after: avoid; }
section { break-inside: avoid; }
p { margin: 0.5mm 0; }
.head, .note { display: flex; gap: 6mm; }
.head span, .note span { flex: 1; border-bottom: 0.3mm solid #000; height: 5.5mm; }
.note { align-items: end; gap: 3mm; }
.minutes { float: right; font-weight: normal; }
.option { display: inline-block; margin-left: 5mm; }
.option::before { content: "\\2610"; margin-right: 1.5mm; }
"""


def worksheet(minutes: int) -> str:
    """One page to print for a plan: what to predict, and room for what came out."""
    parts = "\n".join(_section(step) for step in steps(minutes))
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Mapping with a drawing: worksheet for {minutes} minutes</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Mapping with a drawing: worksheet for {minutes} minutes</h1>
<div class="head">Name<span></span>Date<span></span></div>
{parts}
<p>Predict before you look. A prediction is not marked.</p>
</body>
</html>
"""


def _section(step: Step) -> str:
    lesson = COURSE[step.lesson]
    return (
        f'<section><h2><span class="minutes">{step.minutes} min</span>'
        f"Lesson {_shown(lesson.full_title)}</h2>\n"
        f"<p>{_shown(_capital(step.what))}.</p>\n{_prediction(lesson)}"
        f'<p class="note">{_shown(step.note)}<span></span></p></section>'
    )


def _prediction(lesson: Lesson) -> str:
    """The question of a lesson, with a box to tick for each answer."""
    question = _shown(lesson.asked)
    options = "".join(
        f'<span class="option">{_shown(label)}</span>'
        for label in lesson.options.values()
    )
    return f"<p><b>Predict.</b> {question}{options}</p>\n"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


_SUBSCRIPT = re.compile(r"\b([pl])_(\w+)")


def _shown(text: str) -> str:
    """A text as HTML; its quantities with subscripts."""
    plain = html.escape(text.replace("*", ""))
    return _SUBSCRIPT.sub(r"<i>\1</i><sub>\2</sub>", plain)


if __name__ == "__main__":
    for one in PLANS:
        (FOLDER / f"worksheet_{one}.html").write_text(worksheet(one), encoding="utf-8")
