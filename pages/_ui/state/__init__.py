"""The only room that touches ``st.session_state``.

One student's state is small: the `Settings`, which drawing is chosen, the building of
their own if they brought one, a message about the last thing that went wrong, and what
the components on the page were last sent. Everything else is computed from these.
"""

from pages._ui.state.chosen import (
    OPENING,
    OWN,
    building,
    change,
    choice,
    choices,
    choose,
    drawing_title,
    link,
    link_notice,
    prepare,
    reset_all,
    settings,
)
from pages._ui.state.edits import (
    attempt,
    can_redo,
    can_undo,
    edit,
    edit_building,
    message,
    open_project,
    redo,
    set_own,
    undo,
)
from pages._ui.state.pairs import (
    choose_pair,
    keep_search,
    kept_search,
    pair,
    prior,
)
from pages._ui.state.replay import (
    PLAYER_KEY,
    forget_player,
    player_document,
    take_from_player,
)
from pages._ui.state.widgets import (
    bind,
    bind_chart,
    bind_choice,
    bind_index,
    bind_view,
    set_view,
    value,
    view,
)

__all__ = [
    "OPENING",
    "OWN",
    "PLAYER_KEY",
    "attempt",
    "bind",
    "bind_chart",
    "bind_choice",
    "bind_index",
    "bind_view",
    "building",
    "can_redo",
    "can_undo",
    "change",
    "choice",
    "choices",
    "choose",
    "choose_pair",
    "drawing_title",
    "edit",
    "edit_building",
    "forget_player",
    "keep_search",
    "kept_search",
    "link",
    "link_notice",
    "message",
    "open_project",
    "pair",
    "player_document",
    "prepare",
    "prior",
    "redo",
    "reset_all",
    "set_own",
    "set_view",
    "settings",
    "take_from_player",
    "undo",
    "value",
    "view",
]
