"""QR codes, as SVG: a link that a class can photograph from the projector."""

import base64
import html
from collections.abc import Mapping
from functools import lru_cache
from urllib.parse import urlencode, urlsplit

import segno
import streamlit as st

from pages._ui import palette

MAX_CHARACTERS = 1_000
"""Longer texts give modules too fine to be read from the back of a room."""
LOCAL = {"localhost", "127.0.0.1", "::1"}


@lru_cache(maxsize=64)
def qr_svg(text: str) -> str:
    """Return the QR code of a text as an SVG element that fits any size.

    It has dark modules on a light ground and the border that readers need, so that it
    is read on a dark page as well. The text itself does not appear in the SVG.

    Raises
    ------
    ValueError
        Where the text is empty or has more than `MAX_CHARACTERS` characters.
    """
    if not 0 < len(text) <= MAX_CHARACTERS:
        raise ValueError(
            f"a QR code takes 1 to {MAX_CHARACTERS} characters; got {len(text)}"
        )
    # The level of correction rises by itself where it needs no more modules.
    code = segno.make_qr(text, error="l")
    return code.svg_inline(
        dark=palette.OUTLINE, light=palette.PAPER, border=4, omitsize=True
    )


def qr_html(text: str, about: str) -> str:
    """Return HTML that shows the QR code of a text, with a name for screen readers.

    ``st.html`` removes SVG elements, but not pictures.

    Raises
    ------
    ValueError
        As `qr_svg` does.
    """
    svg = qr_svg(text).replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
    data = base64.b64encode(svg.encode()).decode()
    return (
        f'<img class="occsim-qr" alt="{html.escape(about)}" '
        f'src="data:image/svg+xml;base64,{data}">'
    )


def link_to(query: Mapping[str, str]) -> str:
    """Return the address of this page in the student's browser, with a query."""
    return f"{st.context.url or ''}?{urlencode(query)}".rstrip("?")


def qr_popover(query: Mapping[str, str]) -> None:
    """Offer the link to this page as a QR code, made when it is asked for."""
    with st.popover("QR code", on_change="rerun", key="qr_code") as shown:
        if shown.open:
            _show(link_to(query))


def _show(link: str) -> None:
    try:
        code = qr_html(link, "QR code of the link to this page")
    except ValueError as error:
        st.text(f"This link has no QR code: {error}.")
        return
    st.html(code)
    st.code(link, language=None, wrap_lines=True)
    if urlsplit(link).hostname in LOCAL:
        st.caption(
            "This address works on this computer only. For a class, open the app "
            "under the computer's name in the network (README)."
        )
