"""The picture of a plan by its name, as those who write pictures ask for it."""

from typing import Final, NamedTuple

from sim.make.cam.model import CutPlan
from sim.show.draw import style
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.plan.picture import draw_plan

PLAN: Final = "plan"


class PlanShown(NamedTuple):
    """A plan of which `PLAN` is to be drawn; see `sim.show.pictures.shown.Shown`."""

    plan: CutPlan

    @property
    def title(self) -> str:
        """Name of the drawing."""
        return self.plan.drawing.name

    def least_px(self, name: str) -> int:
        """How narrow the picture can be."""
        return style.LEAST_WIDTH

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas:
        """The page, drawn."""
        return draw_plan(sheet, self.plan)
