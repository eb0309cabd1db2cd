"""Every setting of the app, declared once: name, default, bounds, label, unit.

Controls, the share link and the checks of outside values all read these declarations.
Nothing here depends on Streamlit.
"""

from pages._ui.settings.link import column_with, decode, encode, with_changes
from pages._ui.settings.settings import TABLE, Settings

__all__ = ["TABLE", "Settings", "column_with", "decode", "encode", "with_changes"]
