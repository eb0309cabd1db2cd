"""All settings as one value, and the table of their declarations."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

from occsim import MapSettings
from pages._ui.columns import Column
from pages._ui.settings.declared import Setting
from pages._ui.settings.logs import LogSettings
from pages._ui.settings.prior import PriorSettings
from pages._ui.settings.readings import ReadingSettings
from pages._ui.settings.views import ViewSettings


@dataclass(frozen=True, kw_only=True)
class Settings(ViewSettings, LogSettings, PriorSettings, ReadingSettings):
    """All choices of one student; the building is kept separately."""

    @property
    def mapping(self) -> MapSettings:
        """The settings that the readings and the classes of the cells depend on."""
        return MapSettings(
            cell_px=self.cell_px,
            sensor=self.sensor,
            wall_share=self.wall_share,
            truth_share=self.truth_share,
            scan=self.scan,
        )

    def mapping_of(self, column: Column) -> MapSettings:
        """The same for one map among several."""
        return replace(
            self.mapping,
            cell_px=column.cell_px,
            sensor=replace(self.sensor, behind_hit=column.behind_hit),
        )

    @property
    def column(self) -> Column:
        """These settings as those of a single map; its errors are in `flaws`."""
        names = ("prior_drawing", "p_wall", "p_space", "uninformative")
        more = ("rule", "behind_hit", "cell_px")
        return Column(**{name: getattr(self, name) for name in (*names, *more)})

    @property
    def page_choices(self) -> dict[str, object]:
        """The fields of `column` that the page chooses, not the player."""
        return {
            "prior_drawing": self.prior_drawing.value,
            "behind_hit": self.behind_hit.value,
            "cell_px": self.cell_px,
        }


TABLE: Mapping[str, Setting] = {
    one.name: one.metadata["setting"] for one in fields(Settings)
}
"""The declaration of each setting, by its name."""
