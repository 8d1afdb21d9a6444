"""The sheet that a picture is drawn on: how wide, in which language and colours, as pixels or as SVG."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Generic, TypeVar

from parser.findings.catalogue import Language
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import unit_of
from sim.show.draw.style import LIGHT, Theme
from sim.show.draw.svg import Svg
from sim.show.texts import Words

if TYPE_CHECKING:
    from sim.show.draw.raster import Raster

AnyCanvas = TypeVar("AnyCanvas", bound=Canvas)

SIZES_PX: Final[Mapping[str, int]] = {"thumbnail": 320, "screen": 1600, "a4": 3508, "a3": 4961}
"""Widths by name; A4 and A3 lie across, at 300 dpi."""


@dataclass(frozen=True, slots=True)
class Sheet(Generic[AnyCanvas]):
    """What a picture is drawn on; its height follows from what it shows.

    Attributes
    ----------
    canvas
        Makes a canvas of a width and a height, px, in a theme.
    width_px
        Width of the picture.
    theme, language
        Its colours, and the language of its texts.
    """

    canvas: Callable[[int, int, Theme], AnyCanvas]
    width_px: int
    theme: Theme
    language: Language

    def page(self, height_px: int) -> AnyCanvas:
        """An empty page of the sheet's width."""
        return self.canvas(self.width_px, height_px, self.theme)

    @property
    def unit(self) -> float:
        """Factor on the sizes of `sim.show.draw.style`."""
        return unit_of(self.width_px)

    @property
    def say(self) -> Words:
        """The texts of pictures in the sheet's language."""
        return Words(self.language)


def pixels(width_px: int = style.BASE_WIDTH, theme: Theme = LIGHT, language: Language = "en") -> "Sheet[Raster]":
    """A sheet that becomes a picture of pixels."""
    from sim.show.draw.raster import Raster  # noqa: PLC0415 - SVG needs no pygame

    return Sheet(Raster, width_px, theme, language)


def drawing(width_px: int = style.BASE_WIDTH, theme: Theme = LIGHT, language: Language = "en") -> Sheet[Svg]:
    """A sheet that becomes an SVG drawing."""
    return Sheet(Svg, width_px, theme, language)
