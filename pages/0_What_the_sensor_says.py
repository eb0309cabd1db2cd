"""What the sensor says: one reading at pixel level, and how readings add up."""

from pages._ui import shell, state
from pages._ui.components.lens import lens

with shell.page("pages/0_What_the_sensor_says.py") as lesson:
    shell.heading(lesson)
    state.take_from_lens(lens(state.lens_document(), key=state.LENS_KEY))
