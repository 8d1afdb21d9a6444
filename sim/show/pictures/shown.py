"""What pictures show, asked for them by name: a program alone, or a run of it."""

from typing import Protocol

from parser.findings.catalogue import Language
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.texts import Words


class Drawable(Protocol):
    """What pictures are drawn of."""

    def title_in(self, language: Language) -> str:
        """What it is called in a language."""

    def least_px(self, name: str) -> int:
        """How narrow a picture can be."""

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas | None:
        """The page of a picture, drawn; None where there is nothing to show in it."""


def label(name: str, title: str, language: Language) -> str:
    """What a picture is, for those who cannot see it."""
    return f"{title}: {Words(language)(f'common.picture_{name}')}"
