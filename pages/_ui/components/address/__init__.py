"""The address line: it follows the student's choices; a button copies it.

One Streamlit component at the foot of every page. It replaces the address without a
new entry in the browser's history, so that a reload, a bookmark and a copied link open
what is on the screen, and it asks before the user leaves work that no link can restore.
"""

import json
from collections.abc import Mapping
from pathlib import Path

from pages._ui.components import component, keep_state

FOLDER = Path(__file__).parent
SCRIPTS = ("address.js",)
COMPONENT = "address"


def address(
    query: Mapping[str, str],
    *,
    note: str = "",
    unsaved: bool = False,
    has_button: bool = True,
    progress: str = "",
    session: str = "",
    cleared: bool = False,
    voter: str = "",
    projector: bool = False,
    key: str,
) -> None:
    """Keep the address line in step, and show the button that copies it.

    Parameters
    ----------
    query : mapping of str to str
        The query of the address, after the question mark.
    note : str
        What the link does and does not carry, shown once it has been copied.
    unsaved : bool
        Whether leaving the page loses something that the link does not restore.
    has_button : bool
        Whether the button is shown.
    progress : str
        What the browser is to keep of what was done. What it kept before, it commits
        as "kept", with the word by which it votes.
    session : str
        A word that this session drew; empty where the browser is to keep nothing.
    cleared : bool
        Whether it is to forget what it kept before; what is done since, it keeps.
    voter : str
        The word by which this session votes; empty where it is in no room.
    projector : bool
        Whether the keys 1 to 9 open the lessons, and space plays.
    key : str
        Key of the component.
    """
    data = {
        "query": dict(query),
        "note": note,
        "unsaved": unsaved,
        "hasButton": has_button,
        "progress": progress,
        "session": session,
        "cleared": cleared,
        "voter": voter,
        "projector": projector,
    }
    component(COMPONENT, FOLDER, SCRIPTS)(
        key=key, data=json.dumps(data), on_kept_change=keep_state
    )
