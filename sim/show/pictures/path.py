"""The picture of a path by itself, for which no table runs and no engine is loaded."""

from typing import Final, NamedTuple

from parser.findings.catalogue import Language
from sim.show.draw import style
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.of_path import Programmed, draw_path

PATH: Final = "path"


"""Its name, as ``drycut draw --picture`` takes it."""


class PathAlone(NamedTuple):
    """A program of which nothing but `PATH` is to be drawn; see `sim.show.pictures.shown.Drawable`."""

    programmed: Programmed

    def title_in(self, language: Language) -> str:
        """Title of its scenario in a language."""
        return self.programmed.scenario.title_in(language)

    def least_px(self, name: str) -> int:
        """How narrow the picture can be: it has a thumbnail."""
        return style.LEAST_THUMBNAIL

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas:
        """The page, drawn."""
        return draw_path(sheet, self.programmed)
