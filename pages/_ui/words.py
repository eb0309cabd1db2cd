"""Numbers and names as the pages show them."""

import html
import re

from pages._ui import glossary

DASH = "–"
"""Shown where a value is undefined."""
MINUS = "−"

SOURCE = (
    "The source: C. Georgiou, *Constructing informative Bayesian priors to improve "
    "SLAM map quality*, thesis, University of Sheffield; the same work as C. Georgiou, "
    "S. Anderson and T. Dodd, *International Journal of Robotics Research* 36(3), "
    "2017, [doi 10.1177/0278364916687027]"
    "(https://doi.org/10.1177/0278364916687027). The drawings are ours, of the same "
    "kinds."
)
"""What “the source” means, shown once on every page that mentions it."""


_SYMBOLS = {
    "p_wall": r"p_\text{wall}",
    "p_space": r"p_\text{space}",
    "p_free": r"p_\text{free}",
    "l_0": "l_0",
}


def maths(text: str) -> str:
    """Return Markdown in which the names of the model's quantities are mathematics."""
    for name, symbol in _SYMBOLS.items():
        text = re.sub(rf"\b{name}\b", lambda _, symbol=symbol: f"${symbol}$", text)
    return text


def chart(text: str) -> str:
    """The same for a chart, which cannot show mathematics: letters and subscripts."""
    return re.sub(r"\b([pl])_(wall|space|free|0)\b", r"<i>\1</i><sub>\2</sub>", text)


def ranges(text: str) -> str:
    """Pairs with ranges as the source prints them, 0.7:1, in words: 0.7 to 1."""
    return text.replace(":", " to ")


_ADDRESS = re.compile(r":(?=\S)|@(?=\S)|www\.", re.IGNORECASE)
_MARKUP = re.compile(r"([\\`*_{}\[\]()<>#+\-.!|~$:&])")


def plain(text: str) -> str:
    """Return a text in which Markdown and HTML have no effect: file names, titles."""
    # Addresses and icons are found in the text itself, where an escape is gone already:
    # a word joiner, which is not seen, keeps them from being found.
    joined = _ADDRESS.sub("\\g<0>\u2060", text.replace("\n", " "))
    return _MARKUP.sub(r"\\\1", joined)


_NAMES = re.compile(rf"\b({'|'.join(_SYMBOLS)})\b")


def prose(text: str) -> str:
    """Return another's text as it is, but for the names of the model's quantities.

    For exercises, which a teacher may have written: no link, no picture, no HTML.
    """
    parts = _NAMES.split(text)
    return "".join(
        f"${_SYMBOLS[part]}$" if i % 2 else plain(part) for i, part in enumerate(parts)
    )


def number(value: float, spec: str = ",") -> str:
    """A number by a format, as it is printed on every page; a dash if undefined.

    With a true minus, and none where it rounds to zero; thousands are apart where the
    format says so, as it does for a count.
    """
    if value != value:
        return DASH
    text = format(value, spec)
    is_zero = not re.search("[1-9]", text)
    return text.replace("-", "" if is_zero else MINUS)


def percent(value: float) -> str:
    """A share in percent; a dash where it is undefined."""
    return DASH if value != value else f"{100 * value:.1f} %"


def ordinal(number: int) -> str:
    """A number as a place in a row: 2nd, 3rd, 11th."""
    endings = {1: "st", 2: "nd", 3: "rd"}
    teens = number % 100 in (11, 12, 13)
    return f"{number}{'th' if teens else endings.get(number % 10, 'th')}"


def term(name: str, shown: str = "") -> str:
    """Return HTML that shows a term, and its meaning when it is pointed at.

    The text is ours, so that Markdown may take it as HTML; Tab reaches it as well.
    """
    about = html.escape(glossary.meaning(name))
    return f'<abbr title="{about}" tabindex="0">{shown or name}</abbr>'
