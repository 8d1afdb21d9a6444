"""The shipped font, at any size: what backends write with, and how wide a text is."""

from typing import Final

from sim.show.draw import style
from sim.show.draw.silent_pygame import pygame

MEASURED_AT: Final = 3
"""Texts are measured at so many times their size, because the font rounds widths to whole pixels."""


class Letters:
    """The font, with the sizes that were asked for kept; sizes are px."""

    def __init__(self) -> None:
        pygame.font.init()
        self._fonts: dict[int, pygame.font.Font] = {}

    def at(self, size: float) -> pygame.font.Font:
        """The font at a size, rounded to a whole one."""
        whole = max(round(size), 1)
        if whole not in self._fonts:
            self._fonts[whole] = pygame.font.Font(style.FONT, whole)
        return self._fonts[whole]

    def width(self, text: str, size: float) -> float:
        """Width of a text."""
        return self.at(size * MEASURED_AT).size(text)[0] / MEASURED_AT
