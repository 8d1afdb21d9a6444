"""The keys of the window, over its frame."""

from typing import Final

import numpy as np

from parser.findings.catalogue import Language
from sim.show.draw import style
from sim.show.draw.layout import Box, box_around
from sim.show.draw.paints import Paint, Theme
from sim.show.film.layout import Layout
from sim.show.film.plate import Pixels, plate_over
from sim.show.keys import OF_WINDOW
from sim.show.words import Words

ROW: Final = 36.0
WIDTH: Final = 620.0


def draw_help(frame: Pixels, theme: Theme, language: Language, layout: Layout) -> None:
    """Write the keys into the middle of a frame."""
    unit, say = layout.unit, Words(language)
    width, height = min(WIDTH * unit, layout.width_px - 8.0), (len(OF_WINDOW) + 1) * ROW * unit
    box = box_around(np.array([layout.width_px, layout.height_px]) / 2.0, width, min(height, layout.height_px - 8.0))
    left, top, right, bottom = (round(side) for side in box)
    plate = plate_over(frame[top:bottom, left:right], theme)
    own = Box(0.0, 0.0, right - left, bottom - top)
    plate.box(own, Paint.PAGE, Paint.FRAME, 2.0 * style.GRID_WIDTH * unit)
    row = (own.bottom - own.top) / (len(OF_WINDOW) + 1)
    for number, key in enumerate(OF_WINDOW):
        y, size = (number + 1.0) * row, min(style.TEXT * unit, 0.7 * row)
        name = " ".join(say(f"keys.{one}") if one.startswith("key_") else one for one in key.shown)
        plate.text((0.05 * own.right, y), name, size, Paint.INK)
        plate.text((0.38 * own.right, y), say(f"keys.does_{key.does}"), size, Paint.GREY)
    frame[top:bottom, left:right] = plate.pixels()
