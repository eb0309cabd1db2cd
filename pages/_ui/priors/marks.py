"""The priors that are marked on every chart of prior pairs and of their scores."""

import base64
from collections.abc import Mapping
from dataclasses import dataclass

import streamlit as st

from occsim import Prior
from occsim.prior import PRIOR_SCALE
from pages._ui import palette
from pages._ui.priors import solving
from pages._ui.priors.scores import BLANK
from pages._ui.runs import Run

LOW, HIGH = 0.1, 1.0
"""Ends of both axes of every chart of prior pairs."""
CALIBRATED, IN_BITS = "calibrated", "best in bits"
SYMBOLS = {
    "no drawing (blank map)": "square",
    "the source's (0.2, 0.9)": "star",
    CALIBRATED: "diamond",
    IN_BITS: "triangle-up",
    "chosen": "circle-open",
}
_SHAPES = {
    "square": "M2 2h10v10h-10z",
    "star": "M7 0l1.9 4.7 5.1.3-3.9 3.3 1.2 4.9-4.3-2.7-4.3 2.7 1.2-4.9-3.9-3.3 "
    "5.1-.3z",
    "diamond": "M7 0l7 7-7 7-7-7z",
    "triangle-up": "M7 1l7 12h-14z",
    "circle-open": "M7 2a5 5 0 1 0 .01 0z",
    "circle": "M7 4a3 3 0 1 0 .01 0z",
}


BEYOND = (
    "A front compares the pairs of the source, whose p_free ends at 0.09 and 0.9; "
    "calibrated and best in bits are not bound to them, and stand at the border."
)


def shown(p_free: float) -> str:
    """A probability that is neither 0 nor 1, and is not shown as one of them."""
    if not 0.001 <= p_free <= 0.999:
        return "below 0.001" if p_free < 0.5 else "above 0.999"
    return f"{p_free:.3g}"


@dataclass(frozen=True, slots=True)
class MarkedPrior:
    """A prior with its name and the symbol of its mark."""

    name: str
    prior: Prior

    @property
    def symbol(self) -> str:
        """The symbol of plotly."""
        return SYMBOLS[self.name]

    @property
    def pair(self) -> tuple[float, float]:
        """Its place on axes of p_wall and p_space: the end of an axis if beyond it."""
        p_free = self.prior.p_free_wall, self.prior.p_free_space
        wall, space = (min(max(p / PRIOR_SCALE, LOW), HIGH) for p in p_free)
        return wall, space

    @property
    def text(self) -> str:
        """Its name and its own probabilities of free, on wall cells and elsewhere."""
        wall, space = shown(self.prior.p_free_wall), shown(self.prior.p_free_space)
        return f"{self.name} {wall} and {space}"


def marked(run: Run) -> list[MarkedPrior]:
    """The blank prior, the source's, the calibrated one and the best in bits."""
    best = solving.best_in_bits(run, run.settings.rule, run.settings.region)
    priors = (BLANK, Prior(), solving.calibrated(run), best)
    return [
        MarkedPrior(name, prior) for name, prior in zip(SYMBOLS, priors, strict=False)
    ]


def legend(more: Mapping[str, str] | None = None) -> None:
    """What the symbols mean, once for all charts of a page; ``more``: name, symbol."""
    items = "".join(
        f'<span style="white-space:nowrap;margin-right:1.2em">{_shape(symbol)} {name}'
        "</span>"
        for name, symbol in (SYMBOLS | dict(more or {})).items()
    )
    st.html(f'<div style="font-size:0.85rem">{items}</div>')


def _shape(symbol: str) -> str:
    # As an image: HTML on a page is cleaned of SVG.
    fill, line, width = palette.HALO, palette.OUTLINE, 1.0
    if symbol == "circle-open":
        fill, line, width = "none", palette.MARK, 2.5
    elif symbol == "circle":
        fill, line = palette.OUTLINE, palette.HALO
    drawn = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1 -1 16 16">'
        f'<path d="{_SHAPES[symbol]}" fill="{fill}" stroke="{line}" '
        f'stroke-width="{width}"/></svg>'
    )
    data = base64.b64encode(drawn.encode()).decode()
    return (
        f'<img alt="" src="data:image/svg+xml;base64,{data}" '
        'style="width:15px;height:15px;vertical-align:-2px">'
    )
