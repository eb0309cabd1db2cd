"""How good a map is where the robot looked and where it did not, beside no drawing."""

from dataclasses import dataclass

from occsim import Prior, Region, UpdateRule
from pages._ui.runs import Run
from pages._ui.words import number, percent, term

COLUMNS = {Region.EXPLORED: "looked at", Region.UNEXPLORED: "not looked at"}
BLANK = Prior.uninformative()


@dataclass(frozen=True, slots=True)
class Values:
    """Four scores of one map over one region; NaN where undefined."""

    precision: float
    recall: float
    f2: float
    bits: float

    def shown(self) -> dict[str, str]:
        """Each score by its name on screen."""
        shares = {
            "Precision": self.precision,
            "Recall": self.recall,
            "F2": self.f2,
        }
        shown = {name: percent(share) for name, share in shares.items()}
        # A number and its unit stay on one line of a narrow table.
        unbroken = {name: text.replace(" ", "\u00a0") for name, text in shown.items()}
        return unbroken | {"Bits per cell": bits(self.bits)}


@dataclass(frozen=True, slots=True)
class Row:
    """One score of a map as shown, and of the blank map, in each of `COLUMNS`."""

    name: str
    values: tuple[str, ...]
    blank: tuple[str, ...]


def both_rules(run: Run) -> list[Run]:
    """A run under each rule, the one that counts the drawing once first."""
    return [run.under(rule) for rule in UpdateRule]


def bits(value: float) -> str:
    """Bits per cell; a dash where there is no cell."""
    return number(value, ".3f")


def values(run: Run, prior: Prior, rule: UpdateRule | None = None) -> list[Values]:
    """The scores of a prior's map in each of `COLUMNS`; by default the run's rule."""
    return [in_region(run, prior, region, rule) for region in COLUMNS]


def in_region(
    run: Run, prior: Prior, region: Region, rule: UpdateRule | None = None
) -> Values:
    """The scores of a prior's map over one region."""
    rule = rule or run.settings.rule
    counts = run.mapped.scores(prior, rule, region)
    loss = run.mapped.bits(prior, rule, region)
    return Values(counts.precision, counts.recall, counts.f2, loss)


def rows(run: Run, prior: Prior, rule: UpdateRule | None = None) -> list[Row]:
    """Precision, recall, F2 and bits per cell, the blank map's beside each."""
    own = [one.shown() for one in values(run, prior, rule)]
    blank = [one.shown() for one in values(run, BLANK, rule)]
    return [
        Row(name, tuple(v[name] for v in own), tuple(v[name] for v in blank))
        for name in own[0]
    ]


def table(run: Run, prior: Prior) -> str:
    """The rows as Markdown: two columns, the blank map's value beside each.

    Its terms are HTML, which the page must allow.
    """
    blank = term("blank map", "blank")
    heads = " | ".join(f"{term(title)} | {blank}" for title in COLUMNS.values())
    lines = [f"| Score | {heads} |", "|---|" + "---:|" * 2 * len(COLUMNS)]
    for row in rows(run, prior):
        pairs = zip(row.values, row.blank, strict=True)
        cells = " | ".join(f"**{value}** | {blank}" for value, blank in pairs)
        lines.append(f"| {term(row.name)} | {cells} |")
    return "\n".join(lines)
